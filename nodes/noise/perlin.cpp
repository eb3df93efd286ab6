#include "nodes/noise/perlin.h"

#include <array>
#include <span>
#include <string_view>
#include <vector>

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

/// A component of the vectors by the low bits of a hash. So few entries are permuted in registers,
/// in place of compares and blends.
struct Components {
  std::string_view name;
  std::vector<float> values;

  Float at(Int hash) const {
    const Int index = hash & Int(static_cast<int>(values.size()) - 1);
    if (index.is_constant()) return values[static_cast<std::size_t>(index.constant())];
    const Ref ref = index.ref();
    Recorder& recorder = *ref.recorder;
    return Float(recorder.emit(Op::table, std::span(&ref, 1), recorder.table(name, values)));
  }
};

/// Of the eight vectors (+-1, +-2) and (+-2, +-1): bit 2 tells which, bits 0 and 1 the signs.
Components of_plane(std::string_view name, int axis) {
  Components made{name, {}};
  for (unsigned h = 0; h < 8; ++h) {
    const float one = (h & 1) != 0 ? -1.0f : 1.0f, two = (h & 2) != 0 ? -2.0f : 2.0f;
    made.values.push_back(((h & 4) == 0) == (axis == 0) ? one : two);
  }
  return made;
}

/// Of the vectors to the edges of the cube, four of them twice: Perlin 2002. A component of 0 has
/// the sign of `zero`.
Components of_cube(std::string_view name, int axis, float zero) {
  Components made{name, {}};
  for (unsigned h = 0; h < 16; ++h) {
    const int first = h < 8 ? 0 : 1;
    const int second = h < 4 ? 1 : h == 12 || h == 14 ? 0 : 2;
    const float u = (h & 1) != 0 ? -1.0f : 1.0f, v = (h & 2) != 0 ? -1.0f : 1.0f;
    made.values.push_back(axis == first ? u : axis == second ? v : zero);
  }
  return made;
}

/// p times the vector; `far`: by axis, whether p is as seen from the cell's farther corner.
Float gradient(Int hash, Float2 p, std::array<bool, 2> /*far*/) {
  static const Components x = of_plane("perlin2d.x", 0), y = of_plane("perlin2d.y", 1);
  return fma(x.at(hash), p.x, y.at(hash) * p.y);
}

/// What is not there is -0, which a sum keeps: p is at least 0 as seen from the nearer corner, and
/// less from the farther one.
Float gradient(Int hash, Float3 p, std::array<bool, 3> far) {
  static const std::array near_corner{of_cube("perlin3d.x", 0, -0.0f),
                                      of_cube("perlin3d.y", 1, -0.0f),
                                      of_cube("perlin3d.z", 2, -0.0f)};
  static const std::array far_corner{of_cube("perlin3d.far_x", 0, 0.0f),
                                     of_cube("perlin3d.far_y", 1, 0.0f),
                                     of_cube("perlin3d.far_z", 2, 0.0f)};
  const auto component = [&](std::size_t axis) {
    return (far[axis] ? far_corner : near_corner)[axis].at(hash);
  };
  return fma(component(0), p.x, fma(component(1), p.y, component(2) * p.z));
}

/// The gradients of one noise, and of three out of one hash.
template <class P, std::size_t n>
Float gradients(Float /*result*/, Int hash, P p, std::array<bool, n> far) {
  return gradient(hash, p, far);
}
template <class P, std::size_t n>
Float3 gradients(Float3 /*result*/, Int hash, P p, std::array<bool, n> far) {
  return {gradient(hash, p, far), gradient(shift_right_logical(hash, Int(8)), p, far),
          gradient(shift_right_logical(hash, Int(16)), p, far)};
}

/// Bilinear over the corners of the cell with faded weights; R: Float or Float3.
template <class R>
R noise2(Float2 p) {
  const Cell2 cell = cell_of(p);
  const Float2 f = fraction(p);
  const auto corner = [&](int i, int j) {
    const Float2 offset{f.x - float(i), f.y - float(j)};
    const std::array far{i == 1, j == 1};
    return gradients(R(), hash(cell.x + Int(i), cell.y + Int(j)), offset, far);
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
    const std::array far{i == 1, j == 1, k == 1};
    return gradients(R(), hash(cell.x + Int(i), cell.y + Int(j), cell.z + Int(k)), offset, far);
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
