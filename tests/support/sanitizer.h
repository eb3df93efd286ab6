#pragma once

namespace nacre {

/// This program runs under AddressSanitizer, which keeps what was freed for a while: bounds
/// on memory and time mean less then, and what leaks it says itself.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool address_sanitizer = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool address_sanitizer = true;
#else
inline constexpr bool address_sanitizer = false;
#endif
#else
inline constexpr bool address_sanitizer = false;
#endif

}  // namespace nacre
