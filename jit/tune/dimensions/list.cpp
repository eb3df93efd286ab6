#include "jit/tune/dimensions/list.h"

#include <array>

namespace nacre {

std::span<const Dimension> dimensions() {
  static const std::array all{accuracy_dimension,   anisotropy_dimension, compensation_dimension,
                              footprints_dimension, noise_dimension,      tables_dimension};
  return all;
}

}  // namespace nacre
