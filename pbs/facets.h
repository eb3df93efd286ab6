#pragma once

#include <memory>

#include "pbs/energy.h"
#include "pbs/lobe.h"
#include "pbs/microfacet.h"
#include "pbs/thin_film.h"
#include "runtime/node/node_call.h"
#include "runtime/value/control.h"

namespace nacre {

/// A view in the frame of a rough surface, turned so that it is above.
struct LocalView {
  Frame frame;  ///< z on the viewer's side.
  Float3 wo;    ///< wo.z >= 0.
  Bool below;   ///< The viewer is behind the normal: inside what it encloses.
};

/// A direction of any length as facets are asked about it: in the frame of the surface. Where
/// roughness is equal all around `v` stays in world space, for of the frame nothing matters but z.
struct FacetDirection {
  Float3 v;
  Float z;  ///< Along the normal.

  FacetDirection(Float3 v_, Float z_) : v(v_), z(z_) {}
  /// NOLINTNEXTLINE(google-explicit-constructor): one in the frame of the surface is one.
  FacetDirection(Float3 local) : v(local), z(local.z) {}
};

/// Half way between two, or as far as they are bent.
struct HalfVector {
  FacetDirection h;
  Float length2;
  Float across2;  ///< The square of what it has along the surface; where isotropic.
};

/// Where the facets of a surface lie and how rough they are; prepared and kept.
struct Facets {
  FacetDistribution distribution = FacetDistribution::ggx;
  Float2 alpha;     ///< In [threshold, 1]; the same value twice where isotropic.
  Bool delta;       ///< Smooth: both below the threshold. Mirrors, not lobes.
  float threshold;  ///< 1e-4; fast: 1e-3.
  bool isotropic;   ///< Known while recording, or known of where it is asked: as_equal().
  Float3 normal, tangent;
  bool has_tangent;  ///< Its frame is that of the tangent.

  LocalView look(const View& view) const;
  /// The same where the normal is z and the tangent x.
  Facets upright() const;
  /// Whether its roughnesses are the same for all points of a call, and not known while recording
  /// to be equal.
  bool may_be_equal(const Recorder& recorder) const;
  /// The same facets where they are.
  Facets as_equal() const;
  /// Of what of_either() asks, those whose answers lobes of one frame may share: the likely ones.
  Facets likely(const Recorder& recorder) const {
    return may_be_equal(recorder) ? as_equal() : *this;
  }
  /// As Lobe::roughness.
  Float roughness() const { return select(delta, 0.0f, sqrt(0.5f * (alpha.x + alpha.y))); }
  FacetView table_view(const LocalView& local) const {
    return facet_view(local.wo, distribution, alpha, isotropic);
  }

  // Of that view: the direction to it, another of world space, and what is between.
  FacetDirection viewer(const View& view, const LocalView& local) const;
  FacetDirection direction(const LocalView& local, Float3 world) const;
  HalfVector between(const LocalView& local, const FacetDirection& wo, const FacetDirection& wi,
                     Float ratio = 1.0f) const;
  /// On the other side of the surface, and turned half round its normal.
  FacetDirection mirrored(const LocalView& local, const FacetDirection& w) const;
  FacetDirection turned(const LocalView& local, const FacetDirection& w) const;

