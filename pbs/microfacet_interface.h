#pragma once

#include "pbs/microfacet_reflection.h"
#include "pbs/microfacet_transmission.h"

namespace nacre {

/// Reflection and transmission of one rough interface, divided by the Fresnel
/// factor of every facet, and scaled so that nothing is lost.
///
/// Where facets can't refract (a thin wall, an index of 1, a smooth surface) it
/// is what a reflecting layer over a transmitting one is: the reflection lobe,
/// and the transmission lobe times what that lets pass.
///
/// To a layer below it lets pass what it does not reflect, as the data library's
/// closures do; a base there is seen beside what is transmitted.
class MicrofacetInterface final : public Lobe {
 public:
  MicrofacetInterface(Recorder& recorder, const Facets& facets, const FacetFresnelPtr& fresnel,
                      MicrofacetReflection::Options options);

  std::string_view name() const override { return options_.name; }
  std::int32_t kinds() const override { return lobe_glossy_reflection | lobe_glossy_transmission; }
  BySide smooth() const override { return {facets_.delta, facets_.delta | straight_}; }
  LobePtr with_film(Recorder& recorder, const ThinFilm& film) const override;
  void prepare(const View& view, Bool mask) const override;
  void share_view(const View& view) const override { reflection_.share_view(view); }
  LobeValue evaluate(const View& view, Float3 wi) const override;
  LobeSample sample(const View& view, Float3 u) const override;
  Color3 albedo(const View& view) const override;
  Color3 throughput(const View& view) const override { return reflection_.throughput(view); }
  Color3 straight(const View& view) const override;
  bool is_of_facets() const override { return true; }
  Float3 normal(const View&) const override { return facets_.normal; }
  Float roughness(const View&) const override { return facets_.roughness(); }
  const Float* interior_index() const override { return transmission_.interior_index(); }

 private:
  struct Terms {
    Color3 factor;      ///< Of both, where facets divide the light.
    Color3 passing;     ///< Not reflected.
    Float probability;  ///< Of reflection, where lobes do and both sides are wanted.
    MicrofacetReflection::Terms reflection;
    template <class F>
    friend void visit(Terms& terms, F&& f) {
      nacre::visit(terms.factor, f), nacre::visit(terms.passing, f);
      f(terms.probability), visit(terms.reflection, f);
    }
  };
  Terms terms(const View& view) const;
  Terms compute(const View& view) const;
  /// From a table, where they may come of one.
  std::optional<Terms> tabulated(const View& view) const;
  /// By what perfect facets reflect, and the mean Fresnel factor of that.
  Color3 joint_factor(const View& view, const FacetReflection& perfect, Color3 fresnel) const;
  Bool separate(const View& view) const;
  /// Glass that does not bend light does not reflect it: at grazing, where it could, not even its
  /// facets' mean is known.
  Bool is_absent() const;
  LobeValue evaluate_separate(const View& view, const Terms& terms, Float3 wi) const;
  LobeValue evaluate_joint(const View& view, const Facets& facets, const Terms& terms,
                           Float3 wi) const;
  LobeSample sample_separate(const View& view, const Terms& terms, Float3 u) const;
  LobeSample sample_joint(const View& view, const Facets& facets, Float3 u) const;
  Float3 turned(Float3 wi) const;

  Facets facets_;
  FacetFresnelPtr fresnel_;
  MicrofacetReflection::Options options_;
  MicrofacetReflection reflection_;
  MicrofacetTransmission transmission_;
  Bool straight_;
  PerView<Terms> terms_;
  ViewTable<Terms> table_;
};

/// The lobe of a node's input scatter_mode: R, T, RT; anything else is R.
LobePtr microfacet_lobe(Recorder& recorder, std::string_view scatter_mode, const Facets& facets,
                        const FacetFresnelPtr& fresnel, MicrofacetReflection::Options options);

}  // namespace nacre
