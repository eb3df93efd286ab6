#pragma once

#include <limits>

namespace nacre {

// Constants in several floats: each is what the ones before leave, rounded to
// nearest. Values from their series in 60 digits (coefficients.py's arithmetic).

inline constexpr float pi_high = 0x1.921fb6p+1f;
inline constexpr float pi_low = -0x1.777a5cp-24f;
inline constexpr float half_pi_high = 0x1.921fb6p+0f;
inline constexpr float half_pi_low = -0x1.777a5cp-25f;
inline constexpr float quarter_pi_high = 0x1.921fb6p-1f;
inline constexpr float quarter_pi_low = -0x1.777a5cp-26f;
inline constexpr float ln2_high = 0x1.62e43p-1f;
inline constexpr float ln2_low = -0x1.05c61p-29f;
inline constexpr float log2e_high = 0x1.715476p+0f;
inline constexpr float log2e_low = 0x1.4ae0cp-26f;

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Adding 1.5 * 2^23 to |x| < 2^22 rounds x to the nearest integer and leaves
/// that integer in the low bits of the sum.
inline constexpr float round_to_low_bits = 0x1.8p+23f;

}  // namespace nacre
