#include "jit/graph/color/colorspace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "examples/bake/bake.h"
#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

using Rgb = std::vector<float>;

const std::vector<std::string>& linear_spaces() {
  static const std::vector<std::string> names{"lin_rec709",   "lin_rec2020",   "lin_ap0",
                                              "acescg",       "lin_displayp3", "lin_adobergb",
                                              "lin_ciexyzd65"};
  return names;
}

const std::vector<std::string>& encoded_spaces() {
  static const std::vector<std::string> names{"srgb_texture", "srgb_displayp3", "srgb_ap1",
                                              "g18_rec709",   "g22_rec709",     "rec709_display",
                                              "g22_ap1",      "adobergb"};
  return names;
}

class ColorSpaces : public ::testing::Test {
 protected:
  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  /// A colour written in one space, as a graph that computes in another has it.
  Rgb convert(const Rgb& rgb, const std::string& from, const std::string& to) {
    const std::string type = rgb.size() == 3 ? "color3" : "color4";
    std::string value;
    for (const float x : rgb) {
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.9g", static_cast<double>(x));
      value += (value.empty() ? "" : ", ") + std::string(text.data());
    }
    const auto document = read_document_text(
        "<materialx version=\"1.39\"><constant name=\"c\" type=\"" + type +
            "\"><input name=\"value\" type=\"" + type + "\" value=\"" + value + "\" colorspace=\"" +
            from + "\"/></constant><output name=\"out\" type=\"" + type +
            "\" nodename=\"c\"/></materialx>",
        "test.mtlx", {}, diagnostics_);
    ShaderOptions options;
    options.compile.backend = Backend::interpreter;
    options.compile.accuracy = Accuracy::precise;
    options.graph.working_space = to;
    const auto kernel = system_->compile_outputs(*document, {"out"}, options, diagnostics_);
    if (kernel == nullptr) return {};
    return host::bake_image(*kernel, 0, {.width = 1, .height = 1, .threads = 1});
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

void expect_near(const Rgb& found, const Rgb& expected, double error, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], error) << what;
}

void expect_matrix(std::string_view from, std::string_view to, const ColorMatrix& columns,
                   double error) {
  const auto matrix = color_matrix(from, to);
  ASSERT_TRUE(matrix);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR((*matrix)[j][i], columns[i][j], error) << from << ' ' << to << i << j;
    }
  }
}

/// Matrices as published, for columns.
TEST_F(ColorSpaces, PrimariesGiveThePublishedMatrices) {
  // ITU-R BT.2087-0, Annex 2.
  expect_matrix("lin_rec709", "lin_rec2020",
                {{{0.6274, 0.3293, 0.0433}, {0.0691, 0.9195, 0.0114}, {0.0164, 0.0880, 0.8956}}},
                5e-5);
  // IEC 61966-2-1, equation 7.
  expect_matrix("lin_rec709", "lin_ciexyzd65",
                {{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}},
                6e-5);
  // Academy S-2014-004, Annex B.
  expect_matrix("lin_ap0", "acescg",
                {{{1.4514393161, -0.2365107469, -0.2149285693},
                  {-0.0765537734, 1.1762296998, -0.0996759264},
                  {0.0083161484, -0.0060324498, 0.9977163014}}},
                1e-9);
  // Adobe RGB (1998), 4.3.5.3.
  expect_matrix(
      "lin_adobergb", "lin_ciexyzd65",
      {{{0.57667, 0.18556, 0.18823}, {0.29734, 0.62736, 0.07529}, {0.02703, 0.07069, 0.99134}}},
      1e-5);
}

TEST_F(ColorSpaces, WhiteStaysWhite) {
  for (const auto* from : {&linear_spaces(), &encoded_spaces()}) {
    for (const std::string& space : *from) {
      if (space == "lin_ciexyzd65") continue;
      expect_near(convert({1, 1, 1}, space, "lin_rec709"), {1, 1, 1}, 4e-6, space);
      expect_near(convert({1, 1, 1}, "lin_rec709", space), {1, 1, 1}, 4e-6, space);
      expect_near(convert({1, 1, 1}, "lin_rec2020_scene", space), {1, 1, 1}, 4e-6, space);
    }
  }
  expect_near(convert({1, 1, 1}, "acescg", "lin_ciexyzd65"),
              {0.3127f / 0.3290f, 1.0f, (1.0f - 0.3127f - 0.3290f) / 0.3290f}, 2e-6, "xyz");
}

