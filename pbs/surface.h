#pragma once

#include <memory>

#include "pbs/bsdf.h"
#include "pbs/edf.h"

namespace nacre {

/// A surface shader, ready to be made into kernels. MaterialX PBS 1.39, "surface"
/// and Standard Nodes, "surface_unlit".
class Surface final : public Closure {
 public:
  BsdfPtr bsdf;                        ///< Null: does not scatter.
  EdfPtr edf;                          ///< Null: does not emit.
  Float opacity = 1.0f;                ///< Presence: 0 as if it were not there.
  Color3 transmission = Color3(0.0f);  ///< What passes straight through where present.
  Bool thin_walled = false;  ///< Has no inside: light that enters leaves at the same point.
};
using SurfacePtr = std::shared_ptr<const Surface>;  ///< Null: no surface is connected.

/// The Surface that a port carries; null where nothing is connected.
SurfacePtr as_surface(const ClosurePtr& closure);

}  // namespace nacre
