// T-SPEC: a lobe whose inputs are constants against the same lobe whose inputs are channels. They
// cannot have the same bits: a product of constants is rounded before it is added, where that of a
// channel goes into one fused operation, and tables are read by folded axes. How far apart they may
// be is bounded here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/pbs/battery/lobe_kernels.h"

namespace nacre {
namespace {

constexpr std::size_t count = 1500;
constexpr float index_of_glass = 1.5f;

struct Pair {
  std::shared_ptr<const Kernel> evaluate, albedo;
};

Pair folded(const LobeCase& row, Accuracy accuracy, float roughness) {
  Recorder recorder;
  const LobeInputs inputs{.roughness = roughness, .color = Color3(1.0f), .index = index_of_glass};
  Surface surface;
  surface.bsdf = make_lobe(recorder, row, inputs, accuracy);
  const SurfaceKernels kernels = record_kernels(recorder, surface, accuracy, {});
  return {lobe_kernel(slice(recorder.program(), "evaluate", kernels.evaluate), accuracy),
          lobe_kernel(slice(recorder.program(), "albedo", kernels.albedo), accuracy)};
}

Pair open(const LobeCase& row, Accuracy accuracy) {
  LobePrograms programs = lobe_programs(row, accuracy);
  return {lobe_kernel(std::move(programs.evaluate), accuracy),
          lobe_kernel(std::move(programs.albedo), accuracy)};
}

/// Relative differences, of numbers that are at least a millionth of the largest.
void compare(const std::vector<float>& a, const std::vector<float>& b,
             std::vector<double>& differences) {
  const double peak = *std::ranges::max_element(a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double scale = std::max({double(std::abs(a[i])), 1e-6 * peak, 1e-30});
    differences.push_back(std::abs(double(a[i]) - b[i]) / scale);
  }
}

class Specialization : public testing::TestWithParam<std::tuple<LobeCase, Accuracy>> {};

TEST_P(Specialization, OfConstantsChangesRoundingAlone) {
  const auto& [row, accuracy] = GetParam();
  const Pair of_channels = open(row, accuracy);
  std::vector<double> differences;
  for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
    const Pair of_constants = folded(row, accuracy, roughness);
    for (const double angle : {0.0, 30.0, 60.0, 80.0, 160.0}) {
      Columns columns = lobe_columns(roughness);
      columns["index"] = {index_of_glass};
      set_directions(columns, "wo", {direction(angle)});
      compare(run(*of_channels.albedo, columns).at("albedo.x"),
              run(*of_constants.albedo, columns).at("albedo.x"), differences);
      // Over the sphere, evenly.
      std::vector<Direction> wi;
      for (std::size_t i = 0; i < count; ++i) {
        const double z = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / count;
        wi.push_back(direction(std::acos(z) * 57.29577951308232,
                               std::fmod(137.508 * static_cast<double>(i), 360.0)));
      }
      set_directions(columns, "wi", wi);
      const Columns a = run(*of_channels.evaluate, columns);
      const Columns b = run(*of_constants.evaluate, columns);
      for (const char* name : {"f.x", "pdf"}) compare(a.at(name), b.at(name), differences);
    }
  }
  std::ranges::sort(differences);
  const auto quantile = [&](double share) {
    return differences[static_cast<std::size_t>(share *
                                                static_cast<double>(differences.size() - 1))];
  };
  fmt::print("| {} {} | {:.1e} | {:.1e} |\n", row.name, accuracy_name(accuracy), quantile(1.0),
             quantile(0.999));
  // Each is as near to double precision as that, so they are no further apart.
  const RoundingBounds& bounds = accuracy == Accuracy::fast ? row.fast : row.standard;
  EXPECT_LE(quantile(0.999), 2.0 * bounds.value);
}

std::string case_name(const testing::TestParamInfo<std::tuple<LobeCase, Accuracy>>& info) {
  return std::get<0>(info.param).name + "_" + std::string(accuracy_name(std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(All, Specialization,
                         testing::Combine(testing::ValuesIn(lobe_cases()),
                                          testing::Values(Accuracy::standard, Accuracy::precise)),
                         case_name);

}  // namespace
}  // namespace nacre