/// There by the library's transforms where it has them, back by ours.
TEST_F(ColorSpaces, TransformsAndTheirInversesMeet) {
  double worst = 0;
  for (const auto* spaces : {&linear_spaces(), &encoded_spaces()}) {
    for (const std::string& space : *spaces) {
      for (const Rgb& rgb :
           {Rgb{0.18f, 0.18f, 0.18f}, Rgb{0.5f, 0.4f, 0.45f}, Rgb{0.03f, 0.025f, 0.03f},
            Rgb{0.002f, 0.002f, 0.002f}, Rgb{0.9f, 0.8f, 0.85f}}) {
        const Rgb there = convert(rgb, space, "lin_rec709");
        const Rgb back = convert(there, "lin_rec709", space);
        expect_near(back, rgb, 4e-6, space);
        for (std::size_t i = 0; i < 3; ++i)
          worst = std::max(worst, std::fabs(double{back[i]} - rgb[i]));
      }
    }
  }
  std::cout << "round trip: " << worst << "\n";
}

TEST_F(ColorSpaces, CurvesAreTheStandards) {
  // IEC 61966-2-1, 5.2, both pieces; Adobe RGB (1998), 4.3.4.2.
  const auto srgb = [](double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  };
  for (const double c : {0.0, 0.001, 0.003, 0.0032, 0.05, 0.5, 1.0, 4.0}) {
    const auto light = static_cast<float>(c);
    EXPECT_NEAR(convert({light, light, light}, "lin_rec709", "srgb_texture")[1], srgb(c),
                1e-6 + 1e-6 * c);
    EXPECT_NEAR(convert({light, light, light}, "lin_rec709", "g22_rec709_scene")[0],
                std::pow(c, 1 / 2.2), 1e-6 + 1e-6 * c);
    EXPECT_NEAR(convert({light, light, light}, "lin_adobergb", "adobergb")[2],
                std::pow(c, 256.0 / 563.0), 1e-6 + 1e-6 * c);
  }
  // Less than nothing is nothing, as in the library's decoding.
  EXPECT_EQ(convert({-0.5f, -0.5f, -0.5f}, "lin_rec709", "g22_rec709")[0], 0.0f);
}

TEST_F(ColorSpaces, AlphaIsNotConverted) {
  const Rgb rgb = convert({0.2f, 0.3f, 0.4f}, "srgb_texture", "acescg");
  expect_near(convert({0.2f, 0.3f, 0.4f, 0.25f}, "srgb_texture", "acescg"),
              {rgb[0], rgb[1], rgb[2], 0.25f}, 0.0, "color4");
}

/// Names of the Color Interop Forum, of MaterialX and of OCIO configurations.
TEST_F(ColorSpaces, AnyNameOfASpaceWillDo) {
  const Rgb rgb{0.2f, 0.5f, 0.3f};
  EXPECT_EQ(convert(rgb, "ACES2065-1", "lin_rec709"), convert(rgb, "lin_ap0_scene", "lin_rec709"));
  EXPECT_EQ(convert(rgb, "Linear Rec.2020", "acescg"),
            convert(rgb, "lin_rec2020_scene", "lin_ap1_scene"));
  EXPECT_EQ(convert(rgb, "data", "acescg"), rgb);
  EXPECT_EQ(convert(rgb, "raw", "lin_rec709"), rgb);
  EXPECT_EQ(convert(rgb, "srgb_texture", "none"), rgb);
  EXPECT_EQ(convert(rgb, "lin_ap1_scene", "acescg"), rgb);
}

TEST_F(ColorSpaces, UnknownOnesAreErrors) {
  EXPECT_TRUE(convert({1, 0, 0}, "my_monitor", "lin_rec709").empty());
  EXPECT_TRUE(convert({1, 0, 0}, "acescg", "my_monitor").empty());
  ASSERT_EQ(diagnostics_.error_count(), 2u);
  EXPECT_EQ(diagnostics_.all().front().code, "unknown-colorspace");
}

}  // namespace
}  // namespace nacre
