#pragma once

namespace nacre::codegen {

/// The x86 features that the emitter asks about.
struct Features {
  bool avx = false;
  bool avx2 = false;
  bool f16c = false;
  bool avx512 = false;  ///< F, BW, DQ and VL: masks are native at every width.
};

}  // namespace nacre::codegen
