#include "nodes/texture2d/image_file.h"

namespace nacre {

/// image: a file looked up at `texcoord`. MaterialX 1.39 Standard Nodes, "Texture Nodes";
/// runtime/texture/sampling.h says what the filters and address modes mean. Channels that
/// the file lacks are zero, so a one-channel file on a color3 output is (r, 0, 0); the
/// alpha it lacks is one. Which file of a sequence is read (`framerange`, `frameoffset`,
/// `frameendaction`) is settled in the graph already: jit/graph/resolve/filename.h.
void record_image(NodeCall& call) {
  const TextureModes modes{.filter = parse_filter(call, "filtertype"),
                           .u = parse_address_mode(call, "uaddressmode"),
                           .v = parse_address_mode(call, "vaddressmode")};
  const ImageLookup lookup{.uv = call.vector2("texcoord"),
                           .modes = modes,
                           .channels = component_count(call.out_type()),
                           .otherwise = widened(call.in("default"))};
  set_components(call, sample_images(call.recorder(), find_image(call), lookup));
}

}  // namespace nacre
