#include "runtime/float_environment.h"

#include <xmmintrin.h>

namespace nacre {

namespace {

// Intel SDM vol. 1, 10.2.3: bit 15 flush-to-zero, bits 14-13 rounding (0: to
// nearest), bits 12-7 exception masks, bit 6 denormals-are-zeros.
constexpr std::uint32_t kernel_mxcsr = 0x8000u | 0x1f80u | 0x0040u;

}  // namespace

ScopedFloatEnvironment::ScopedFloatEnvironment() : saved_(_mm_getcsr()) {
  _mm_setcsr(kernel_mxcsr);
}

ScopedFloatEnvironment::~ScopedFloatEnvironment() { _mm_setcsr(saved_); }

}  // namespace nacre
