#include "pbs/edf.h"
#include "pbs/facets.h"
#include "runtime/node/geometry.h"

namespace nacre {

namespace {

/// Radiance inside a cone around the normal, in front of the surface only.
class ConicalEdf final : public Edf {
 public:
  ConicalEdf(Color3 color, Float3 normal, Float inner, Float outer)
      : color_(color), normal_(normal), inner_(inner), outer_(outer) {}

  Color3 radiance(const View& view, Color3, Color3) const override {
    if (is_zero(color_)) return color_;
    const Float cosine = dot(normal_, view.wo);
    const Float t = saturate((cosine - outer_) / (inner_ - outer_));
    const Float soft = t * t * fma(-2.0f, t, 3.0f);
    const Float sharp = select(cosine >= inner_, Float(1.0f), Float(0.0f));
    const Float inside = select(outer_ < inner_, soft, sharp);
    return select(cosine > 0.0f, color_ * Color3(inside), Color3(0.0f));
  }

 private:
  Color3 color_;
  Float3 normal_;
  Float inner_, outer_;  ///< Cosines of half the angles.
};

/// Cosine of half an angle in degrees.
Float half_cosine(Float degrees) {
  constexpr float half_degree = 0.00872664626f;
  return cos(clamp(degrees, 0.0f, 360.0f) * half_degree);
}

}  // namespace

/// conical_edf. MaterialX PBS 1.39: full intensity within inner_angle, none beyond
/// outer_angle, and no falloff where the outer is the smaller. The text does not
/// say how falloff goes, nor what an angle of a cone is: here smoothstep of the
/// cosine, as the library's spot light, and the opening angle, side to side.
/// Components below zero, and NaN, count as zero.
void record_closure_conical_edf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  call.set(std::make_shared<ConicalEdf>(keep(recorder, max(call.vector3("color"), Color3(0.0f))),
                                        prepare_normal(recorder, call.vector3("normal")),
                                        keep(recorder, half_cosine(call.number("inner_angle"))),
                                        keep(recorder, half_cosine(call.number("outer_angle")))));
}

}  // namespace nacre
