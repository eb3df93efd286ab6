#pragma once

#include <cstddef>
#include <span>

namespace nacre::host {

/// What `difference` of numbers near `value` is as the error of a texel: relative to values
/// above 1.
float texel_error(float difference, float value);

/// Whether the error of a texel, or of one of the eight around it, is above `error`. `errors` are
/// of whole rows of `width`.
bool is_any_above(std::span<const float> errors, std::size_t width, std::size_t texel, float error);

}  // namespace nacre::host
