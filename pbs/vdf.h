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
  Color3 absorption = Color3(0.0f);
  Color3 scattering = Color3(0.0f);
  Float anisotropy = 0.0f;
};
using VdfPtr = std::shared_ptr<const Vdf>;

}  // namespace nacre
