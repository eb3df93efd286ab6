#pragma once

#include "pbs/surface.h"

namespace nacre {

/// What the two sides of a surface show; `back` is null where it shows the front's.
struct SurfaceSides {
  SurfacePtr front, back;
};

/// The sides of a material by the shaders that are connected to it, either may be null
/// (MaterialX PBS 1.39, "Surfaces"): one shader is on both sides; if one is thin-walled
/// both are; of two that bound a solid, neither thin-walled, the front one is on both
/// sides. Two without a BSDF, such as surface_unlit, bound nothing and keep their sides.
SurfaceSides surface_sides(SurfacePtr front, SurfacePtr back);

}  // namespace nacre
