#include <utility>

#include "pbs/edf.h"
#include "pbs/facets.h"
#include "pbs/root.h"
#include "pbs/sampling.h"
#include "runtime/node/geometry.h"

namespace nacre {

namespace {

/// Radiance inside a cone around the normal, in front of the surface only.
class ConicalEdf final : public Emitter {
 public:
  ConicalEdf(Color3 color, Float3 normal, Float inner, Float outer)
      : color_(color), normal_(normal), inner_(inner), outer_(outer) {}

  Color3 radiance(const View& view, Color3, Color3) const override {
    if (is_zero(color_)) return color_;
    const Float cosine = dot(normal_, view.wo);
    return select(cosine > 0.0f, color_ * Color3(falloff(cosine)), Color3(0.0f));
  }

  Color3 power() const override { return power_seen(color_, Color3(measure().both * (2.0f * pi))); }
  Float3 sample(const View& view, Float3 u) const override;
  Float pdf(const View& view) const override {
    const Float cosine = dot(normal_, view.wo);
    const Float density = falloff(cosine) * (cosine + least_cosine) / measure().both;
    return select(cosine > 0.0f, density * (0.5f * one_over_pi), 0.0f);
  }

 private:
  /// What there is of the cosine x: falloff (x + least_cosine), from the full part and from that
  /// between the cones, where x is outer + t width. No product goes into a sum: kernels that use
  /// one of these for more than others do would fuse it or not.
  struct Measure {
    Float full_from, full;  ///< Of the cosines from there to 1.
    Float outer, width;     ///< Width 0: there is no falloff.
    Float soft_from, soft;  ///< Of those t from there to 1 that are in front of the surface.
    Float both;             ///< Above 0, so that cones narrower than digits have a density.
    /// Of the t below this one, over width.
    Float below(Float t) const {
      const Float cube = t * t * t;
      const Float flat = cube * fma(-0.5f, t, 1.0f);
      const Float steep = cube * t * fma(-0.4f, t, 0.75f);
      return fma(width, steep, (outer + least_cosine) * flat);
    }
  };

  Float falloff(Float cosine) const {
    const Float t = saturate((cosine - outer_) / (inner_ - outer_));
    const Float soft = t * t * fma(-2.0f, t, 3.0f);
    const Float sharp = select(cosine >= inner_, Float(1.0f), Float(0.0f));
    return select(outer_ < inner_, soft, sharp);
  }

  Measure measure() const {
    Measure m;
    m.full_from = max(inner_, 0.0f);
    const Float size = 1.0f - m.full_from;
    const Float height = fma(0.5f, 1.0f + m.full_from, least_cosine);
    m.full = size * height;
    m.outer = min(outer_, inner_);
    m.width = inner_ - m.outer;
    m.soft_from = saturate(-m.outer / m.width);  // 0 where both are.
    m.soft = max(m.width * (m.below(1.0f) - m.below(m.soft_from)), 0.0f);
    m.both = max(fma(size, height, m.soft), 1e-9f);
    return m;
  }

  Color3 color_;
  Float3 normal_;
  Float inner_, outer_;  ///< Cosines of half the angles.
};

Float3 ConicalEdf::sample(const View& view, Float3 u) const {
  const Measure m = measure();
  const Float wanted = u.x * m.both;
  // By 1 less the cosine, which keeps the digits of narrow cones.
  const Float full =
      (1.0f - m.full_from) *
      invert_linear(1.0f + least_cosine, m.full_from + least_cosine, wanted / m.full);
  const Float either = if_any(wanted >= m.full, full, [&] {
    const Float share = (wanted - m.full) / m.soft;
    const Float before = m.below(m.soft_from);
    const Float sought = fma(share, m.below(1.0f) - before, before);
    const Float start = saturate(fma(1.0f - m.soft_from, share, m.soft_from));
    const Float t = find_root(*view.recorder, m.soft_from, 1.0f, start, [&](Float at) {
      const Float slope = at * at * fma(-2.0f, at, 3.0f) * fma(at, m.width, m.outer + least_cosine);
      return std::pair(m.below(at) - sought, slope);
    });
    return fma(-t, m.width, 1.0f - m.outer);
  });
  const Float lack = clamp(either, 0.0f, 1.0f);
  const Float across = sqrt(lack * (2.0f - lack));
  const Float2 on = on_circle(u.y);
  return make_frame(normal_).to_world({across * on.x, across * on.y, 1.0f - lack});
}

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
