#include "pbs/bsdf.h"
#include "pbs/cosine_lobe.h"
#include "pbs/sampling.h"

namespace nacre {

namespace {

/// f = color / pi (A + B s / t) + multiple scattering, s = wo.wi - cos_o cos_i.
/// What both models are, with their own A and B:
///
/// Plain: Oren and Nayar, "Generalization of Lambert's reflectance model", SIGGRAPH
/// 1994, the qualitative model (eq. 27 without interreflection): s is cut off at
/// 0. Loses energy: albedo 0.62 at roughness 1 and normal incidence. Roughness is
/// the standard deviation of the facets' angle in radians.
///
/// Compensated: Portsmouth, Kutz and Hill, "EON: A practical energy-preserving
/// rough diffuse BRDF", JCGT 14(1), 2025: Fujii's variant (t = 1 where s < 0) and
/// a lobe that returns what it loses. A white surface reflects all light.
struct Model {
  Float a, b;
  Float below;     ///< Factor of s where it is negative.
  Color3 several;  ///< Of (loss_o loss_i) / pi; zero: no second lobe.
};

/// The constants of the EON paper: 1/2 - 2/(3 pi) and 2/3 - 28/(15 pi).
constexpr float c1 = 0.28779341f;
constexpr float c2 = 0.07248821f;

Model plain_model(Float roughness) {
  const Float sigma2 = square(clamp(roughness, 0.0f, 1e3f));
  return {.a = 1.0f - 0.5f * (sigma2 / (sigma2 + 0.33f)),
          .b = 0.45f * (sigma2 / (sigma2 + 0.09f)),
          .below = 0.0f,
          .several = Color3(0.0f)};
}

/// The paper's (1 - E(o)) (1 - E(i)) / (1 - mean E) is A r loss_o loss_i / (c1 - c2),
/// 1 - E being A r loss: no difference of nearly equal numbers, nor 0 / 0 at r = 0.
Model compensated_model(Float roughness, Color3 color) {
  const Float r = saturate(roughness);
  const Float a = 1.0f / fma(r, c1, 1.0f);
  const Float mean = a * fma(r, c2, 1.0f);
  const Color3 again = Color3(1.0f) - saturate(color) * Color3(1.0f - mean);
  const Color3 tint = color * color * Color3(mean) / again;
  return {.a = a, .b = a * r, .below = 1.0f, .several = tint * Color3(a * r * (1.0f / (c1 - c2)))};
}

/// The mean of s / t over the cosine lobe, by the angle of the other direction:
/// where s > 0, and where it is not. (1 - sin^3) / cos is written without the
/// division.
struct MeanRatio {
  Float above, below;
};
MeanRatio mean_ratio(Float cosine) {
  const Float sine = safe_sqrt((1.0f - cosine) * (1.0f + cosine));
  const Float steep = cosine * fma(sine, 1.0f + sine, 1.0f) / (1.0f + sine);
  const Float angle = acos(cosine);
  const Float above = sine * fma(steep, 2.0f / 3.0f, fma(-sine, cosine, angle));
  return {above * one_over_pi, sine * (-2.0f / 3.0f * one_over_pi)};
}

/// (1 - E) / (A r): 0 at grazing, c1 at normal incidence.
Float loss(Float cosine) {
  const MeanRatio ratio = mean_ratio(cosine);
  return max(c1 - (ratio.above + ratio.below), 0.0f);
}

class OrenNayar final : public CosineLobe {
 public:
  OrenNayar(Recorder& recorder, Float3 normal, Color3 color, const Model& model)
      : CosineLobe("oren_nayar_diffuse_bsdf", Hemisphere::viewer, normal), color_(color) {
    model_ = {.a = keep(recorder, model.a),
              .b = keep(recorder, model.b),
              .below = keep(recorder, model.below),
              .several = keep(recorder, model.several)};
  }

  Color3 albedo(const View& view) const override {
    const Float cos_o = facing_cosine(normal(view), view.wo);
    const MeanRatio ratio = mean_ratio(cos_o);
    const Float once = fma(model_.b, fma(model_.below, ratio.below, ratio.above), model_.a);
    Color3 total = color_ * Color3(once);
    // loss averages to c1 - c2 over the cosine lobe.
    if (!is_zero(model_.several)) {
      total = fma(model_.several, Color3(loss(cos_o) * (c1 - c2)), total);
    }
    return saturate(total);
  }
  Color3 presence(const View&) const override { return color_; }

 private:
  Color3 scattered(const View& view, Float3 wi) const override {
    const Float cos_o = facing_cosine(normal(view), view.wo);
    const Float cos_i = saturate(dot(wi, axis(view)));
    const Float s = clamp(fma(-cos_i, cos_o, dot(view.wo, wi)), -1.0f, 1.0f);
    const Float ratio = select(s > 0.0f, s / max(max(cos_i, cos_o), 1e-8f), model_.below * s);
    const Color3 once = color_ * Color3(fma(model_.b, ratio, model_.a));
    if (is_zero(model_.several)) return once;
    return fma(model_.several, Color3(loss(cos_o) * loss(cos_i)), once);
  }

  Color3 color_;
  Model model_;
};

Model select(Bool condition, const Model& a, const Model& b) {
  return {.a = select(condition, a.a, b.a),
          .b = select(condition, a.b, b.b),
          .below = select(condition, a.below, b.below),
          .several = select(condition, a.several, b.several)};
}

}  // namespace

void record_closure_oren_nayar_diffuse_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const Float roughness = call.number("roughness");
  const Color3 color = prepare_tint(recorder, call.vector3("color"));
  const Model model = select(call.boolean("energy_compensation"),
                             compensated_model(roughness, color), plain_model(roughness));
  auto lobe = std::make_shared<OrenNayar>(
      recorder, prepare_facing_normal(recorder, call.vector3("normal")), color, model);
  set_lobe(call, std::move(lobe));
}

}  // namespace nacre
