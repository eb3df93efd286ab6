// `nacre render --view`: the picture that an .exr has, as a display is sent it.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

constexpr const char* config = R"(ocio_profile_version: 2
roles:
  default: light
displays:
  Monitor:
    - !<View> {name: Gamma, colorspace: gamma}
    - !<View> {name: Inverse, colorspace: inverse}
colorspaces:
  - !<ColorSpace>
    name: light
    aliases: [lin_rec709]
  - !<ColorSpace>
    name: gamma
    to_scene_reference: !<ExponentTransform> {value: [2.5, 2.5, 2.5, 1]}
  - !<ColorSpace>
    name: inverse
    from_scene_reference: !<MatrixTransform> {matrix: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}
)";

class View : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    write("config.ocio", config);
  }

  std::string asked(const std::string& rest, const std::string& out) const {
    return "render " NACRE_SOURCE_DIR "/examples/documents/brass.mtlx --size 40x30 --spp 4 " +
           rest + " --out " + file(out);
  }
  std::string ocio() const { return " --ocio " + file("config.ocio"); }

  std::vector<float> pixels(const std::string& name) {
    const auto image = OIIO::ImageInput::open(file(name));
    if (image == nullptr) return {};
    text_ = image->spec().get_string_attribute("view");
    std::vector<float> pixels(image->spec().image_pixels() * 3);
    image->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data());
    return pixels;
  }

  std::string text_;
};

TEST_F(View, ShowsThePictureAsItsTransformSays) {
  ASSERT_EQ(run(asked("", "a.exr")), 0) << errors_;
  ASSERT_EQ(run(asked("--view Gamma --exposure 1" + ocio(), "gamma.png")), 0) << errors_;
  ASSERT_EQ(run(asked("--display Monitor" + ocio(), "default.png")), 0) << errors_;
  ASSERT_EQ(run(asked("--view Inverse" + ocio(), "inverse.png")), 0) << errors_;
  const std::vector<float> light = pixels("a.exr");
  ASSERT_EQ(light.size(), 3600u);
  const std::vector<float> brighter = pixels("gamma.png");
  EXPECT_EQ(text_, "Monitor, Gamma");
  const std::vector<float> plain = pixels("default.png"), inverse = pixels("inverse.png");
  ASSERT_TRUE(brighter.size() == 3600 && plain.size() == 3600 && inverse.size() == 3600);
  const auto byte = [](double v) { return std::round(255 * std::clamp(v, 0.0, 1.0)) / 255; };
  for (std::size_t i = 0; i < 3600; ++i) {
    const double v = light[i];
    EXPECT_NEAR(brighter[i], byte(std::pow(2 * v, 0.4)), 1.01 / 255) << i;
    EXPECT_NEAR(plain[i], byte(std::pow(v, 0.4)), 1.01 / 255) << i;
    EXPECT_NEAR(inverse[i], i % 3 == 0 ? 0.0 : byte(v), 1.01 / 255) << i;
  }
}

TEST_F(View, ThatCannotBeIsAnError) {
  EXPECT_EQ(run(asked("--view gamma" + ocio(), "a.png")), 1);
  EXPECT_TRUE(says("[unknown-view]") && says("'Gamma', 'Inverse'") && says("only in case"))
      << errors_;
  EXPECT_EQ(run(asked("--view Gamma", "a.png")), 1);
  EXPECT_TRUE(says("--ocio FILE")) << errors_;
  EXPECT_EQ(run(asked("--view Gamma" + ocio(), "a.exr")), 2);
  EXPECT_TRUE(says("[view-needs-png]")) << errors_;
  EXPECT_EQ(run(asked("--view Gamma --white 1" + ocio(), "a.png")), 2);
  EXPECT_TRUE(says("--white")) << errors_;
  EXPECT_FALSE(std::filesystem::exists(file("a.png")));
  EXPECT_FALSE(std::filesystem::exists(file("a.exr")));
}

}  // namespace
}  // namespace nacre
