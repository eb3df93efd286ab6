#pragma once

#include <memory>

#include "pbs/edf.h"
#include "pbs/vdf.h"

namespace nacre {

/// A volume shader: what a medium absorbs and scatters, and what it emits per unit of
/// length. MaterialX PBS 1.39, "volume".
class Volume final : public Closure {
 public:
  VdfPtr vdf;  ///< Null: empty space.
  EdfPtr edf;  ///< Null: dark.
};
using VolumePtr = std::shared_ptr<const Volume>;

VolumePtr as_volume(const ClosurePtr& closure);

}  // namespace nacre
