#include "examples/bake/texel_error.h"

#include <algorithm>
#include <cmath>

namespace nacre::host {

float texel_error(float difference, float value) {
  return std::abs(difference) / std::max(1.0f, std::abs(value));
}

Neighbours neighbours_of(std::span<const float> means, std::span<const std::uint8_t> covered,
                         std::size_t width, std::size_t texel) {
  const std::size_t x = texel % width;
  const auto at = [&](bool is_there, std::size_t other) {
    return is_there && covered[other] != 0 ? means[other] : means[texel];
  };
  return {at(x > 0, texel - 1), at(x + 1 < width, texel + 1), at(texel >= width, texel - width),
          at(texel + width < means.size(), texel + width)};
}

float edge_within(const Neighbours& beside, float mean) {
  const float along = std::abs(beside.left + beside.right - 2.0f * mean);
  const float across = std::abs(beside.up + beside.down - 2.0f * mean);
  return std::max(along, across);
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
