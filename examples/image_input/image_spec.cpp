#include "examples/image_input/image_spec.h"

#include <string>
#include <vector>

namespace graph_image {

namespace {

std::vector<std::string> channel_names(int count) {
  if (count == 1) return {"Y"};
  std::vector<std::string> names{"R", "G", "B", "A"};
  if (count <= 4) {
    names.resize(static_cast<std::size_t>(count));
    return names;
  }
  names.clear();
  for (int i = 0; i < count; ++i) names.push_back("m" + std::to_string(i));
  return names;
}

}  // namespace

OIIO::ImageSpec spec_of(const ReadyOutput& ready, const Request& request, const Level& level) {
  const GraphOutput& output = *ready.output;
  OIIO::ImageSpec spec(level.width, level.height, output.components(), request.format);
  spec.tile_width = spec.tile_height = tile_side;
  spec.channelnames = channel_names(output.components());
  spec.alpha_channel = output.type() == "color4" ? 3 : -1;
  // As the document means it: nothing is multiplied by it.
  if (spec.alpha_channel >= 0) spec.attribute("oiio:UnassociatedAlpha", 1);
  const bool is_color = output.type() == "color3" || output.type() == "color4";
  if (is_color) spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("textureformat", "Plain Texture");
  spec.attribute("wrapmodes", request.wrap + "," + request.wrap);
  spec.attribute("mtlx:output", output.name());
  spec.attribute("mtlx:type", output.type());
  if (!ready.warnings.empty()) spec.attribute("mtlx:warnings", ready.warnings);
  return spec;
}

}  // namespace graph_image
