#include "pbs/bsdf.h"
#include "pbs/cosine_lobe.h"
#include "pbs/sampling.h"

namespace nacre {

namespace {

Float fifth_power(Float x) { return square(square(x)) * x; }

/// Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 course, 5.3. Not
/// energy conserving: at roughness 1 and grazing angles a white surface sends
/// back 1.56 times the light. Reciprocal.
class BurleyDiffuse final : public CosineLobe {
 public:
  BurleyDiffuse(Float3 normal, Color3 color, Float roughness)
      : CosineLobe("burley_diffuse_bsdf", Hemisphere::viewer, normal),
        color_(color),
        roughness_(roughness) {}

  /// Exact: f is a polynomial in cos_i once the azimuth is averaged, with
  /// moments 2 B(k + 2, 6) of the cosines.
  Color3 light(const View& view) const override {
    const Float c = facing_cosine(normal(view), view.wo);
    const Float r = roughness_;
    const Float a = r - 0.5f;
    const Float rc = r * c;
    const Float sine2 = (1.0f - c) * (1.0f + c);
    const Float alone = fma(rc, 1.0f / 84.0f, fma(a, 1.0f / 21.0f, 1.0f));
    const Float linear = fma(rc, 2.0f / 3.0f, a);
    const Float squares = a * a * (1.0f / 21.0f) + a * rc * (1.0f / 42.0f) +
                          rc * rc * (1.0f / 252.0f) + r * r * sine2 * (11.0f / 504.0f);
    return color_ * Color3(fma(fifth_power(1.0f - c), linear + squares, alone));
  }
  /// The part above 1 is cut off.
  Color3 albedo(const View& view) const override { return saturate(light(view)); }
  Color3 presence(const View&) const override { return color_; }

 private:
  Color3 scattered(const View& view, Float3 wi) const override {
    const Float cos_o = facing_cosine(normal(view), view.wo);
    const Float cos_i = saturate(dot(wi, axis(view)));
    // Squared cosine of half the angle between the two; needs no half-way vector.
    const Float half2 = saturate(fma(dot(view.wo, wi), 0.5f, 0.5f));
    const Float rise = fma(2.0f * roughness_, half2, -0.5f);
    const Float in = fma(rise, fifth_power(1.0f - cos_i), 1.0f);
    const Float out = fma(rise, fifth_power(1.0f - cos_o), 1.0f);
    return color_ * Color3(in * out);
  }

  Color3 color_;
  Float roughness_;
};

}  // namespace

/// burley_diffuse_bsdf. MaterialX PBS 1.39. roughness is clamped to [0, 1].
void record_closure_burley_diffuse_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  auto lobe =
      std::make_shared<BurleyDiffuse>(prepare_facing_normal(recorder, call.vector3("normal")),
                                      prepare_tint(recorder, call.vector3("color")),
                                      keep(recorder, saturate(call.number("roughness"))));
  set_lobe(call, std::move(lobe));
}

}  // namespace nacre
