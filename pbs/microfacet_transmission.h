#pragma once

#include "pbs/facets.h"
#include "pbs/per_view.h"

namespace nacre {

/// A facet that takes the light of one direction to another.
struct FacetEvent {
  Bool possible;
  Float cosine;     ///< Of wo to the facet, in [0, 1].
  Float pdf;        ///< Of wi by solid angle, when visible normals are sampled.
  Float shadowing;  ///< G2 / G1.
};

template <class F>
void visit(FacetEvent& event, F&& f) {
  f(event.possible), f(event.cosine), f(event.pdf), f(event.shadowing);
}

/// The facet between wo, above, and wi, as `facets` see both: it reflects where wi is above, else
/// it refracts by `eta`, the index beyond over before. Walter et al. 2007, eq. 13-17; the
/// Jacobian's denominator is the squared length of the half-way vector.
FacetEvent facet_between(const LocalView& local, const FacetDirection& wo, const FacetDirection& wi,
                         Float eta, const Facets& facets);

/// wo refracted at a facet; below the surface if it can be. `possible` is false
/// under total reflection and where the facet refracts to above.
struct Refraction {
  Float3 wi;
  Bool possible;
};
template <class F>
void visit(Refraction& refraction, F&& f) {
  visit(refraction.wi, f), f(refraction.possible);
}
Refraction refract(Float3 wo, Float3 h, Float cosine, Float eta);

/// Light refracted once by GGX facets, without a Fresnel factor: the layer above
/// has taken what is reflected. Scaled so that all light passes. Where hardly any
/// can, facets reflect what they cannot refract, because the layer above need not
/// know of total reflection: Schlick's factor does not. A dielectric one does, and
/// leaves nothing to this lobe there. Smooth surfaces do so from the critical angle
/// on. An index within 1e-3 of 1 passes light straight on, whatever the roughness.
///
/// A thin wall does not bend light. It spreads it as far as it would reflect it
/// at alpha (0.65 n - 0.35), mirrored to the other side. Burley, "Extending the
/// Disney BRDF to a BSDF with Integrated Subsurface Scattering", 2015, 4.3.
class MicrofacetTransmission final : public Lobe {
 public:
  MicrofacetTransmission(Recorder& recorder, Facets facets, Float index, Color3 tint,
                         std::string_view name);

  std::string_view name() const override { return name_; }
  std::int32_t kinds() const override { return lobe_glossy_transmission; }
  BySide smooth() const override { return {false, facets_.delta | straight_}; }
  void prepare(const View& view, Bool mask) const override;
  void share_view(const View& view) const override;
  LobeValue evaluate(const View& view, Float3 wi) const override;
  LobeSample sample(const View& view, Float3 u) const override;
  Color3 albedo(const View& view) const override;
  /// All light is taken.
  Color3 throughput(const View&) const override { return Color3(0.0f); }
  Color3 straight(const View& view) const override;
  bool is_of_facets() const override { return true; }
  Float3 normal(const View&) const override { return facets_.normal; }
  Float roughness(const View&) const override { return facets_.roughness(); }
  const Float* interior_index() const override { return &index_; }

 private:
  struct Terms {
    Float factor;  ///< One over what the facets return.
    Float turned;  ///< Share of the totally reflecting facets that is reflected.
    template <class F>
    friend void visit(Terms& terms, F&& f) {
      f(terms.factor), f(terms.turned);
    }
  };
  Terms compute(const View& view) const;
  Terms refracted(const View& view, const LocalView& local) const;
  Terms thin(const View& view, const LocalView& local) const;
  Bool delta(const View& view) const;

  Facets facets_;
  Facets thin_facets_;
  Float index_;
  Color3 tint_;
  Bool straight_;
  std::string_view name_;
  PerView<Terms> terms_;
};

}  // namespace nacre
