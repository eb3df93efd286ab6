#pragma once

#include <memory>

#include "pbs/closure_parts.h"
#include "pbs/view.h"
#include "runtime/node/recorded.h"

namespace nacre {

class Edf;
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

 private:
  Parts parts_;
};

/// Radiance of all of it, finite and at least 0; a literal 0 where nothing emits. Each node is
/// asked once.
Color3 radiance(const EdfPtr& edf, const View& view);

/// The Edf that a port carries; null where nothing is connected.
EdfPtr as_edf(const ClosurePtr& closure);

}  // namespace nacre
