#include "pbs/bsdf.h"
#include "pbs/microfacet_interface.h"

namespace nacre {

namespace {

/// A curve between colours. Transmission bends light by the index whose
/// reflectance is the mean of color0.
///
/// Reflection alone is the same from both sides: the curve may stand for a metal,
/// of which there is no inside. Where the light that is not reflected passes (RT),
/// the inside sees what the outside sees along the refracted ray, and all of it
/// beyond the critical angle.
///
/// Under a film the curve gives way to dielectrics whose reflectances are color0:
/// a curve has no phase, and its colours are for light from vacuum.
class SchlickFresnel final : public FacetFresnel {
 public:
  SchlickFresnel(Recorder& recorder, const SchlickCurve& curve, bool two_sided,
                 const ThinFilm& film)
      : curve_(curve), two_sided_(two_sided), film_(film) {
    curve_.color0 = keep(recorder, curve_.color0);
    curve_.color90 = keep(recorder, curve_.color90);
    curve_.dip = keep(recorder, curve_.dip);
    curve_.exponent = keep(recorder, curve_.exponent);
    index_ = keep(recorder, index_of_reflectance(grey(curve_.color0)));
  }

  Color3 at(Float cosine, Bool inside) const override {
    if (two_sided_) return filmed(cosine, curve_.at(cosine));
    const Float eta = 1.0f / index_;
    const Float squared = fma(cosine, cosine, (eta - 1.0f) * (eta + 1.0f));
    const Float refracted = min(safe_sqrt(squared) * index_, 1.0f);
    const Float outer = select(inside, refracted, cosine);
    // What a film reflects is the same from both sides along one path of light.
    return select(inside & (squared <= 0.0f), Color3(1.0f), filmed(outer, curve_.at(outer)));
  }

  Color3 presence() const override {
    return two_sided_ ? film_.presence(max(curve_.color0, curve_.color90)) : Color3(1.0f);
  }
  Color3 dip() const override { return curve_.dip * Color3(1.0f - film_share()); }
  Float index() const override { return index_; }
  bool has_inside() const override { return !two_sided_; }
  const ThinFilm* film() const override { return &film_; }
  FacetFresnelPtr with_film(const ThinFilm& film) const override {
    auto other = std::make_shared<SchlickFresnel>(*this);
    other->film_ = film;
    return other;
  }

 private:
  Color3 filmed(Float cosine, Color3 bare) const {
    if (!film_.exists()) return bare;
    // More than the data library's 0.99, with which white metal loses 3 % under a film.
    const auto index = [](Float reflectance) { return index_of_reflectance(reflectance, 0.9999f); };
    const Color3 indices{index(curve_.color0.x), index(curve_.color0.y), index(curve_.color0.z)};
    return film_.reflectance(cosine, 1.0f, indices, Color3(0.0f), bare);
  }

  SchlickCurve curve_;
  bool two_sided_;
  ThinFilm film_;
  Float index_;
};

}  // namespace

void record_closure_generalized_schlick_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const std::string& mode = call.text("scatter_mode");
  const SchlickCurve curve(call.vector3("color0"), call.vector3("color82"), call.vector3("color90"),
                           call.number("exponent"));
  const auto fresnel =
      std::make_shared<SchlickFresnel>(recorder, curve, mode != "RT", prepare_film(call));
  const MicrofacetReflection::Options options{.name = "generalized_schlick_bsdf",
                                              .retroreflective = call.boolean("retroreflective")};
  set_lobe(call, microfacet_lobe(recorder, mode, prepare_facets(call), fresnel, options));
}

}  // namespace nacre
