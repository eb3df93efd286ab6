#pragma once

#include <array>

#include "runtime/texture/sampling.h"
#include "runtime/value/value.h"

namespace nacre {

/// The coordinate in [0, 1] that an address mode makes of any float, as sampling.h says.
/// For `constant` it is u itself: what lies outside is replaced in the end, see outside().
Float address(Float u, AddressMode mode);

/// Where the node's default stands in: u is not in [0, 1] and the mode is `constant`.
Bool outside(Float u, AddressMode mode);

/// Of a probe, which beyond the edge has the texels of the edge: outside() is for the point itself.
AddressMode within(AddressMode mode);

/// One axis of a mip level.
struct Extent {
  Int size;       ///< Texels, at least 1.
  Float numeric;  ///< The same.
};

/// The texels of one axis that a filter reads, and how far the point lies from tap
/// `origin`'s centre towards the next one, in texels: [0, 1).
struct Taps {
  std::array<Int, 4> texel;
  int count = 0;
  Float t;
};

/// `u` as address() gives it. Every tap is in [0, size) for any such u; for `constant`
/// for u in [0, 1] (it stays a number the engines can look up for all others).
Taps closest_tap(Float u, const Extent& extent);
Taps linear_taps(Float u, const Extent& extent, AddressMode mode);
Taps cubic_taps(Float u, const Extent& extent, AddressMode mode);
/// Those of a filter.
Taps taps(Float u, const Extent& extent, TextureFilter filter, AddressMode mode);

/// Uniform cubic B-spline: weights of taps -1, 0, 1, 2 at distance t from tap 0.
std::array<Float, 4> b_spline(Float t);

}  // namespace nacre
