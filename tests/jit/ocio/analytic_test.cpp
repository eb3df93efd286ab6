// Operators that are formulas, both ways.
#include <algorithm>

#include "tests/jit/ocio/config_fixture.h"

namespace nacre {
namespace {

namespace ocio = OCIO_NAMESPACE;

using Transform = ocio::ConstTransformRcPtr;
using Four = std::array<double, 4>;
using Three = std::array<double, 3>;

Transform matrix(const std::array<double, 16>& m, const Four& offset) {
  const auto made = ocio::MatrixTransform::Create();
  made->setMatrix(m.data());
  made->setOffset(offset.data());
  return made;
}

Transform exponent(const Four& value, ocio::NegativeStyle style) {
  const auto made = ocio::ExponentTransform::Create();
  made->setValue(*reinterpret_cast<const double(*)[4]>(value.data()));
  made->setNegativeStyle(style);
  return made;
}

Transform with_linear(double gamma, double offset, ocio::NegativeStyle style) {
  const auto made = ocio::ExponentWithLinearTransform::Create();
  const double gammas[4] = {gamma, gamma, gamma, 1};
  const double offsets[4] = {offset, offset, offset, 0};
  made->setGamma(gammas);
  made->setOffset(offsets);
  made->setNegativeStyle(style);
  return made;
}

/// OpenColorIO computes in single precision; errors count in its roundings.
constexpr double roundings(int count) { return count * 0x1p-24; }

class Analytic : public Config {
 protected:
  /// Both directions of each.
  void check(const Spaces& spaces, const std::vector<Rgba>& colors, double there, double back) {
    open(spaces);
    for (const auto& [name, transform] : spaces) {
      expect_agreement(colors, name, "linear", there);
      expect_agreement(colors, "linear", name, back);
    }
  }
};

TEST_F(Analytic, Matrices) {
  check(
      {{"primaries",
        matrix({0.4123907993, 0.3575843394, 0.1804807884, 0, 0.2126390059, 0.7151686788,
                0.0721923154, 0, 0.0193308187, 0.1191947798, 0.9505321522, 0, 0, 0, 0, 1},
               {0, 0, 0, 0})},
       {"affine", matrix({1.5, -0.2, 0.1, 0.05, 0.3, 0.9, -0.4, 0, 0.2, 0.2, 1.1, 0, 0, 0, 0, 0.5},
                         {0.1, -0.25, 0.5, 0.25})}},
      colors(), roundings(16), roundings(16));
}

TEST_F(Analytic, Exponents) {
  check({{"clamped", exponent({2.2, 1.8, 2.6, 1}, ocio::NEGATIVE_CLAMP)},
         {"mirrored", exponent({2.2, 1.8, 2.6, 1.2}, ocio::NEGATIVE_MIRROR)},
         {"passed", exponent({2.2, 1.8, 2.6, 1}, ocio::NEGATIVE_PASS_THRU)},
         {"srgb", with_linear(2.4, 0.055, ocio::NEGATIVE_LINEAR)},
         {"srgb mirrored", with_linear(2.4, 0.055, ocio::NEGATIVE_MIRROR)},
         {"rec709", with_linear(1 / 0.45, 0.099, ocio::NEGATIVE_LINEAR)}},
        colors(), roundings(16), roundings(16));
}

Transform logarithm(double base) {
  const auto made = ocio::LogTransform::Create();
  made->setBase(base);
  return made;
}

Transform affine_log() {
  const auto made = ocio::LogAffineTransform::Create();
  const double log_slope[3] = {0.3, 0.31, 0.29}, log_offset[3] = {0.5, 0.55, 0.45};
  const double lin_slope[3] = {1.1, 1.0, 0.9}, lin_offset[3] = {0.01, 0.02, 0.005};
  made->setBase(10);
  made->setLogSideSlopeValue(log_slope);
  made->setLogSideOffsetValue(log_offset);
  made->setLinSideSlopeValue(lin_slope);
  made->setLinSideOffsetValue(lin_offset);
  return made;
}

Transform camera_log() {
  const double breaks[3] = {0.005, 0.006, 0.004};
  const double log_slope[3] = {0.25, 0.25, 0.25}, log_offset[3] = {0.38, 0.38, 0.38};
  const double lin_slope[3] = {5.5, 5.5, 5.5}, lin_offset[3] = {0.052, 0.052, 0.052};
  const auto made = ocio::LogCameraTransform::Create(breaks);
  made->setBase(10);
  made->setLogSideSlopeValue(log_slope);
  made->setLogSideOffsetValue(log_offset);
  made->setLinSideSlopeValue(lin_slope);
  made->setLinSideOffsetValue(lin_offset);
  return made;
}

TEST_F(Analytic, Logarithms) {
  check({{"base 2", logarithm(2)},
         {"base 10", logarithm(10)},
         {"affine", affine_log()},
         {"camera", camera_log()}},
        // The other way: b^x as 2^(x log2(b)), whose exponent is up to 128 and rounded twice.
        colors(), roundings(16), roundings(2 * 89));
}

Transform cdl(ocio::CDLStyle style) {
  const auto made = ocio::CDLTransform::Create();
  const double slope[3] = {1.1, 0.9, 1.05}, offset[3] = {0.02, -0.03, 0.01},
               power[3] = {1.2, 0.8, 1.0};
  made->setSlope(slope);
  made->setOffset(offset);
  made->setPower(power);
  made->setSat(0.7);
  made->setStyle(style);
  return made;
}

Transform range() {
  const auto made = ocio::RangeTransform::Create();
  made->setMinInValue(0.1);
  made->setMaxInValue(0.9);
  made->setMinOutValue(-0.5);
  made->setMaxOutValue(2);
  return made;
}

Transform exposure_contrast(ocio::ExposureContrastStyle style) {
  const auto made = ocio::ExposureContrastTransform::Create();
  made->setStyle(style);
  made->setExposure(1.3);
  made->setContrast(0.85);
  made->setGamma(1.1);
  made->setPivot(0.18);
  return made;
}

TEST_F(Analytic, CdlsRangesAndExposures) {
  check({{"cdl", cdl(ocio::CDL_ASC)},
         {"cdl unclamped", cdl(ocio::CDL_NO_CLAMP)},
         {"range", range()},
         {"exposure linear", exposure_contrast(ocio::EXPOSURE_CONTRAST_LINEAR)},
         {"exposure video", exposure_contrast(ocio::EXPOSURE_CONTRAST_VIDEO)},
         {"exposure log", exposure_contrast(ocio::EXPOSURE_CONTRAST_LOGARITHMIC)}},
        colors(), roundings(16), roundings(16));
}

Transform fixed(ocio::FixedFunctionStyle style) {
  return ocio::FixedFunctionTransform::Create(style);
}

TEST_F(Analytic, FixedFunctions) {
  const double surround[1] = {0.78};
  check({{"surround",
          ocio::FixedFunctionTransform::Create(ocio::FIXED_FUNCTION_REC2100_SURROUND, surround, 1)},
         {"hsv", fixed(ocio::FIXED_FUNCTION_RGB_TO_HSV)},
         {"xyY", fixed(ocio::FIXED_FUNCTION_XYZ_TO_xyY)},
         {"uvY", fixed(ocio::FIXED_FUNCTION_XYZ_TO_uvY)},
         {"luv", fixed(ocio::FIXED_FUNCTION_XYZ_TO_LUV)}},
        colors(), roundings(32), roundings(32));
}

/// For colours that are not dark, and back for what comes of those: elsewhere OpenColorIO's
/// text for graphics cards and its processor for the CPU are not the same functions. The
/// text differs where the brightest component is exactly 0, and its inverse of "red 03"
/// where scaling the chroma would change which component is brightest.
TEST_F(Analytic, AcesFunctions) {
  std::vector<Rgba> bright;
  for (const Rgba& color : colors()) {
    if (std::min({color[0], color[1], color[2]}) >= 0.03f) bright.push_back(color);
  }
  const double compression[7] = {1.147, 1.264, 1.312, 0.815, 0.803, 0.88, 1.2};
  const Spaces spaces{{"red 03", fixed(ocio::FIXED_FUNCTION_ACES_RED_MOD_03)},
                      {"red 10", fixed(ocio::FIXED_FUNCTION_ACES_RED_MOD_10)},
                      {"glow 03", fixed(ocio::FIXED_FUNCTION_ACES_GLOW_03)},
                      {"glow 10", fixed(ocio::FIXED_FUNCTION_ACES_GLOW_10)},
                      {"dim", fixed(ocio::FIXED_FUNCTION_ACES_DARK_TO_DIM_10)},
                      {"gamut", ocio::FixedFunctionTransform::Create(
                                    ocio::FIXED_FUNCTION_ACES_GAMUT_COMP_13, compression, 7)}};
  open(spaces);
  for (const auto& [name, transform] : spaces) {
    expect_agreement(bright, name, "linear", roundings(32));
    expect_agreement(oracle(bright, name, "linear"), "linear", name, roundings(32));
  }
}

Transform grading_primary(ocio::GradingStyle style) {
  const auto made = ocio::GradingPrimaryTransform::Create(style);
  ocio::GradingPrimary values(style);
  values.m_brightness = {0.02, -0.01, 0.03, 0.01};
  values.m_contrast = {1.1, 0.9, 1.05, 1.2};
  values.m_gamma = {1.1, 0.95, 1.0, 1.05};
  values.m_offset = {0.01, 0.02, -0.01, 0.0};
  values.m_exposure = {0.2, -0.1, 0.0, 0.3};
  values.m_lift = {0.01, 0.0, 0.02, 0.0};
  values.m_gain = {1.1, 1.0, 0.9, 1.05};
  values.m_saturation = 1.2;
  made->setValue(values);
  return made;
}

Transform grading_curve(ocio::GradingStyle style) {
  const auto made = ocio::GradingRGBCurveTransform::Create(style);
  const auto red = ocio::GradingBSplineCurve::Create({{-0.2f, -0.1f}, {0.4f, 0.5f}, {1.2f, 1.0f}});
  const auto green =
      ocio::GradingBSplineCurve::Create({{0, 0.02f}, {0.3f, 0.2f}, {0.7f, 0.75f}, {1, 1.1f}});
  const auto straight = ocio::GradingBSplineCurve::Create({{0, 0}, {1, 1}});
  made->setValue(ocio::GradingRGBCurve::Create(red, green, straight, red));
  return made;
}

Transform grading_tone(ocio::GradingStyle style) {
  const auto made = ocio::GradingToneTransform::Create(style);
  ocio::GradingTone values(style);
  values.m_blacks.m_red = 1.1;
  values.m_shadows.m_green = 0.8;
  values.m_midtones.m_blue = 1.3;
  values.m_highlights.m_master = 1.2;
  values.m_whites.m_red = 0.9;
  values.m_scontrast = 1.15;
  made->setValue(values);
  return made;
}

/// Over the range that is graded: the linear style works on powers of two, so that far
/// outside of it roundings grow as in the logarithms above.
TEST_F(Analytic, Grading) {
  std::vector<Rgba> usual;
  for (const Rgba& color : colors()) {
    const auto [least, most] = std::minmax({color[0], color[1], color[2]});
    if (least >= -1 && most <= 8) usual.push_back(color);
  }
  for (const auto style : {ocio::GRADING_LOG, ocio::GRADING_LIN, ocio::GRADING_VIDEO}) {
    const Spaces spaces{{"primary", grading_primary(style)},
                        {"curve", grading_curve(style)},
                        {"tone", grading_tone(style)}};
    open(spaces);
    for (const auto& [name, transform] : spaces) {
      // 2^x by x of up to about 16, which is rounded some six times.
      const double error = style == ocio::GRADING_LIN ? roundings(16 * 6) : roundings(16);
      expect_agreement(usual, name, "linear", error);
      // OpenColorIO 2.1's text for the inverse of this one is not GLSL.
      if (style == ocio::GRADING_VIDEO && name == "primary") continue;
      expect_agreement(usual, "linear", name, error);
    }
  }
}

}  // namespace
}  // namespace nacre
