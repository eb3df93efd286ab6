#pragma once

#include <cfenv>
#include <cstdint>

namespace nacre {

/// Sets the floating-point environment that every Program runs in, whatever the host's is: round to
/// nearest even, denormals flushed to zero on the way in and out, exceptions masked. Returns the
/// host's, to be restored, sticky flags included.
/// @{
std::uint32_t enter_float_environment();
void leave_float_environment(std::uint32_t own);
/// @}

/// The same from construction to destruction.
class ScopedFloatEnvironment {
 public:
  ScopedFloatEnvironment() : saved_(enter_float_environment()) {}
  ~ScopedFloatEnvironment() { leave_float_environment(saved_); }
  ScopedFloatEnvironment(const ScopedFloatEnvironment&) = delete;
  ScopedFloatEnvironment& operator=(const ScopedFloatEnvironment&) = delete;

 private:
  std::uint32_t saved_;
};

/// The environment in which everything before a kernel runs is computed, whatever the
/// host's is, so that the same document is the same kernel: the C language's default,
/// which rounds to nearest even and keeps denormals, exceptions masked. For the beginning
/// of what a host calls.
class ScopedDefaultFloatEnvironment {
 public:
  ScopedDefaultFloatEnvironment();
  ~ScopedDefaultFloatEnvironment();
  ScopedDefaultFloatEnvironment(const ScopedDefaultFloatEnvironment&) = delete;
  ScopedDefaultFloatEnvironment& operator=(const ScopedDefaultFloatEnvironment&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace nacre
