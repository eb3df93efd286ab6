#include "pbs/edf.h"
#include "pbs/facets.h"
#include "runtime/node/geometry.h"

namespace nacre {

namespace {

/// The base times color0 + (color90 - color0) (1 - cos)^exponent.
class GeneralizedSchlickEdf final : public Edf {
 public:
  GeneralizedSchlickEdf(EdfPtr base, Color3 color0, Color3 color90, Float exponent)
      : Edf(std::move(base)), color0_(color0), color90_(color90), exponent_(exponent) {}

  Color3 radiance(const View& view, Color3 base, Color3) const override {
    if (is_zero(base)) return base;
    const Float3 n = normal(*view.recorder, Space::world);
    const Float flat = 1.0f - min(abs(dot(n, view.wo)), 1.0f);
    // pow(0, 0) is 1: with exponent 0 color90 holds at normal incidence as well.
    return product(base, lerp(color0_, color90_, pow(max(flat, 0.0f), exponent_)));
  }
  // The mean of (1 - cos)^n over the light of a uniform base: 2 / ((n + 1) (n + 2)). Each of the
  // colours counts, be it of one angle alone or next to nothing.
  Color3 part_power(std::size_t, Color3 power) const override {
    const Float mean = 2.0f / ((exponent_ + 1.0f) * (exponent_ + 2.0f));
    const auto one = [&](Float a, Float b) {
      return select(max(a, b) > 0.0f, max(lerp(a, b, mean), 1e-20f), 0.0f);
    };
    return power_seen(power, {one(color0_.x, color90_.x), one(color0_.y, color90_.y),
                              one(color0_.z, color90_.z)});
  }

 private:
  Color3 color0_, color90_;
  Float exponent_;
};

}  // namespace

/// generalized_schlick_edf. MaterialX PBS 1.39: a directional factor on an EDF, by
/// the angle to the shading normal, the same on both sides. Colours below zero
/// count as zero; the exponent is clamped to [0, 1000].
void record_closure_generalized_schlick_edf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  call.set(std::make_shared<GeneralizedSchlickEdf>(
      as_edf(call.closure("base")), prepare_tint(recorder, call.vector3("color0")),
      prepare_tint(recorder, call.vector3("color90")),
      keep(recorder, clamp(call.number("exponent"), 0.0f, 1000.0f))));
}

}  // namespace nacre
