#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "pbs/cosine_lobe.h"
#include "runtime/node/geometry.h"
#include "tests/pbs/battery/lobe_kernels.h"
#include "tests/support/closure.h"

namespace nacre {

/// A view at `angle` degrees to the normal z, turned by `azimuth` degrees; beyond
/// 90 from below.
inline Columns view(double angle, double azimuth = 30.0) {
  const double theta = angle * std::numbers::pi / 180.0;
  const double phi = azimuth * std::numbers::pi / 180.0;
  return {{"wo.x", {static_cast<float>(std::sin(theta) * std::cos(phi))}},
          {"wo.y", {static_cast<float>(std::sin(theta) * std::sin(phi))}},
          {"wo.z", {static_cast<float>(std::cos(theta))}},
          {"N.z", {1.0f}},
          {"T.x", {1.0f}}};
}

/// Roberts' sequence in three dimensions: powers of the root of x^4 = x + 1. As many of each are
/// made once.
inline const Columns& grid(int count) {
  static std::map<int, Columns> grids;
  Columns& made = grids[count];
  if (!made.empty()) return made;
  const std::pair<const char*, double> steps[] = {
      {"u.x", 0.8191725133961645}, {"u.y", 0.6710436067037893}, {"u.z", 0.5497004779019703}};
  for (const auto& [name, step] : steps) {
    std::vector<float>& column = made[name];
    for (int i = 0; i < count; ++i) {
      column.push_back(static_cast<float>(std::fmod(0.5 + i * step, 1.0)));
    }
  }
  return made;
}

/// All light that a surface in a white world sends to the viewer: the mean weight
/// of samples on a grid of random numbers.
class Furnace {
 public:
  template <class F>
  explicit Furnace(F&& make, Bool thin_walled = false, Accuracy accuracy = Accuracy::standard) {
    Recorder recorder;
    Surface surface;
    surface.bsdf = make(recorder);
    surface.thin_walled = thin_walled;
    const SurfaceKernels kernels = record_kernels(recorder, surface, accuracy, {});
    std::vector<SliceOutput> weight = kernels.sample;
    std::erase_if(weight, [](const SliceOutput& each) { return each.name != "weight.x"; });
    Program sample = slice(recorder.program(), "sample", weight, Keeps::load);
    const std::vector<SliceOutput> state = state_outputs(recorder, state_channels(sample));
    // What a view costs is paid once, by `begin`.
    if (!state.empty()) begin_ = lobe_kernel(slice(recorder.program(), "begin", state), accuracy);
    sample_ = lobe_kernel(std::move(sample), accuracy);
    albedo_ = lobe_kernel(slice(recorder.program(), "albedo", kernels.albedo), accuracy);
  }

  double light(double angle, double azimuth = 30.0, int count = 1 << 18) const {
    Columns in = view(angle, azimuth);
    if (begin_) in.merge(run(*begin_, in));
    const Columns& u = grid(count);
    in.insert(u.begin(), u.end());
    const auto out = run(*sample_, in);
    double sum = 0.0;
    for (const float weight : out.at("weight.x")) sum += weight;
    return sum / count;
  }

  double albedo(double angle, double azimuth = 30.0) const {
    return run(*albedo_, view(angle, azimuth)).at("albedo.x")[0];
  }

 private:
  std::shared_ptr<const Kernel> begin_, sample_, albedo_;
};

inline BsdfPtr white_diffuse(Recorder& recorder) {
  const auto lobe = std::make_shared<LambertLobe>("white", CosineLobe::Hemisphere::viewer,
                                                  normal(recorder, Space::world), Color3(1.0f));
  return std::make_shared<LobeBsdf>(lobe, 1.0f);
}

/// Degrees from the normal, from either side.
inline constexpr double outside[] = {0.0, 30.0, 60.0, 75.0, 85.0};
inline constexpr double inside[] = {180.0, 160.0, 140.0, 130.0, 120.0, 105.0, 95.0};

}  // namespace nacre
