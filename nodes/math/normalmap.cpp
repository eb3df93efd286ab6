#include "runtime/node/node_call.h"

namespace nacre {

namespace {

/// b without its part along unit a, made unit; 0 where nothing is left.
Float3 perpendicular(Float3 b, Float3 a) { return normalize(b - Float3(dot(b, a)) * a); }

}  // namespace

/// A normal encoded in [0, 1] and given in the frame (tangent, bitangent,
/// normal), in the space of the frame. MaterialX 1.39 Standard Nodes,
/// "normalmap". The frame is made orthonormal first, as in the Open Shading
/// Language implementation: interpolated tangents aren't quite. An encoded zero
/// (no texel) is the frame's normal. A tangent or bitangent with nothing left adds
/// nothing, and what decodes to zero stays zero. NaN for NaN, for infinities, and
/// for frames so far from unit that products overflow.
void record_normalmap(NodeCall& call) {
  const Float3 encoded = call.vector3("in");
  const Float3 n = call.vector3("normal");
  const Float3 t = perpendicular(call.vector3("tangent"), n);
  const Float3 b = call.vector3("bitangent");
  const Float3 bitangent = perpendicular(b - Float3(dot(b, n)) * n, t);
  const Recorded& scale = call.in("scale");
  const Float scale_x = scale.number(0);
  const Float scale_y = scale.number(scale.parts.size() - 1);
  const auto decode = [](Float x) { return fma(x, 2.0f, -1.0f); };
  const Float3 decoded = normalize(
      fma(t, Float3(decode(encoded.x) * scale_x),
          fma(bitangent, Float3(decode(encoded.y) * scale_y), n * Float3(decode(encoded.z)))));
  const Bool empty = (encoded.x == 0.0f) & (encoded.y == 0.0f) & (encoded.z == 0.0f);
  call.set(select(empty, n, decoded));
}

}  // namespace nacre
