#pragma once

#include "nodes/noise/hash.h"
#include "runtime/value/vector.h"

namespace nacre {

/// The lattice cell of a coordinate. Beyond the range of int the last cell; 0 for NaN.
inline Int cell_of(Float x) { return to_int(floor(x)); }

struct Cell2 {
  Int x, y;
};
struct Cell3 {
  Int x, y, z;
};
inline Cell2 cell_of(Float2 p) { return {cell_of(p.x), cell_of(p.y)}; }
inline Cell3 cell_of(Float3 p) { return {cell_of(p.x), cell_of(p.y), cell_of(p.z)}; }

inline Cell2 operator+(Cell2 a, Cell2 b) { return {a.x + b.x, a.y + b.y}; }
inline Cell3 operator+(Cell3 a, Cell3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Float2 to_float(Cell2 c) { return {to_float(c.x), to_float(c.y)}; }
inline Float3 to_float(Cell3 c) { return {to_float(c.x), to_float(c.y), to_float(c.z)}; }

/// Position in the cell, in [0, 1].
inline Float2 fraction(Float2 p) { return {fract(p.x), fract(p.y)}; }
inline Float3 fraction(Float3 p) { return {fract(p.x), fract(p.y), fract(p.z)}; }

/// i / 3 for 0 <= i < 27.
inline Int third(Int i) { return shift_right_logical(i * Int(11), Int(5)); }
/// Offsets of the nine or 27 cells around a cell, itself in the middle; the last
/// coordinate runs fastest.
inline Cell2 neighbour2(Int i) {
  const Int row = third(i);
  return {row - Int(1), i - Int(3) * row - Int(1)};
}
inline Cell3 neighbour3(Int i) {
  const Int rows = third(i);
  const Int layer = third(rows);
  return {layer - Int(1), rows - Int(3) * layer - Int(1), i - Int(3) * rows - Int(1)};
}

/// One random number a cell, in [0, 1].
inline Float cell_noise(Cell2 c) { return bits_to_unit(hash(c.x, c.y)); }
inline Float cell_noise(Cell3 c) { return bits_to_unit(hash(c.x, c.y, c.z)); }
/// Another for every integer w.
inline Float cell_noise(Cell3 c, Int w) { return bits_to_unit(hash(c.x, c.y, c.z, w)); }

/// Three random numbers a cell: the key with 0, 1, 2 appended.
inline Float3 cell_noise3(Cell2 c) {
  const auto component = [&](int k) { return bits_to_unit(hash(c.x, c.y, Int(k))); };
  return {component(0), component(1), component(2)};
}
inline Float3 cell_noise3(Cell3 c) {
  const HashState s = hash_three_of(4, c.x, c.y, c.z);
  const auto component = [&](int k) { return bits_to_unit(hash_finish({s.a + Int(k), s.b, s.c})); };
  return {component(0), component(1), component(2)};
}
inline Float3 cell_noise3(Cell3 c, Int w) {
  const HashState s = hash_three_of(5, c.x, c.y, c.z);
  const auto component = [&](int k) {
    return bits_to_unit(hash_finish({s.a + w, s.b + Int(k), s.c}));
  };
  return {component(0), component(1), component(2)};
}

}  // namespace nacre
