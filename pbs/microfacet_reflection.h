#pragma once

#include "pbs/facets.h"
#include "pbs/per_view.h"
#include "pbs/view_table.h"

namespace nacre {

/// A direction that facets reflect a view to, or send it `back`; of smooth ones without
/// LobeSample::delta_weight.
LobeSample sample_reflection(const Facets& all, const View& view, Float3 u, Bool back = false);

/// Light reflected once by GGX facets, scaled up for what several reflections
/// bring back (pbs/energy.h). Smooth surfaces are mirrors. Reciprocal but for
/// that scale, which belongs to the view.
class MicrofacetReflection final : public Lobe {
 public:
  struct Options {
    std::string_view name;
    Color3 tint = Color3(1.0f);    ///< Of the light, not of what passes below.
    Bool retroreflective = false;  ///< Sends light back to where it came from.
    bool opaque = false;           ///< Nothing passes below.
  };
  MicrofacetReflection(Facets facets, FacetFresnelPtr fresnel, Options options)
      : facets_(std::move(facets)), fresnel_(std::move(fresnel)), options_(std::move(options)) {}

  std::string_view name() const override { return options_.name; }
  std::int32_t kinds() const override { return lobe_glossy_reflection; }
  BySide smooth() const override { return {facets_.delta, false}; }
  bool is_opaque() const override { return options_.opaque; }
  LobePtr with_film(Recorder& recorder, const ThinFilm& film) const override;
  void prepare(const View& view, Bool mask) const override;
  LobeValue evaluate(const View& view, Float3 wi) const override;
  void share_view(const View& view) const override;
  void share_direction(const View& view, Float3 wi) const override;
  LobeSample sample(const View& view, Float3 u) const override;
  const Facets* reflecting_facets() const override;
  Color3 mirrored(const View& view) const override;
  Color3 albedo(const View& view) const override;
  Color3 presence(const View&) const override { return options_.tint * fresnel_->presence(); }
  Color3 throughput(const View& view) const override;
  /// The albedo before the tint.
  Color3 reflected(const View& view) const;

  /// What depends on the view alone.
  struct Terms {
    Color3 factor;  ///< Compensation.
    Color3 reflected;
    template <class F>
    friend void visit(Terms& terms, F&& f) {
      nacre::visit(terms.factor, f), nacre::visit(terms.reflected, f);
    }
  };
  /// For a lobe that this is a part of and that needs them as well: what perfect facets reflect,
  /// the mean Fresnel factor of that light, the terms by both; and in place of prepare() the terms,
  /// known in the lanes of `mask`.
  /// @{
  FacetReflection facets(const View& view, bool transmits = false) const;
  Color3 mean_fresnel(const View& view, const FacetReflection& perfect) const;
  Terms compute(const View& view, const FacetReflection& perfect, Color3 fresnel) const;
  void adopt(const View& view, Bool mask, const Terms& terms) const;
  /// @}

  bool is_of_facets() const override { return true; }
  Float3 normal(const View&) const override { return facets_.normal; }
  Float roughness(const View&) const override { return facets_.roughness(); }

 private:
  Terms compute(const View& view) const;
  Color3 mirror_fresnel(const View& view) const;
  /// From a table, where they may come of one.
  std::optional<Terms> tabulated(const View& view) const;
  Terms terms(const View& view) const;
  struct Pair;
  Pair pair(const View& view, const Facets& facets, const LocalView& local, Float3 wi_world) const;
  LobeValue evaluate(const View& view, const Facets& facets, const Terms& terms, Float3 wi) const;

  Facets facets_;
  FacetFresnelPtr fresnel_;
  Options options_;
  PerView<Terms> terms_;
  ViewTable<Terms> table_;
};

}  // namespace nacre
