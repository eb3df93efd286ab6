#pragma once

#include <memory>

#include "pbs/view.h"
#include "runtime/node/recorded.h"

namespace nacre {

/// A node of an EDF tree.
class Edf : public Closure {
 public:
  /// Radiance towards view.wo; at least 0.
  virtual Color3 radiance(const View& view) const = 0;
};
using EdfPtr = std::shared_ptr<const Edf>;

EdfPtr as_edf(const ClosurePtr& closure);

}  // namespace nacre
