#pragma once

#include <memory>

#include "pbs/closure_parts.h"
#include "pbs/view.h"
#include "runtime/node/recorded.h"

namespace nacre {

class Edf;
class Emitter;
using EdfPtr = std::shared_ptr<const Edf>;  ///< Null: nothing is connected.

/// A node of an EDF; what is used twice is one node.
class Edf : public Closure {
 public:
  /// Up to two closures that it is made of.
  using Parts = ClosureParts<Edf>;
  /// Null for a part that is not there.
  explicit Edf(EdfPtr first = nullptr, EdfPtr second = nullptr)
      : parts_(std::move(first), std::move(second)) {}
  /// Each may be null.
  const Parts& parts() const { return parts_; }

  /// Radiance towards view.wo, at least 0, by that of the parts: black for those that are
  /// not connected. What overflows is radiance()'s to bound.
  virtual Color3 radiance(const View& view, Color3 first, Color3 second) const = 0;

  /// What `power` of part `i` is with this over it, about: by the mean of what it does over all
  /// directions. 0 only where nothing of the part is seen along any.
  virtual Color3 part_power(std::size_t i, Color3 power) const;
  /// This, if it shines by itself and not by its parts; else null.
  virtual const Emitter* emitter() const { return nullptr; }

 private:
  Parts parts_;
};

/// An EDF that shines by itself: what directions are sampled of. They, and their density, hang on
/// its shape alone, not on its colour.
class Emitter : public Edf {
 public:
  const Emitter* emitter() const final { return this; }
  /// The integral of radiance |cos| over all directions, about; 0 only where there is none along
  /// any. As power_seen() gives it.
  virtual Color3 power() const = 0;
  /// A direction that light leaves along, world space, unit up to rounding: by u in [0, 1). Does
  /// not look at view.wo.
  virtual Float3 sample(const View& view, Float3 u) const = 0;
  /// The density of view.wo, by solid angle; finite, at least 0, and more wherever there is
  /// radiance |cos|. Radiance |cos| is at most a constant times it, whatever normal the cosine is
  /// to, so that weights of samples are bounded.
  virtual Float pdf(const View& view) const = 0;
};

/// uniform_edf of that radiance, at least 0.
EdfPtr uniform_edf(Color3 radiance);
/// The product of both, in [1e-20, 1e20] where both are above 0, else 0: however many are over
/// one another, what is seen has a power.
Color3 power_seen(Color3 power, Color3 factor);

/// Radiance of all of it, finite and at least 0; a literal 0 where nothing emits. Each node is
/// asked once.
Color3 radiance(const EdfPtr& edf, const View& view);

/// The Edf that a port carries; null where nothing is connected.
EdfPtr as_edf(const ClosurePtr& closure);

}  // namespace nacre
