#pragma once

#include <cstdint>

#include "pbs/lobe.h"

namespace nacre {

/// A lobe as the kernels use it.
struct Term {
  LobePtr lobe;  ///< Never null.
  Color3 weight;
  Float probability;  ///< With which `sample` picks it.
  std::uint32_t origin = 0;
  BySide wanted;  ///< As View::wanted.
};

}  // namespace nacre
