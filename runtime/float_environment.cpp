#include "runtime/float_environment.h"

#include <xmmintrin.h>

namespace nacre {

namespace {

// Intel SDM vol. 1, 10.2.3: bit 15 flush-to-zero, bits 14-13 rounding (0: to
// nearest), bits 12-7 exception masks, bit 6 denormals-are-zeros.
constexpr std::uint32_t kernel_mxcsr = 0x8000u | 0x1f80u | 0x0040u;

/// Bits 5-0: which exceptions there were.
constexpr std::uint32_t sticky_flags = 0x3fu;

/// All exceptions masked, nothing else.
constexpr std::uint32_t default_mxcsr = 0x1f80u;

}  // namespace

std::uint32_t enter_float_environment() {
  // Where it is set already, as within another of these, writing it again takes as long as a dozen
  // operations.
  const std::uint32_t own = _mm_getcsr();
  if ((own & ~sticky_flags) != kernel_mxcsr) _mm_setcsr(kernel_mxcsr);
  return own;
}

void leave_float_environment(std::uint32_t own) {
  if (_mm_getcsr() != own) _mm_setcsr(own);
}

ScopedDefaultFloatEnvironment::ScopedDefaultFloatEnvironment() : saved_() {
  std::fegetenv(&saved_);
  // With the control word of the x87, whose rounding strtod() asks for.
  std::fesetenv(FE_DFL_ENV);
  _mm_setcsr(default_mxcsr);
}

ScopedDefaultFloatEnvironment::~ScopedDefaultFloatEnvironment() { std::fesetenv(&saved_); }

}  // namespace nacre
