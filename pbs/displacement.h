#pragma once

#include <memory>

#include "runtime/node/recorded.h"

namespace nacre {

/// A displacement shader: where a point of the surface moves. MaterialX PBS 1.39,
/// "displacement".
class Displacement final : public Closure {
 public:
  Float3 offset = Float3(0.0f);  ///< World space: P + offset is the new place.
};
using DisplacementPtr = std::shared_ptr<const Displacement>;

DisplacementPtr as_displacement(const ClosurePtr& closure);

}  // namespace nacre
