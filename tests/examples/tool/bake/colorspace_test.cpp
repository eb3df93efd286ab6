// Textures in the colour space that an <output> asks for.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

using Color = std::array<double, 3>;

struct Expected {
  const char* space;
  Color of_red;   ///< Of (1, 0, 0) in lin_rec709.
  Color of_grey;  ///< Of (0.5, 0.5, 0.5).
};

class BakeColorspace : public Tool, public ::testing::WithParamInterface<Expected> {
 protected:
  static std::string document(std::string_view space, std::string_view color) {
    return "<materialx version=\"1.39\" colorspace=\"lin_rec709\"><nodegraph name=\"G\">"
           "<texcoord name=\"uv\" type=\"vector2\"/><extract name=\"u\" type=\"float\">"
           "<input name=\"in\" type=\"vector2\" nodename=\"uv\"/></extract>"
           "<constant name=\"c\" type=\"color3\"><input name=\"value\" type=\"color3\" value=\"" +
           std::string(color) +
           "\"/></constant><multiply name=\"shade\" type=\"color3\">"
           "<input name=\"in1\" type=\"color3\" nodename=\"c\"/>"
           "<input name=\"in2\" type=\"float\" nodename=\"u\"/></multiply>"
           "<output name=\"o\" type=\"color3\" nodename=\"c\" colorspace=\"" +
           std::string(space) +
           "\"/><output name=\"v\" type=\"color3\" nodename=\"shade\" colorspace=\"" +
           std::string(space) +
           "\"/></nodegraph><standard_surface name=\"S\" type=\"surfaceshader\">"
           "<input name=\"base_color\" type=\"color3\" nodegraph=\"G\" output=\"v\"/>"
           "<input name=\"coat_color\" type=\"color3\" nodegraph=\"G\" output=\"o\"/>"
           "</standard_surface><surfacematerial name=\"M\" type=\"material\">"
           "<input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"S\"/>"
           "</surfacematerial></materialx>";
  }

  void expect_texel(std::string_view color, const Color& wanted, const std::string& options = "") {
    write("c.mtlx", document(GetParam().space, color));
    ASSERT_EQ(run("bake " + file("c.mtlx") + " --no-cache --size 1 --output G/o --out " +
                  folder_.path().string() + " " + options),
              0)
        << errors_;
    const auto image = OIIO::ImageInput::open(file("G.o.exr"));
    ASSERT_NE(image, nullptr);
    std::array<float, 3> texel{};
    ASSERT_TRUE(image->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, texel.data()));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(texel[c], wanted[c], 2e-4) << c;
  }
};

TEST_P(BakeColorspace, HoldsItsNumbers) {
  expect_texel("1, 0, 0", GetParam().of_red);
  expect_texel("0.5, 0.5, 0.5", GetParam().of_grey);
  // Whatever the graph computes in.
  expect_texel("1, 0, 0", GetParam().of_red, "--working-space acescg");
}

/// Within every gamut, so that nothing is clipped. The data library's matrix leads back
/// from P3 and is 1e-5 off what the primaries give (1.22493029 for 1.22494018), as is
/// allowed for in tests/conformance/colorspace_test.cpp.
TEST_P(BakeColorspace, ComesBackFromABakedDocument) {
  write("c.mtlx", document(GetParam().space, "0.6, 0.3, 0.2"));
  ASSERT_EQ(run("bake " + file("c.mtlx") + " --no-cache --size 8 --document " + file("d.mtlx") +
                " --out " + file("t")),
            0)
      << errors_;
  const auto before = read(file("c.mtlx")), after = read(file("d.mtlx"));
  const std::vector<float> a = values(*before, "G/v", 8);
  const std::vector<float> b = values(*after, "NG_baked_S/base_color_output", 8);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 4e-6) << i;
  // The constant has become a value of that space.
  const Element& coat = *after->root().child("S")->child("coat_color");
  const std::string graph =
      "<materialx version=\"1.39\"><constant name=\"c\" type=\"color3\">"
      "<input name=\"value\" type=\"color3\" value=\"" +
      std::string(coat.attribute("value")) + "\" colorspace=\"" +
      std::string(coat.inherited_attribute("colorspace")) +
      "\"/></constant><output name=\"o\" type=\"color3\" "
      "nodename=\"c\"/></materialx>";
  const auto constant = read(write("e.mtlx", graph));
  const std::vector<float> value = values(*constant, "o", 1);
  ASSERT_EQ(value.size(), 3u);
  EXPECT_NEAR(value[0], 0.6, 4e-6);
  EXPECT_NEAR(value[1], 0.3, 4e-6);
  EXPECT_NEAR(value[2], 0.2, 4e-6);
}

// Rec. 709 to AP1 and to P3-D65 by Bradford adaptation, as published with the Academy's
// and the Color Interop Forum's configurations for OpenColorIO; 0.5^(1/2.2) = 0.72974,
// 0.5^(256/563) = 0.72969; sRGB's curve of 0.5 is 0.73536, of the P3 red's components
// 0.91749, 0.20028, 0.13856 (IEC 61966-2-1).
INSTANTIATE_TEST_SUITE_P(
    Spaces, BakeColorspace,
    ::testing::Values(
        Expected{"acescg", {0.61310, 0.07019, 0.02062}, {0.5, 0.5, 0.5}},
        Expected{"lin_ap1_scene", {0.61310, 0.07019, 0.02062}, {0.5, 0.5, 0.5}},
        Expected{"lin_p3d65", {0.82246, 0.03319, 0.01708}, {0.5, 0.5, 0.5}},
        Expected{"g22_rec709", {1, 0, 0}, {0.72974, 0.72974, 0.72974}},
        Expected{"srgb_displayp3", {0.91749, 0.20028, 0.13856}, {0.73536, 0.73536, 0.73536}},
        Expected{"srgb_tx", {1, 0, 0}, {0.73536, 0.73536, 0.73536}},
        Expected{"lin_rec709", {1, 0, 0}, {0.5, 0.5, 0.5}}),
    [](const auto& one) { return std::string(one.param.space); });

}  // namespace
}  // namespace nacre
