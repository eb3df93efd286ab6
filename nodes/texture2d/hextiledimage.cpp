#include "nodes/texture2d/hextile.h"
#include "nodes/texture2d/image_file.h"

namespace nacre {

/// hextiledimage: three copies of a periodic image blended; see hextile.h. Their colours
/// count by luminance as `falloffcontrast` says, which keeps contrast; alpha does not.
/// Footprints follow from the derivatives of the copies' coordinates. MaterialX 1.39.5
/// data library (the specification's text gives `rotation` another default).
void record_hextiledimage(NodeCall& call) {
  const TextureSources sources = find_image(call);
  if (is_missing(sources)) return set_components(call, widened(call.in("default")));
  const std::array<Hexagon, 3> hexagons = find_hexagons(call);
  ImageLookup lookup{.channels = component_count(call.out_type()),
                     .otherwise = widened(call.in("default"))};
  std::array<Float4, 3> c;
  for (std::size_t k = 0; k < 3; ++k) {
    lookup.uv = hexagons[k].texcoord;
    c[k] = sample_images(call.recorder(), sources, lookup);
  }
  const Float falloff = call.number("falloff");
  const Float contrast = call.number("falloffcontrast");
  const Float3 coefficients = call.vector3("lumacoeffs");
  const auto emphasis = [&](const Float4& texel) {
    const Float luminance = dot(Float3(texel.x, texel.y, texel.z), coefficients);
    return fma(contrast, luminance - 1.0f, 1.0f);
  };
  const Float3 w =
      blend_weights(hexagons, {emphasis(c[0]), emphasis(c[1]), emphasis(c[2])}, falloff);
  const auto blend = [](Float3 weights, Float x, Float y, Float z) {
    return dot(weights, Float3(x, y, z));
  };
  const Float3 alpha_weights = blend_weights(hexagons, Float3(1.0f), falloff);
  set_components(call,
                 {blend(w, c[0].x, c[1].x, c[2].x), blend(w, c[0].y, c[1].y, c[2].y),
                  blend(w, c[0].z, c[1].z, c[2].z), blend(alpha_weights, c[0].w, c[1].w, c[2].w)});
}

}  // namespace nacre
