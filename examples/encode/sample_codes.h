#pragma once

#include <cstddef>
#include <cstdint>

namespace nacre::host {

/// Numbers of an integer file for numbers as computed: floor(largest * x + 1/2), exactly
/// rounded, of x clamped to [0, 1]; NaN is 0. `is_srgb`: of the sRGB code of x, see SrgbCodes.
/// `count` numbers from `values` go to every `stride`-th place from `codes` on. 65535 is the
/// largest in 16 bits.
void put_codes(const float* values, std::size_t count, bool is_srgb, std::uint8_t* codes,
               std::size_t stride);
void put_codes(const float* values, std::size_t count, bool is_srgb, std::uint16_t* codes,
               std::size_t stride);

}  // namespace nacre::host
