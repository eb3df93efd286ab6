#pragma once

#include <vector>

#include "runtime/node/node_call.h"
#include "runtime/program/slice.h"

namespace nacre {

/// What a medium, displacement or light is in numbers, as channels:
///
///   VDF                 absorption.x .y .z, scattering.x .y .z, anisotropy
///   volumeshader        the same, and emission.x .y .z per unit of length, towards wo
///   displacementshader  offset.x .y .z, world space
///   lightshader         intensity.x .y .z; but for `light` direction.x .y .z; and
///                       distance, unless it is infinitely far away
///
/// See pbs/vdf.h, volume.h, displacement.h and light.h. An unconnected shader is empty
/// space, no offset, or dark. None for other types: surfaces are pbs/kernels.h's.
std::vector<SliceOutput> shader_channels(Recorder& recorder, Accuracy accuracy,
                                         const Recorded& value);

/// True if a displacement, medium or light with these channels does nothing: all of them,
/// whatever the anisotropy of scattering and the direction of light are, are a literal 0.
bool all_zero(const std::vector<SliceOutput>& channels);

}  // namespace nacre
