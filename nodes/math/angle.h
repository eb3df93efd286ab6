#pragma once

#include "runtime/value/value.h"

namespace nacre {

struct SinCos {
  Float sin, cos;
};

/// Of an angle in degrees. Whole turns are removed before the conversion to
/// radians, exactly, so large angles lose nothing.
inline SinCos sin_cos_degrees(Float degrees) {
  const Float turns = round(degrees * (1.0f / 360.0f));
  const Float radians = fma(turns, -360.0f, degrees) * 0.017453292519943295f;
  return {sin(radians), cos(radians)};
}

}  // namespace nacre
