#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "pbs/vdf.h"
#include "pbs/view.h"

namespace nacre {

class Lobe;
class ThinFilm;
struct Facets;
using LobePtr = std::shared_ptr<const Lobe>;  ///< Shared by all that read its node.

/// What a host may ask for or switch off.
enum LobeKind : std::int32_t {
  lobe_diffuse_reflection = 1 << 0,
  lobe_glossy_reflection = 1 << 1,
  lobe_diffuse_transmission = 1 << 2,
  lobe_glossy_transmission = 1 << 3,
  lobe_all = 0xf,
  /// Of what is wanted at a point (KernelRequest::lobes_wanted), where glossy is what is not
  /// smooth.
  lobe_delta_reflection = 1 << 4,
  lobe_delta_transmission = 1 << 5,
};

/// A lobe seen along one pair of directions.
struct LobeValue {
  Color3 f;   ///< Scattering function times |cos(wi)|; finite, at least 0.
  Float pdf;  ///< Of wi, by solid angle, given wo; 0 where the lobe does not scatter.
};

/// A direction that a lobe chose.
struct LobeSample {
  Float3 wi;           ///< World space, unit; anything where not valid.
  Bool valid;          ///< False: the sample is lost (its energy is, too); see checks_samples().
  Bool delta = false;  ///< wi is one of finitely many directions; evaluate() gives 0 there.
  /// Only where delta: f cos / probability of the choice made with u.
  Color3 delta_weight = Color3(0.0f);
  /// Only where delta: that probability.
  Float delta_probability = 0.0f;
};

/// Calls f on every recorded scalar, in order; see runtime/value/vector.h.
/// @{
template <class F>
void visit(LobeValue& value, F&& f) {
  visit(value.f, f), f(value.pdf);
}
template <class F>
void visit(LobeSample& sample, F&& f) {
  visit(sample.wi, f), f(sample.valid), f(sample.delta);
  visit(sample.delta_weight, f), f(sample.delta_probability);
}
/// @}

/// One term of a BSDF, of weight 1. Its members are recorded values, prepared
/// and kept (pbs/view.h: keep) by the node body that makes it; the functions
/// record what the kernels do with them. They hold for any bits in any member:
/// prepare clamps.
///
/// The scattering functions do not scale radiance by the square of the relative
/// index on transmission: what leaves is what entered. A renderer that carries
/// radiance across an index change applies (eta_o / eta_i)^2 itself, or asks the
/// kernels to (KernelRequest::transport).
class Lobe {
 public:
  virtual ~Lobe() = default;
  /// For MaterialKernels::lobes: the category of its node.
  virtual std::string_view name() const = 0;
  /// One or more LobeKind bits.
  virtual std::int32_t kinds() const = 0;

  /// On which sides its glossy kinds have finitely many directions: sample() says delta there.
  virtual BySide smooth() const { return {false, false}; }
  /// Whether it is about a direction and has no normal of a surface: its normal() is nothing that
  /// |cos(wi)| is taken of.
  virtual bool is_of_fibre() const { return false; }

  /// Records what depends on the view alone, for the lanes where `mask` holds;
  /// the lobe counts in no others. Called at top level before the functions below.
  virtual void prepare(const View& view, Bool mask) const { (void)view, (void)mask; }

  /// wi: unit, world space, on any side.
  virtual LobeValue evaluate(const View& view, Float3 wi) const = 0;
  /// Record, where all lobes and both functions see it, what evaluate() and sample() have in common
  /// with each other of a view, and evaluate() with other lobes' of a direction.
  /// @{
  virtual void share_view(const View& view) const { (void)view; }
  virtual void share_direction(const View& view, Float3 wi) const { (void)view, (void)wi; }
  /// @}
  /// u: three independent numbers in [0, 1).
  virtual LobeSample sample(const View& view, Float3 u) const = 0;
  /// Whether it says itself which samples are not unit; else kernels lose those.
  virtual bool checks_samples() const { return false; }
  /// f over pdf, where that is less to compute than either; else nothing.
  virtual std::optional<Color3> share(const View& view, Float3 wi) const {
    return (void)view, (void)wi, std::nullopt;
  }
  /// Facets that sample() reflects about, whatever else the lobe is; null of other lobes.
  virtual const Facets* reflecting_facets() const { return nullptr; }
  /// LobeSample::delta_weight of such a lobe where it is smooth.
  virtual Color3 mirrored(const View& view) const { return (void)view, Color3(0.0f); }
  /// Fraction of the light from wo that leaves again: in [0, 1]. What lobes are
  /// selected by.
  virtual Color3 albedo(const View& view) const = 0;
  /// Above 0 in a channel wherever the lobe scatters any light of it, and as cheap as can be: what
  /// a lobe that is alone is selected by.
  virtual Color3 presence(const View& view) const { return albedo(view); }
  /// The same, but of models that send back more than they get, where it is more than 1. What the
  /// `albedo` kernel sums.
  virtual Color3 light(const View& view) const { return albedo(view); }
  /// What passes to a layer below, for a lobe of weight 1: 1 - albedo for an
  /// interface, 0 for an opaque lobe. MaterialX PBS 1.39, "Layering".
  virtual Color3 throughput(const View& view) const = 0;
  /// How a weight w enters the throughput. Interfaces let 1 - w (1 - throughput)
  /// pass; opaque lobes 0 whatever their weight (the library's 1.39.5 closures).
  virtual bool is_opaque() const { return false; }
  /// The same under that film, in place of one that it may have; null where it has no facets for
  /// one. `film` is kept.
  virtual LobePtr with_film(Recorder& recorder, const ThinFilm& film) const {
    return (void)recorder, (void)film, nullptr;
  }

  /// Of the light along -wo what passes unbent, in one direction: what a ray may take along that
  /// does not ask sample().
  virtual Color3 straight(const View& view) const { return (void)view, Color3(0.0f); }

  /// Whether it is of facets, which lose what View::compensation brings back.
  virtual bool is_of_facets() const { return false; }

  // For AOVs, and not for what scatters.
  /// Unit, world space, on either side.
  virtual Float3 normal(const View& view) const = 0;
  /// In [0, 1]: the root of the mean alpha; 0 of a mirror, 1 where light scatters everywhere.
  virtual Float roughness(const View& view) const = 0;

  /// Of refraction of the inside over the outside; null where light does not enter by it.
  virtual const Float* interior_index() const { return nullptr; }
  /// Whether light may go on below the surface, where the host follows it.
  virtual bool goes_below() const { return false; }
  /// What it is in there. Recorded for a kernel of its own; only where goes_below().
  virtual Vdf medium_below() const { return {}; }
};

}  // namespace nacre
