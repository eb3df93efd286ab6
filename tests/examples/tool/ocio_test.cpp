// `nacre --ocio`: the option as a user meets it.
#include <OpenImageIO/imageio.h>

#include <filesystem>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

constexpr const char* config = R"(ocio_profile_version: 2
roles:
  default: plain
  scene_linear: plain
colorspaces:
  - !<ColorSpace>
    name: plain
  - !<ColorSpace>
    name: film log
    aliases: [film]
    to_scene_reference: !<LogTransform> {base: 10, direction: inverse}
)";

constexpr const char* document = R"(<?xml version="1.0"?>
<materialx version="1.39">
  <constant name="c" type="color3">
    <input name="value" type="color3" value="-1, 0, 0.30103" colorspace="film"/>
  </constant>
  <output name="out" type="color3" nodename="c"/>
</materialx>
)";

class OcioTool : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    write("config.ocio", config);
    write("document.mtlx", document);
  }

  /// The first pixel of the baked output.
  std::vector<float> baked() const {
    const auto image = OIIO::ImageInput::open(file("out.exr"));
    if (image == nullptr) return {};
    std::vector<float> pixels(image->spec().image_pixels() * 3);
    image->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data());
    pixels.resize(3);
    return pixels;
  }
};

TEST_F(OcioTool, BakesInTheSpacesOfTheConfiguration) {
  const std::string bake =
      "bake " + file("document.mtlx") + " --size 2 --no-cache --out " + folder_.path().string();
  ASSERT_EQ(run(bake + " --ocio " + file("config.ocio")), 0) << errors_;
  EXPECT_EQ(errors_, "");
  const std::vector<float> linear = baked();
  ASSERT_EQ(linear.size(), 3u);
  EXPECT_NEAR(linear[0], 0.1, 1e-4);  // EXR of half floats.
  EXPECT_NEAR(linear[1], 1.0, 1e-3);
  EXPECT_NEAR(linear[2], 2.0, 2e-3);
  ASSERT_EQ(run(bake + " --working-space 'film log' --ocio " + file("config.ocio")), 0) << errors_;
  const std::vector<float> as_written = baked();
  ASSERT_EQ(as_written.size(), 3u);
  EXPECT_EQ(as_written[0], -1.0f);
  // Without the configuration there is no such space.
  EXPECT_EQ(run(bake + " --strict"), 1);
  EXPECT_NE(errors_.find("document.mtlx:4:"), std::string::npos) << errors_;
  EXPECT_NE(errors_.find("'film'"), std::string::npos) << errors_;
}

/// What the document's numbers were as texels: the space of a file name.
TEST_F(OcioTool, ConvertsTexelsOfImages) {
  const std::string rest =
      " --size 2 --no-cache --out " + folder_.path().string() + " --ocio " + file("config.ocio");
  ASSERT_EQ(run("bake " + file("document.mtlx") + " --working-space film" + rest), 0) << errors_;
  std::filesystem::rename(file("out.exr"), file("texels.exr"));
  write("image.mtlx", R"(<?xml version="1.0"?>
<materialx version="1.39">
  <image name="i" type="color3">
    <input name="file" type="filename" value="texels.exr" colorspace="film log"/>
  </image>
  <output name="out" type="color3" nodename="i"/>
</materialx>
)");
  ASSERT_EQ(run("bake " + file("image.mtlx") + rest), 0) << errors_;
  const std::vector<float> linear = baked();
  ASSERT_EQ(linear.size(), 3u);
  EXPECT_NEAR(linear[0], 0.1, 1e-4);  // Half floats, before and after.
  EXPECT_NEAR(linear[1], 1.0, 1e-3);
  EXPECT_NEAR(linear[2], 2.0, 3e-3);
}

TEST_F(OcioTool, TheEnvironmentCountsOnlyWhereAskedFor) {
  const std::string check = "check " + file("document.mtlx");
  ::setenv("OCIO", file("config.ocio").c_str(), 1);
  EXPECT_EQ(run(check), 1);
  EXPECT_EQ(run(check + " --ocio env"), 0) << errors_;
  ::setenv("OCIO", file("nowhere.ocio").c_str(), 1);
  EXPECT_EQ(run(check + " --ocio env"), 1);
  EXPECT_NE(errors_.find("nowhere.ocio"), std::string::npos) << errors_;
  ::unsetenv("OCIO");
  EXPECT_EQ(run(check + " --ocio env"), 1);
  EXPECT_NE(errors_.find("OCIO"), std::string::npos) << errors_;
}

}  // namespace
}  // namespace nacre
