// A part of uv in place of the whole: bake --window.
#include <OpenImageIO/imageio.h>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

constexpr const char* document = R"(<materialx version="1.39">
  <nodegraph name="G">
    <texcoord name="uv" type="vector2"/>
    <output name="uv_out" type="vector2" nodename="uv"/>
    <fractal2d name="f" type="float"><input name="octaves" type="integer" value="5"/></fractal2d>
    <output name="f_out" type="float" nodename="f"/>
  </nodegraph>
</materialx>)";

class BakeWindow : public Tool {
 protected:
  /// Texels of GRAPH/NAME, baked as asked.
  std::vector<float> baked(const std::string& name, const std::string& arguments) {
    const std::string out = file("out");
    EXPECT_EQ(run("bake " + write("a.mtlx", document) + " --output G/" + name + " --out " + out +
                  " " + arguments),
              0)
        << errors_;
    const auto in = OIIO::ImageInput::open(out + "/G." + name + ".exr");
    if (in == nullptr) return {};
    const int channels = in->spec().nchannels;
    std::vector<float> texels(in->spec().image_pixels() * static_cast<std::size_t>(channels));
    EXPECT_TRUE(in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, texels.data()));
    return texels;
  }
};

TEST_F(BakeWindow, CornersAreLowerLeftAndUpperRight) {
  // Middles of 2 x 2 texels over u from -1 to 1 and v from 0.5 to 1, rows from the top.
  EXPECT_EQ(baked("uv_out", "--size 2 --window -1 0.5 1 1"),
            (std::vector<float>{-0.5f, 0.875f, 0.5f, 0.875f, -0.5f, 0.625f, 0.5f, 0.625f}));
}

TEST_F(BakeWindow, IsThatPartOfTheWholeWithTheSameBits) {
  constexpr std::size_t size = 16, part = 8;
  const std::vector<float> whole = baked("f_out", "--size 16 --samples 4");
  const std::vector<float> upper_right =
      baked("f_out", "--size 8 --samples 4 --window 0.5 0.5 1 1");
  ASSERT_EQ(whole.size(), size * size);
  ASSERT_EQ(upper_right.size(), part * part);
  for (std::size_t j = 0; j < part; ++j) {
    for (std::size_t i = 0; i < part; ++i) {
      EXPECT_EQ(upper_right[j * part + i], whole[j * size + i + part]) << i << ' ' << j;
    }
  }
}

TEST_F(BakeWindow, MeansNothingEmptyOrBesideWhatSaysAnother) {
  const std::string bake = "bake " + write("a.mtlx", document) + " --out " + file("out");
  EXPECT_EQ(run(bake + " --window 0 0 0 1"), 2);
  EXPECT_TRUE(says("--window: it is empty")) << errors_;
  EXPECT_EQ(run(bake + " --window 0 0 1"), 2);
  EXPECT_EQ(run(bake + " --window 0 0 nan 1"), 2);
  EXPECT_EQ(run(bake + " --window 0 0 1 1 --udim 1001"), 2);
  EXPECT_EQ(run(bake + " --window 0 0 1 1 --scene builtin"), 2);
}

// Who goes on with a bake of another window gets other images.
TEST_F(BakeWindow, IsInTheManifest) {
  const std::string bake = "bake " + write("a.mtlx", document) + " --size 4 --out " + file("out") +
                           " --manifest " + file("m.json");
  EXPECT_EQ(run(bake + " --window 0 0 0.5 0.5"), 0) << errors_;
  const std::string before = text_of(file("out/G.f_out.exr"));
  EXPECT_EQ(run(bake + " --window 0 0 0.25 0.5"), 0) << errors_;
  EXPECT_NE(text_of(file("out/G.f_out.exr")), before);
}

}  // namespace
}  // namespace nacre
