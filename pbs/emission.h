#pragma once

#include <vector>

#include "pbs/edf.h"
#include "runtime/program/slice.h"

namespace nacre {

/// Light that leaves a surface as samples of directions.
struct SampledEmission {
  std::vector<SliceOutput> emit;  ///< What the kernel `emit` stores; see SurfaceKernels.
  Float pdf;                      ///< The density with which that gives view.wo.
};

/// Of an EDF whose radiance towards view.wo is `radiance`, as recorded for the channel wo. The
/// density of directions is that of emitters, one of which is chosen by its power. They are those
/// of the point as it is seen along its normal Ng, where patterns ask from where it is seen;
/// the radiance is that along the direction.
SampledEmission sampled_emission(const EdfPtr& edf, const View& view, Color3 radiance);

}  // namespace nacre
