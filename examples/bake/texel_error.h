#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nacre::host {

/// What `difference` of numbers near `value` is as the error of a texel: relative to values
/// above 1.
float texel_error(float difference, float value);

/// The means beside a texel's.
struct Neighbours {
  float left, right, up, down;
};

/// Of whole rows of `width`. At the edges of the image, and of what is `covered`, a texel stands
/// for the one that is not there.
Neighbours neighbours_of(std::span<const float> means, std::span<const std::uint8_t> covered,
                         std::size_t width, std::size_t texel);

/// The higher of the second differences along and across: of an edge that may be in the texel.
float edge_within(const Neighbours& beside, float mean);

/// Whether the error of a texel, or of one of the eight around it, is above `error`. `errors` are
/// of whole rows of `width`.
bool is_any_above(std::span<const float> errors, std::size_t width, std::size_t texel, float error);

}  // namespace nacre::host
