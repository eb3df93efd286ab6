// measured_edf: radiance by direction, against the file looked up by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/jit/shading/engines.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::array<double, 3> along(double vertical, double horizontal) {
  return {std::sin(vertical * degree) * std::cos(horizontal * degree),
          std::sin(vertical * degree) * std::sin(horizontal * degree), std::cos(vertical * degree)};
}

class MeasuredEdf : public ::testing::TestWithParam<Backend> {
 protected:
  MeasuredEdf() {
    system_ = ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics_);
  }

  bool open(const std::string& profile) {
    if (!profile.empty()) folder_.write("light.ies", profile);
    const std::string path = folder_.write("test.mtlx", R"(<materialx version="1.39">
      <measured_edf name="e" type="EDF"><input name="color" type="color3" value="1, 0.5, 0"/>
        <input name="file" type="filename" value="light.ies"/></measured_edf>
      <light name="n" type="lightshader"><input name="edf" type="EDF" nodename="e"/></light>
    </materialx>)");
    document_ = read_document(path, {}, diagnostics_);
    ShaderOptions options;
    options.compile.backend = GetParam();
    options.missing_images = missing_;
    kernel_ = system_->compile_outputs(*document_, {"n"}, options, diagnostics_);
    return kernel_ != nullptr;
  }

  /// Red towards w, by the frame of the surface: the normal is y, the tangent z, so x is across.
  float radiance(std::array<double, 3> w) {
    const std::map<std::string, float> point{{"N.x", 0.0f},  {"N.y", 1.0f},  {"N.z", 0.0f},
                                             {"T.x", 0.0f},  {"T.y", 0.0f},  {"T.z", 1.0f},
                                             {"wo.x", w[1]}, {"wo.y", w[2]}, {"wo.z", w[0]}};
    const Program& program = kernel_->kernel.program();
    std::vector<const void*> in;
    for (const Channel& channel : program.inputs) in.push_back(&point.at(channel.name));
    std::vector<float> results(program.outputs.size());
    std::vector<void*> out;
    for (float& result : results) out.push_back(&result);
    EXPECT_EQ(kernel_->kernel.run(in, out, 1), RunStatus::done);
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (program.outputs[i].name == "n.intensity.x") return results[i];
    }
    ADD_FAILURE() << "no intensity";
    return 0.0f;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
  MissingImages missing_ = MissingImages::error;
  std::unique_ptr<ShadingSystem> system_;
  std::unique_ptr<Document> document_;
  std::unique_ptr<OutputKernel> kernel_;
};

// Twice as much over one half as uniform_edf, and nothing over the other.
TEST_P(MeasuredEdf, HasThePowerOfAUniformOne) {
  ASSERT_TRUE(open("TILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n7 7\n"))
      << diagnostics_.to_string();
  EXPECT_NEAR(radiance(along(0, 0)), 2.0, 1e-5);
  EXPECT_NEAR(radiance(along(89, 200)), 2.0, 1e-5);
  EXPECT_EQ(radiance(along(91, 200)), 0.0f);
}

// By hand: 10 cd at 0 degrees to 30 at 10, then to 0 at 90, twice that at 90 degrees around.
TEST_P(MeasuredEdf, IsLinearInBothAngles) {
  ASSERT_TRUE(open("TILT=NONE\n1 1 1 3 2 1 2 0 0 0\n1 1 1\n0 10 90\n0 90\n10 30 0\n20 60 0\n"))
      << diagnostics_.to_string();
  const double unit = radiance(along(10, 0)) / 30.0;
  ASSERT_GT(unit, 0.0);
  const auto expect = [&](double vertical, double horizontal, double candela) {
    EXPECT_NEAR(radiance(along(vertical, horizontal)) / unit, candela, 2e-3)
        << vertical << " " << horizontal;
  };
  expect(0.01, 0, 10.02), expect(5, 0, 20), expect(50, 0, 15), expect(5, 90, 40);
  expect(10, 45, 45), expect(10, 30, 40), expect(30, 30, 30);
  // All four quarters are alike, as mirrors see them.
  expect(10, 150, 40), expect(10, 210, 40), expect(10, 330, 40);
  expect(120, 30, 0);
}

