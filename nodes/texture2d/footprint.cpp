#include "nodes/texture2d/footprint.h"

#include "runtime/value/control.h"

namespace nacre {

namespace {

/// No footprint is larger: images are at most 16384 texels wide, so that no square of what
/// follows overflows. NaN stays.
Float bounded(Float d) { return min(Float(1024.0f), max(Float(-1024.0f), d)); }

Float2 in_texels(Float2 d, const MipLevel& finest) {
  return {bounded(d.x) * finest.x.numeric, bounded(d.y) * finest.y.numeric};
}

/// The ellipse that a circle of one pixel becomes under (dx, dy), in texels: the
/// eigenvectors of [c b; b a] = dx dx^T + dy dy^T.
struct Ellipse {
  Float major;       ///< Half its longer axis.
  Float minor;       ///< Half its shorter axis.
  Float2 direction;  ///< Of the longer axis: a unit vector, unless the axes are equal.
};

Ellipse ellipse_of(Float2 dx, Float2 dy) {
  const Float c = fma(dx.x, dx.x, dy.x * dy.x);
  const Float a = fma(dx.y, dx.y, dy.y * dy.y);
  const Float b = fma(dx.x, dx.y, dy.x * dy.y);
  const Float gap = abs(c - a);
  const Float root = sqrt(fma(gap, gap, 4.0f * b * b));
  Ellipse ellipse;
  ellipse.major = sqrt(0.5f * (c + a + root));
  // The product of the axes is the determinant: their difference would cancel.
  ellipse.minor = abs(dx.x * dy.y - dx.y * dy.x) / ellipse.major;
  const Float along = 0.5f * (gap + root);
  const Float scale = 1.0f / sqrt(max(fma(along, along, b * b), 1e-30f));
  const Bool wide = c >= a;
  ellipse.direction = {select(wide, along, b) * scale, select(wide, b, along) * scale};
  return ellipse;
}

/// For x >= 1: floor(log2(x)), and x over that power of two, less one.
struct Octave {
  Float number;
  Float part;
};

Octave octave_of(Float x) {
  const Int bits = bits_of(x);
  return {to_float((bits >> Int(23)) - Int(127)),
          float_of_bits((bits & Int(0x007fffff)) | Int(0x3f800000)) - 1.0f};
}

Probes measured(Float2 dx, Float2 dy, const MipLevel& finest, Float last, Float most) {
  const Ellipse ellipse = ellipse_of(dx, dy);
  const Float widest = most * ellipse.minor;
  const Bool too_long = ellipse.major > widest;
  const Float major = select(too_long, 0.5f * (ellipse.major + widest), ellipse.major);
  const Float minor = select(too_long, major / most, ellipse.minor);
  const Octave octave = octave_of(max(minor, 1.0f));
  Probes probes;
  probes.level = min(octave.number, last);
  probes.blend = select(octave.number < last, octave.part, 0.0f);
  // Below half a texel a narrower line of probes shows no more.
  const Float aspect = clamp(major / max(minor, 0.5f), 1.0f, most);
  probes.count = max(floor(fma(2.0f, aspect, -1.0f + 0x1p-10f)), 1.0f);
  const Float length = major - minor;
  probes.reach = {length * ellipse.direction.x / finest.x.numeric,
                  length * ellipse.direction.y / finest.y.numeric};
  probes.spread = 0.5f * major / max(length, 1e-30f);
  return probes;
}

}  // namespace

Probes find_probes(Float2 dx, Float2 dy, const MipLevel& finest, Float last, Float max_anisotropy) {
  const Float2 x = in_texels(dx, finest);
  const Float2 y = in_texels(dy, finest);
  const Probes one{.level = 0.0f, .blend = 0.0f, .count = 1.0f, .reach = {}, .spread = 0.0f};
  // The sum of the squared axes; two probes need a longer axis of 3/4. NaN: one probe.
  const Float squares = dot(x, x) + dot(y, y);
  return if_any(squares > 9.0f / 16.0f, one,
                [&] { return measured(x, y, finest, last, max_anisotropy); });
}

Bool is_magnified(const Probes& probes) {
  return (probes.count <= 1.0f) & (probes.level + probes.blend <= 0.0f);
}

Float probe_position(const Probes& probes, Float i) {
  return (2.0f * i + 1.0f) / probes.count - 1.0f;
}

Float probe_weight(const Probes& probes, Float p) {
  const Float x = p * probes.spread;
  return exp(-2.0f * x * x);
}

}  // namespace nacre
