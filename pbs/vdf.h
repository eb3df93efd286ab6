#pragma once

#include <memory>

#include "pbs/view.h"
#include "runtime/node/recorded.h"

namespace nacre {

/// A homogeneous medium: coefficients per scene unit of length, at least 0, and
/// the mean cosine of scattering, in [-1, 1]. Surface kernels do not use it: a
/// medium under a BSDF is the renderer's to trace.
class Vdf final : public Closure {
 public:
  Color3 absorption = Color3(0.0f);  ///< Per unit of length.
  Color3 scattering = Color3(0.0f);  ///< Per unit of length.
  Float anisotropy = 0.0f;           ///< 0: all directions alike.
};
using VdfPtr = std::shared_ptr<const Vdf>;  ///< Null: no medium.

/// Null where the closure is none.
VdfPtr as_vdf(const ClosurePtr& closure);

/// Coefficients of whatever numbers they were computed of: below zero, and NaN, is zero, and what
/// is beyond the largest float is that.
Color3 finite_coefficients(Color3 coefficients);

/// Both media in one place: coefficients add up. Scattering by the two is taken for one
/// with the same mean cosine, the mean of theirs by what each scatters, all components
/// together; a mixture of two lobes has no anisotropy of its own. Null counts as empty.
VdfPtr sum(const VdfPtr& a, const VdfPtr& b);

/// Coefficients times `factor`, which is at least 0. Null stays null.
VdfPtr scaled(const VdfPtr& vdf, Color3 factor);

}  // namespace nacre
