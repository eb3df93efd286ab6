#pragma once

#include "pbs/vdf.h"

namespace nacre {

/// The medium whose surface sends back `albedo` of the light that a half-space of it gets from all
/// sides alike, through a boundary that light is scattered by like by paper and not reflected.
///
/// By van de Hulst's fit of the spherical albedo, (1 - s) (1 - 0.139 s) / (1 + 1.17 s) with
/// s² = (1 - a) / (1 - a g) (Kulla and Conty, "Revisiting Physically Based Shading at Imageworks",
/// SIGGRAPH 2017 course, slide "Albedo inversion"; OpenPBR 1.1, "Subsurface"), solved for s in the
/// form that loses no digits where the albedo is near 1.
///
/// `albedo`: in [0, 1]; 1 is a medium that absorbs nothing. `radius`: the mean free path in scene
/// units, by channel, taken for 1e-6 where it is less. `anisotropy`: the mean cosine, clamped to
/// [-0.999, 0.999].
Vdf subsurface_medium(Color3 albedo, Color3 radius, Float anisotropy);

}  // namespace nacre
