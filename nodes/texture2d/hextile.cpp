#include "nodes/texture2d/hextile.h"

namespace nacre {

namespace {

constexpr float lattice = 3.4641016151377544f;  // 2 sqrt(3): cells for one unit of texcoord.
constexpr float tan_30 = 0.57735027f;
constexpr float inverse_cos_30 = 1.15470054f;

/// The product rounded by itself, also where a sum follows.
Float rounded_product(Float a, Float b) { return fma(a, b, 0.0f); }

/// (1 - t) a + t b
Float mix(Float a, Float b, Float t) { return fma(t, b - a, a); }

/// Two numbers in [0, 1) for a vertex of the lattice.
Float2 hash(Float2 vertex) {
  // The offset avoids the zeros that the vertices around the origin would give.
  const Float x = vertex.x + 0.12345f;
  const Float y = vertex.y + 0.12345f;
  const Float a = fract(rounded_product(x, 0.1031f));
  const Float b = fract(rounded_product(y, 0.1030f));
  const Float c = fract(rounded_product(x, 0.0973f));
  const Float sum = rounded_product(a, b + 33.33f) + rounded_product(b, c + 33.33f) +
                    rounded_product(c, a + 33.33f);
  const Float p = a + sum;
  const Float q = b + sum;
  const Float r = c + sum;
  return {fract(rounded_product(p + q, r)), fract(rounded_product(p + r, q))};
}

/// How the copies of the image differ.
struct Variation {
  Float rotation, scale, offset;
  Float2 rotation_range;  ///< Degrees.
  Float2 scale_range;
  Float2 offset_range;
};

Hexagon make_hexagon(Float weight, Float2 vertex, Float2 coord, const Variation& vary) {
  const Float2 random = hash(vertex);
  const Float2 centre{fma(vertex.y, 0.5f, vertex.x) * (1.0f / lattice),
                      vertex.y * (1.0f / (lattice * inverse_cos_30))};
  const SinCos turn =
      sin_cos_degrees(mix(vary.rotation_range.x, vary.rotation_range.y, random.x * vary.rotation));
  const Float size = mix(1.0f, mix(vary.scale_range.x, vary.scale_range.y, random.y), vary.scale);
  const auto shift = [&](Float number) {
    return mix(vary.offset_range.x, vary.offset_range.y, number * vary.offset);
  };
  const Float2 from = coord - centre;
  const Float2 turned{from.x * turn.cos - from.y * turn.sin, from.x * turn.sin + from.y * turn.cos};
  const Float2 found{turned.x / size + centre.x + shift(random.x),
                     turned.y / size + centre.y + shift(random.y)};
  return {weight, {found.x, 1.0f - found.y}, turn};
}

/// Schlick's gain: x for r = 1/2, steeper around 1/2 below that.
Float gain(Float x, Float r) {
  const Float a = (1.0f / clamp(r, 0.001f, 0.999f) - 2.0f) * fma(x, -2.0f, 1.0f);
  return select(x < 0.5f, x / (a + 1.0f), (a - x) / (a - 1.0f));
}

Float3 to_unit_sum(Float3 w) {
  const Float sum = w.x + w.y + w.z;
  return w * Float3(select(sum == 0.0f, 0.0f, 1.0f / sum));
}

}  // namespace

std::array<Hexagon, 3> find_hexagons(NodeCall& call) {
  const Float2 tiled = call.vector2("texcoord") * call.vector2("tiling");
  const Float2 coord{tiled.x, 1.0f - tiled.y};  // See the header: v counts from the top.
  const Variation vary{call.number("rotation"),    call.number("scale"),
                       call.number("offset"),      call.vector2("rotationrange"),
                       call.vector2("scalerange"), call.vector2("offsetrange")};
  // Skewed, the triangles of the lattice are halves of unit squares.
  const Float2 st = coord * Float(lattice);
  const Float2 skewed{fma(st.y, -tan_30, st.x), st.y * inverse_cos_30};
  const Float2 base{floor(skewed.x), floor(skewed.y)};
  const Float2 in = skewed - base;
  const Float third = 1.0f - in.x - in.y;
  const Bool upper = third <= 0.0f;  // The half away from `base`.
  const Float one = to_float(upper);
  const Float zero = 1.0f - one;
  const auto weight = [&](Float x) { return select(upper, 1.0f - x, x); };
  return {make_hexagon(abs(third), {base.x + one, base.y + one}, coord, vary),
          make_hexagon(weight(in.y), {base.x + one, base.y + zero}, coord, vary),
          make_hexagon(weight(in.x), {base.x + zero, base.y + one}, coord, vary)};
}

Float3 blend_weights(const std::array<Hexagon, 3>& hexagons, Float3 emphasis, Float falloff) {
  const auto seventh = [](Float w) { return square(w * square(w)) * w; };
  Float3 w = to_unit_sum(emphasis * Float3(seventh(hexagons[0].weight), seventh(hexagons[1].weight),
                                           seventh(hexagons[2].weight)));
  if (falloff.is_constant(0.5f)) return w;
  return to_unit_sum({gain(w.x, falloff), gain(w.y, falloff), gain(w.z, falloff)});
}

}  // namespace nacre
