#pragma once

#include "jit/tune/dimension.h"

namespace nacre {

extern const Dimension accuracy_dimension;
extern const Dimension anisotropy_dimension;
extern const Dimension compensation_dimension;
extern const Dimension footprints_dimension;
extern const Dimension noise_dimension;
extern const Dimension tables_dimension;

}  // namespace nacre
