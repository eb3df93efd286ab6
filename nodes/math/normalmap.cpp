#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

/// b without its part along unit a, made unit; 0 where nothing is left.
Float3 perpendicular(Float3 b, Float3 a) { return normalize(b - Float3(dot(b, a)) * a); }

/// n, unit; the host's own is that already.
Float3 unit(Recorder& recorder, Float3 n) {
  return same_value(n, normal(recorder, Space::world)) ? n : normalize(n);
}

}  // namespace

/// A normal encoded in [0, 1] and given in the frame (tangent, bitangent, normal), in the space of
/// the frame. MaterialX 1.39 Standard Nodes, "normalmap". The frame is made orthonormal first, as
/// in the Open Shading Language implementation: interpolated tangents aren't quite. An encoded zero
/// (no texel) is the frame's normal; and so is, unit, one that leans to no side, so that what
/// shades by it costs no more than without. A tangent or bitangent with nothing left adds nothing,
/// and what decodes to zero stays zero. Else NaN for NaN, for infinities, and for frames so far
/// from unit that products overflow.
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
  const Float3 decoded{decode(encoded.x), decode(encoded.y), decode(encoded.z)};
  const Float3 leaning =
      normalize(fma(t, Float3(decoded.x * scale_x),
                    fma(bitangent, Float3(decoded.y * scale_y), n * Float3(decoded.z))));
  const Bool flat = (decoded.x == 0.0f) & (decoded.y == 0.0f) & (decoded.z > 0.0f);
  const Bool empty = (encoded.x == 0.0f) & (encoded.y == 0.0f) & (encoded.z == 0.0f);
  call.set(select(empty, n, select(flat, unit(call.recorder(), n), leaning)));
}

}  // namespace nacre