// 1 cd to one side of the plane, 3 to the other.
TEST_P(MeasuredEdf, KnowsItsSides) {
  ASSERT_TRUE(open("TILT=NONE\n1 1 1 2 3 1 2 0 0 0\n1 1 1\n0 90\n90 180 270\n1 1\n2 2\n3 3\n"))
      << diagnostics_.to_string();
  const double unit = radiance(along(30, 90));
  EXPECT_NEAR(radiance(along(30, 180)) / unit, 2, 1e-4);
  EXPECT_NEAR(radiance(along(30, 0)) / unit, 2, 1e-4);
  EXPECT_NEAR(radiance(along(30, 45)) / unit, 1.5, 1e-4);
  EXPECT_NEAR(radiance(along(30, 315)) / unit, 2.5, 1e-4);
  EXPECT_NEAR(radiance(along(30, 225)) / unit, 2.5, 1e-4);
}

// Type B: the vertical angle goes around x; type A: the horizontal one around y.
TEST_P(MeasuredEdf, FloodlightsHaveTheirOwnAngles) {
  const auto text = [](int type) {
    return fmt::format(
        "TILT=NONE\n1 1 1 3 3 {} 2 0 0 0\n1 1 1\n-90 0 90\n-90 0 90\n"
        "0 0 0\n0 9 18\n0 18 36\n",
        type);
  };
  const auto at = [&](double x, double y, double z) { return radiance({x, y, z}); };
  const double v = 30 * degree, h = 60 * degree;
  for (const int type : {2, 3}) {
    ASSERT_TRUE(open(text(type))) << diagnostics_.to_string();
    const double unit = at(0, 0, 1) / 9.0;
    ASSERT_GT(unit, 0.0);
    // (1 + 30/90) (1 + 60/90) 9
    const double found =
        type == 2 ? at(std::sin(h), std::cos(h) * std::sin(v), std::cos(h) * std::cos(v))
                  : at(std::cos(v) * std::sin(h), std::sin(v), std::cos(v) * std::cos(h));
    EXPECT_NEAR(found / unit, 20, 1e-3) << type;
    EXPECT_EQ(at(0, 0.1, -std::sqrt(0.99)), 0.0f) << type;
  }
}

// A spot of two degrees: its edge is where the file has it, to a thousandth of a degree.
TEST_P(MeasuredEdf, NarrowSpotsKeepTheirDigits) {
  ASSERT_TRUE(open("TILT=NONE\n1 1 1 4 1 1 2 0 0 0\n1 1 1\n0 1 1.02 90\n0\n1 1 0 0\n"))
      << diagnostics_.to_string();
  const double unit = radiance(along(0, 0));
  EXPECT_NEAR(radiance(along(1.005, 77)) / unit, 0.75, 0.03);
  EXPECT_NEAR(radiance(along(1.015, 12)) / unit, 0.25, 0.03);
}

TEST_P(MeasuredEdf, AWrongFileIsSaidByItsLine) {
  open("TILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n7\n");
  EXPECT_TRUE(diagnostics_.has_errors());
  EXPECT_NE(diagnostics_.to_string().find("line 7: the file ends too early"), std::string::npos)
      << diagnostics_.to_string();
  diagnostics_ = {};
  missing_ = MissingImages::use_default;
  ASSERT_TRUE(open({}) && !diagnostics_.has_errors()) << diagnostics_.to_string();
  EXPECT_NE(diagnostics_.to_string().find("bad-light-profile"), std::string::npos);
  EXPECT_NEAR(radiance(along(130, 0)), 1.0, 1e-5);
}

TEST_P(MeasuredEdf, AMissingFileIsSaid) {
  open({});
  EXPECT_TRUE(diagnostics_.has_errors());
  EXPECT_NE(diagnostics_.to_string().find("there is no such file"), std::string::npos)
      << diagnostics_.to_string();
}

INSTANTIATE_TEST_SUITE_P(Engines, MeasuredEdf, all_engines(), engine_name);

}  // namespace
}  // namespace nacre
