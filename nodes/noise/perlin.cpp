#include "nodes/noise/perlin.h"

#include "nodes/noise/cell.h"
#include "nodes/noise/hash.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

// Bring the greatest values of the noise close to 1; found by experiment, Open
// Shading Language, oslnoise.h.
constexpr float scale2 = 0.6616f;
constexpr float scale3 = 0.9820f;

/// 6 t^5 - 15 t^4 + 10 t^3, Perlin 2002, eq. for s(t).
Float fade(Float t) { return t * t * t * fma(t, fma(t, 6.0f, -15.0f), 10.0f); }

Float negate_if(Float x, Int bit) { return select(bit == Int(0), x, -x); }

/// (x, y) times one of the eight vectors (+-1, +-2) and (+-2, +-1).
Float gradient(Int hash, Float2 p) {
  const Bool first = (hash & Int(4)) == Int(0);
  const Float u = select(first, p.x, p.y);
  const Float v = 2.0f * select(first, p.y, p.x);
  return negate_if(u, hash & Int(1)) + negate_if(v, hash & Int(2));
}

/// (x, y, z) times one of the vectors to the edges of the cube, four of them twice:
/// Perlin 2002.
Float gradient(Int hash, Float3 p) {
  const Int h = hash & Int(15);
  const Float u = select(h < Int(8), p.x, p.y);
  const Bool repeated = (h & Int(13)) == Int(12);
  const Float v = select(h < Int(4), p.y, select(repeated, p.x, p.z));
  return negate_if(u, h & Int(1)) + negate_if(v, h & Int(2));
}

/// The gradients of one noise, and of three out of one hash.
template <class P>
Float gradients(Float /*result*/, Int hash, P p) {
  return gradient(hash, p);
}
template <class P>
Float3 gradients(Float3 /*result*/, Int hash, P p) {
  return {gradient(hash, p), gradient(shift_right_logical(hash, Int(8)), p),
          gradient(shift_right_logical(hash, Int(16)), p)};
}

/// Bilinear over the corners of the cell with faded weights; R: Float or Float3.
template <class R>
R noise2(Float2 p) {
  const Cell2 cell = cell_of(p);
  const Float2 f = fraction(p);
  const auto corner = [&](int i, int j) {
    const Float2 offset{f.x - float(i), f.y - float(j)};
    return gradients(R(), hash(cell.x + Int(i), cell.y + Int(j)), offset);
  };
  const Float u = fade(f.x);
  const auto edge = [&](int j) { return lerp(corner(0, j), corner(1, j), u); };
  return R(scale2) * lerp(edge(0), edge(1), fade(f.y));
}

template <class R>
R noise3(Float3 p) {
  const Cell3 cell = cell_of(p);
  const Float3 f = fraction(p);
  const auto corner = [&](int i, int j, int k) {
    const Float3 offset(f.x - float(i), f.y - float(j), f.z - float(k));
    return gradients(R(), hash(cell.x + Int(i), cell.y + Int(j), cell.z + Int(k)), offset);
  };
  const Float u = fade(f.x);
  const Float v = fade(f.y);
  const auto edge = [&](int j, int k) { return lerp(corner(0, j, k), corner(1, j, k), u); };
  const auto face = [&](int k) { return lerp(edge(0, k), edge(1, k), v); };
  return R(scale3) * lerp(face(0), face(1), fade(f.z));
}

}  // namespace

Float perlin(Recorder& recorder, Float2 p) {
  return outline<Float>(recorder, "perlin2d_1", noise2<Float>, p);
}

Float perlin(Recorder& recorder, Float3 p) {
  return outline<Float>(recorder, "perlin3d_1", noise3<Float>, p);
}

Float3 perlin3(Recorder& recorder, Float2 p) {
  return outline<Float3>(recorder, "perlin2d_3", noise2<Float3>, p);
}

Float3 perlin3(Recorder& recorder, Float3 p) {
  return outline<Float3>(recorder, "perlin3d_3", noise3<Float3>, p);
}

}  // namespace nacre
