#pragma once

#include <cstddef>

/// Kernels as an expert writes them by hand with xsimd, for the machine that compiles
/// them: what the JIT's code is measured against. Each is one translation unit of its own,
/// made by the best compiler that CMake finds, and computes the formula of a kernel of
/// ours. Arrays hold `count` floats, a multiple of 16.
extern "C" {

/// bench/documents/chain.mtlx.
void nacre_peer_chain(const float* x, const float* y, const float* z, float* out,
                      std::size_t count);

/// bench/documents/fractal.mtlx.
void nacre_peer_fractal(const float* x, const float* y, const float* z, float* out,
                        std::size_t count);

/// GGX reflection of a conductor in the local frame; see conductor.h.
struct NacreConductor {
  const float *wo_x, *wo_y, *wo_z, *wi_x, *wi_y, *wi_z;
  const float *alpha_x, *alpha_y;
  float n[3], k[3];  ///< Complex index, the same for all points.
  float *f_x, *f_y, *f_z, *pdf;
};
void nacre_peer_conductor(const NacreConductor* arguments, std::size_t count);

/// Floats in a register of the peers, and what compiled them.
int nacre_peer_lanes();
const char* nacre_peer_compiler();
}
