#include "nodes/texture2d/hextile.h"
#include "nodes/texture2d/image_file.h"

namespace nacre {

namespace {

/// v turned about unit n, counter-clockwise seen from its tip (Rodrigues).
Float3 turn(Float3 v, Float3 n, SinCos angle) {
  const Float along = dot(n, v) * (1.0f - angle.cos);
  return fma(v, Float3(angle.cos), fma(cross(n, v), Float3(angle.sin), n * Float3(along)));
}

/// Surface gradient of a unit normal m over unit n: Mikkelsen, "Surface Gradient-Based
/// Bump Mapping Framework", JCGT 9(3), 2020.
Float3 gradient(Float3 n, Float3 m) {
  const Float d = dot(n, m);
  return (Float3(d) * n - m) / Float3(max(abs(d), 1e-8f));
}

struct Frame {
  Float3 normal, tangent, bitangent;
};

/// The normal that a texel encodes, in a copy's turned tangent frame.
Float3 decode(Float4 texel, const Frame& frame, SinCos rotation, Float strength, Bool flip) {
  const Float green = select(flip, 1.0f - texel.y, texel.y);
  const Float3 t = turn(frame.tangent, frame.normal, rotation);
  const Float3 b = turn(frame.bitangent, frame.normal, rotation);
  const Float x = fma(texel.x, 2.0f, -1.0f) * strength;
  const Float y = fma(green, 2.0f, -1.0f) * strength;
  const Float z = fma(texel.z, 2.0f, -1.0f);
  return normalize(t * Float3(x) + b * Float3(y) + frame.normal * Float3(z));
}

}  // namespace

/// hextilednormalmap: three copies of a periodic normal map, each in its own turned frame,
/// blended by their surface gradients; see nodes/texture2d/hextile.h. `default` is an
/// encoded normal, like a texel. The normal is in the space of the frame. MaterialX 1.39.5
/// data library. Slopes end at 1e8, so normals that decode to the horizon have a
/// value. NaN for coordinates, `default`, rotation or strength that are infinite or
/// NaN, and for a frame far from unit (1e8) whose products overflow.
void record_hextilednormalmap(NodeCall& call) {
  const TextureSources sources = find_image(call);
  const std::array<Hexagon, 3> hexagons = find_hexagons(call);
  const Frame frame{call.vector3("normal"), call.vector3("tangent"), call.vector3("bitangent")};
  const Float3 w = blend_weights(hexagons, Float3(1.0f), call.number("falloff"));
  const std::array<Float, 3> weights{w.x, w.y, w.z};
  ImageLookup lookup{.channels = 3, .otherwise = widened(call.in("default"))};
  Float3 sum(0.0f);
  for (std::size_t k = 0; k < 3; ++k) {
    lookup.uv = hexagons[k].texcoord;
    const Float3 decoded =
        decode(sample_images(call.recorder(), sources, lookup), frame, hexagons[k].rotation,
               call.number("strength"), call.boolean("flip_g"));
    sum += gradient(frame.normal, decoded) * Float3(saturate(weights[k]));
  }
  call.set(normalize(frame.normal - sum));
}

}  // namespace nacre
