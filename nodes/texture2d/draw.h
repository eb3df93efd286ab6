#pragma once

#include "nodes/texture2d/footprint.h"
#include "nodes/texture2d/texel_fetch.h"

namespace nacre {

/// One of the texels that the probes' filter weighs, each as often as it weighs, over all u in
/// [0, 1). `uv` as the point has it.
Float4 draw_texel(const TexelFetch& fetch, Float2 uv, const Probes& probes, TextureModes modes,
                  Float u);

}  // namespace nacre
