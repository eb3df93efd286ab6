#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "examples/render/gltf_accessor.h"
#include "examples/render/scene_budget.h"

namespace nacre::host {

/// An animation sampler (glTF 2.0, 3.11 and Appendix C): one, three or four numbers over time.
class GltfTrack {
 public:
  enum class Interpolation { step, linear, cubic };
  using Value = std::array<double, 4>;  ///< The fourth of rotations, xyzw, alone.

  /// Null, with an error, unless the times ascend, all is finite, and there are as many values
  /// as times; rotations need an axis.
  static std::unique_ptr<GltfTrack> read(const GltfValue& sampler, bool is_rotation,
                                         GltfAccessors& accessors, SceneBudget& budget);

  /// The weights of that many morph targets, one each; none after an error.
  static std::vector<std::unique_ptr<GltfTrack>> read_weights(const GltfValue& sampler,
                                                              std::size_t count,
                                                              GltfAccessors& accessors,
                                                              SceneBudget& budget);

  Interpolation interpolation() const { return interpolation_; }
  /// Seconds, ascending.
  std::span<const float> times() const { return times_; }

  /// The value at a time of the stretch between two keys that `within` lies in: what a step
  /// has before it jumps, too. Before the first key and after the last theirs.
  Value at(double time, double within) const;
  /// Steps of a Motion that this takes from one time to another, without a key between.
  int steps(double from, double to) const;

 private:
  static std::unique_ptr<GltfTrack> read_all(const GltfValue& sampler, std::size_t components,
                                             std::size_t elements, GltfAccessors& accessors,
                                             SceneBudget& budget);
  /// Values that a key has.
  std::size_t parts() const { return interpolation_ == Interpolation::cubic ? 3 : 1; }
  std::size_t key_before(double time) const;
  Value key(std::size_t i, int part = 1) const;
  Value cubic(std::size_t i, double share) const;

  Interpolation interpolation_ = Interpolation::linear;
  bool is_rotation_ = false;
  std::size_t components_ = 3;
  std::vector<float> times_;
  std::vector<float> values_;  ///< Of a cubic: in-tangent, value and out-tangent a key.
};

}  // namespace nacre::host
