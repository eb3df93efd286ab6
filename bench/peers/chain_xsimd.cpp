#include <xsimd/xsimd.hpp>

#include "bench/peers/peers.h"

namespace {

using Batch = xsimd::batch<float>;

/// 0 where the quotient is not finite, as the node `divide`.
Batch divide(Batch a, Batch b) {
  const Batch quotient = a / b;
  return xsimd::select(xsimd::abs(quotient) <= Batch(3.4028234664e38f), quotient, Batch(0.0f));
}

struct State {
  Batch x, y, z;
};

/// Ten of the nodes.
State round(State s, float scale, float share, float offset) {
  const Batch sum = s.x + s.y;
  const Batch scaled = sum * Batch(scale);
  const Batch mixed = xsimd::fma(Batch(share), scaled, xsimd::fnma(Batch(share), s.z, s.z));
  const Batch least = xsimd::min(mixed, sum);
  const Batch most = xsimd::max(least, Batch(-1.5f));
  const Batch limited = xsimd::max(xsimd::min(most, Batch(1.25f)), Batch(-1.0f));
  const Batch rest = limited - s.z;
  const Batch bound = xsimd::abs(rest) + Batch(offset);
  return {divide(rest, bound), limited, mixed};
}

}  // namespace

extern "C" void nacre_peer_chain(const float* x, const float* y, const float* z, float* out,
                                 std::size_t count) {
  for (std::size_t i = 0; i < count; i += Batch::size) {
    State s{Batch::load_unaligned(x + i), Batch::load_unaligned(y + i),
            Batch::load_unaligned(z + i)};
    s = round(s, 0.8f, 0.25f, 0.5f);
    s = round(s, 0.9f, 0.35f, 1.0f);
    s = round(s, 1.0f, 0.45f, 1.5f);
    s = round(s, 1.1f, 0.55f, 2.0f);
    s = round(s, 1.2f, 0.65f, 2.5f);
    s.x.store_unaligned(out + i);
  }
}

extern "C" int nacre_peer_lanes() { return static_cast<int>(Batch::size); }

extern "C" const char* nacre_peer_compiler() {
#ifdef __clang__
  return "clang " __clang_version__;
#else
  return "gcc " __VERSION__;
#endif
}
