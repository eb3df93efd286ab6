#include "pbs/bsdf.h"
#include "pbs/microfacet_reflection.h"

namespace nacre {

namespace {

/// Complex index n + ik relative to vacuum, on either side.
class ConductorFresnel final : public FacetFresnel {
 public:
  ConductorFresnel(Recorder& recorder, Color3 n, Color3 k, const ThinFilm& film)
      : n_(keep(recorder, bounded(n))), k_(keep(recorder, bounded(k))), film_(film) {}

  Color3 at(Float cosine, Bool) const override {
    const Color3 bare = fresnel_conductor(cosine, n_, k_);
    return film_.exists() ? film_.reflectance(cosine, 1.0f, n_, k_, bare) : bare;
  }
  /// Black metals are no interface at all.
  Color3 presence() const override {
    const auto is_there = [](Float n, Float k) {
      return select((n == 1.0f) & (k == 0.0f), Float(0.0f), Float(1.0f));
    };
    return film_.presence({is_there(n_.x, k_.x), is_there(n_.y, k_.y), is_there(n_.z, k_.z)});
  }
  FacetFresnelPtr with_film(const ThinFilm& film) const override {
    auto other = std::make_shared<ConductorFresnel>(*this);
    other->film_ = film;
    return other;
  }

 private:
  /// To what float can square twice; reflectance 1 - 4e-4 there.
  static Color3 bounded(Color3 x) { return min(max(x, Color3(0.0f)), Color3(1e4f)); }

  Color3 n_, k_;
  ThinFilm film_;
};

}  // namespace

void record_closure_conductor_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  auto fresnel = std::make_shared<ConductorFresnel>(recorder, call.vector3("ior"),
                                                    call.vector3("extinction"), prepare_film(call));
  auto lobe = std::make_shared<MicrofacetReflection>(
      prepare_facets(call), std::move(fresnel),
      MicrofacetReflection::Options{.name = "conductor_bsdf",
                                    .retroreflective = call.boolean("retroreflective"),
                                    .opaque = true});
  set_lobe(call, std::move(lobe));
}

}  // namespace nacre
