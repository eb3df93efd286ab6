#pragma once

namespace nacre {

// GCC defines a macro for each sanitizer, Clang has them as features.
#if defined(__has_feature)
#define NACRE_HAS_FEATURE(name) __has_feature(name)
#else
#define NACRE_HAS_FEATURE(name) 0
#endif

/// This program runs under AddressSanitizer, which keeps what was freed for a while: bounds
/// on memory and time mean less then, and what leaks it says itself.
#if defined(__SANITIZE_ADDRESS__) || NACRE_HAS_FEATURE(address_sanitizer)
inline constexpr bool address_sanitizer = true;
#else
inline constexpr bool address_sanitizer = false;
#endif

/// This program runs under ThreadSanitizer.
#if defined(__SANITIZE_THREAD__) || NACRE_HAS_FEATURE(thread_sanitizer)
inline constexpr bool thread_sanitizer = true;
#else
inline constexpr bool thread_sanitizer = false;
#endif

#undef NACRE_HAS_FEATURE

/// Frames are several times larger, and terabytes of address space are taken.
inline constexpr bool is_sanitized = address_sanitizer || thread_sanitizer;

}  // namespace nacre
