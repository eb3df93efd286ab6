#include "examples/bake/texel_error.h"

#include <algorithm>
#include <cmath>

namespace nacre::host {

float texel_error(float difference, float value) {
  return std::abs(difference) / std::max(1.0f, std::abs(value));
}

bool is_any_above(std::span<const float> errors, std::size_t width, std::size_t texel,
                  float error) {
  const std::size_t x = texel % width, y = texel / width, rows = errors.size() / width;
  for (std::size_t j = y > 0 ? y - 1 : 0; j < std::min(y + 2, rows); ++j) {
    for (std::size_t i = x > 0 ? x - 1 : 0; i < std::min(x + 2, width); ++i) {
      if (errors[j * width + i] > error) return true;
    }
  }
  return false;
}

}  // namespace nacre::host