  // pbs/microfacet.h or pbs/beckmann.h.
  /// `scale` times the normals per area and solid angle.
  Float density(const HalfVector& h, float scale) const;
  /// z (1 + 2 Lambda) of a unit vector.
  Float root(const FacetDirection& w) const;
  /// What keeps sampled normals from reflecting below the surface; 1: nothing does.
  Float bound(const FacetDirection& wo) const;
  /// Of density D G1 (wo.h) / wo.z; in the frame of the surface.
  Float3 sample_visible(Float3 wo, Float u, Float v) const;
  /// Less most of those that would reflect below the surface: by `bound`. Of any length.
  Float3 sample_reflecting(Float3 wo, Float u, Float v) const;
};

/// Whether directions are the same in the frames of both, and facets of one kind.
bool have_one_frame(const Facets& a, const Facets& b);

/// From the inputs roughness, distribution ("beckmann", else GGX), normal and tangent of a node.
/// The threshold separates what float can evaluate: below it the rounding of a half-way vector is
/// as wide as the lobe. One axis alone is never below: it is clamped. Alpha is no less than the
/// slot "min_alpha" where the host offers one: what lies behind a rough bounce needs no sharp lobe.
Facets prepare_facets(NodeCall& call);

/// A unit normal, kept. The shading normal itself is trusted; others are
/// normalized, and the shading normal stands in for a zero or a NaN.
Float3 prepare_normal(Recorder& recorder, Float3 normal);
/// The same for what scatters. Bumps turn normals away from viewers who see the surface: such a
/// one is mirrored at the plane across the view, lest the viewer be taken for one on the other
/// side, where glass reflects all light and paper is dark. The shading normal itself is the host's
/// to turn.
Float3 prepare_facing_normal(Recorder& recorder, Float3 normal);

/// Index of the side beyond over the viewer's.
Float relative_index(Float index, Bool inside);

/// Too little to bend light: the facets' equations lose all digits, and rays go
/// straight through instead.
Bool goes_straight(Float index);

class FacetFresnel;
using FacetFresnelPtr = std::shared_ptr<const FacetFresnel>;

/// The Fresnel factor of facets; its members are prepared and kept.
class FacetFresnel {
 public:
  virtual ~FacetFresnel() = default;
  /// Fraction reflected, in [0, 1]; finite for a finite cosine.
  virtual Color3 at(Float cosine, Bool inside) const = 0;
  /// 0 in channels of which nothing is reflected at any angle; above it in others.
  virtual Color3 presence() const { return Color3(1.0f); }
  /// Its mean over the light that a surface reflects to a view.
  Color3 mean(Recorder& recorder, Accuracy accuracy, const FacetReflection& reflection,
              const FacetView& view, Bool inside) const;
  /// Index of the inside relative to the outside, for lobes that transmit.
  virtual Float index() const { return 1.0f; }
  /// Whether light from the denser side is totally reflected beyond the critical
  /// angle of that index.
  virtual bool has_inside() const { return false; }
  /// Whether at() is Fresnel's formula for that index and nothing else.
  virtual bool is_dielectric() const { return false; }
  /// Whether it is that, or that under a film.
  virtual bool covers_dielectric() const { return is_dielectric(); }
  /// How much of c (1 - c)^6 it has less than a curve that rises to grazing: what two cosines stand
  /// for is none of that.
  virtual Color3 dip() const { return Color3(0.0f); }
  /// What it goes up and down with the cosine for, if there may be one.
  virtual const ThinFilm* film() const { return nullptr; }
  /// ThinFilm::share() of it.
  Float film_share() const { return film() == nullptr ? Float(0.0f) : film()->share(); }
  /// The same under that film, which is kept, in place of one that it may have.
  virtual FacetFresnelPtr with_film(const ThinFilm& film) const = 0;
};

/// A colour that scales a lobe: at least 0, finite.
Color3 prepare_tint(Recorder& recorder, Color3 tint);

/// From the inputs thinfilm_thickness (nm) and thinfilm_ior; kept.
ThinFilm prepare_film(NodeCall& call);

/// The mean of the channels; nothing to record where they are one value.
Float grey(Color3 colour);

/// What lobes give at most: finite also times a tint and a weight.
inline constexpr float largest_value = 1e20f;
/// min(max(x, 0), largest_value): finite for any bits.
Float finite(Float x);
/// Whether w is a unit vector; false for NaN.
Bool is_unit(Float3 w);

/// a() where the condition holds, b() elsewhere: only one is recorded where the
/// condition is a literal, else each is skipped where no lane needs it.
template <class A, class B>
auto choose(Bool condition, A&& a, B&& b) {
  using T = decltype(a());
  if (condition.is_constant(true)) return a();
  if (condition.is_constant(false)) return b();
  const T other = if_any(!condition, T(), b);
  return if_any(condition, other, a);
}

/// f(facets), once for equal roughnesses and once for others where both are of a call: equal ones,
/// as most materials have them, take less.
template <class F>
auto of_either(const Recorder& recorder, const Facets& facets, F&& f) {
  if (!facets.may_be_equal(recorder)) return f(facets);
  return choose(
      facets.alpha.x == facets.alpha.y, [&] { return f(facets.as_equal()); },
      [&] { return f(facets); });
}

}  // namespace nacre
