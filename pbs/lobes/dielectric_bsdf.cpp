#include "pbs/bsdf.h"
#include "pbs/exterior.h"
#include "pbs/microfacet_interface.h"

namespace nacre {

namespace {

/// Index of the inside over the outside, real; seen from inside it inverts.
class DielectricFresnel final : public FacetFresnel {
 public:
  /// `inside` and `outside`: relative to vacuum.
  DielectricFresnel(Recorder& recorder, Float inside, Float outside, const ThinFilm& film)
      : index_(keep(recorder, over(inside, outside))),
        outside_(keep(recorder, outside)),
        film_(film) {}

  Color3 at(Float cosine, Bool inside) const override {
    const Float eta = relative_index(index_, inside);
    const Color3 bare(fresnel_dielectric(cosine, eta));
    if (!film_.exists()) return bare;
    // A film's own index is relative to vacuum.
    const Float within = outside_.is_constant(1.0f) ? index_ : index_ * outside_;
    const Float before = select(inside, within, outside_);
    const Float behind = select(inside, outside_, within);
    const Color3 film = film_.reflectance(cosine, before, Color3(behind), Color3(0.0f), bare);
    return select(totally_reflected(cosine, eta), Color3(1.0f), film);
  }

  Float index() const override { return index_; }
  bool has_inside() const override { return true; }
  bool is_dielectric() const override { return !film_.exists(); }
  bool covers_dielectric() const override { return true; }
  const ThinFilm* film() const override { return &film_; }
  FacetFresnelPtr with_film(const ThinFilm& film) const override {
    auto other = std::make_shared<DielectricFresnel>(*this);
    other->film_ = film;
    return other;
  }

 private:
  static Float over(Float inside, Float outside) {
    return outside.is_constant(1.0f) ? inside : clamp(inside / outside, 0.02f, 50.0f);
  }

  Float index_;
  Float outside_;  ///< Relative to vacuum.
  ThinFilm film_;
};

}  // namespace

void record_closure_dielectric_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const Float index = clamp(call.number("ior"), 0.02f, 50.0f);
  const Color3 tint = prepare_tint(recorder, call.vector3("tint"));
  const ThinFilm film = prepare_film(call);
  const auto fresnel =
      std::make_shared<DielectricFresnel>(recorder, index, exterior_index(recorder), film);
  const MicrofacetReflection::Options options{
      .name = "dielectric_bsdf", .tint = tint, .retroreflective = call.boolean("retroreflective")};
  const std::string& mode = call.text("scatter_mode");
  // What open_pbr_surface makes of a specular_weight of 0.
  const bool is_nothing = mode == "R" && index.is_constant(1.0f) && !film.exists();
  set_lobe(call, microfacet_lobe(recorder, mode, prepare_facets(call), fresnel, options),
           is_nothing);
}

}  // namespace nacre
