#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>

#include "examples/bake/bake.h"
#include "examples/bake/point_shader.h"
#include "examples/bake/sample_set.h"

namespace nacre::host {

/// Called after a run for each of its texels: which of the list it is, and the first of its
/// samples among the shader's results.
using TexelSamples = std::function<void(std::size_t texel, std::size_t begin)>;

/// Shades these places of each texel of a list, in runs of as many texels as are worth it. Texels
/// are counted from row `first_row` on. `points` is what is handed over, kept from call to call;
/// its footprint is the caller's.
RunStatus run_texels(PointShader& shader, std::span<const std::size_t> texels, int first_row,
                     std::span<const SamplePlace> places, TexelPoints& points,
                     const std::atomic<std::uint32_t>& stop, BakeCounts& counts,
                     const TexelSamples& samples);

}  // namespace nacre::host
