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

OIIO::TypeDesc format_of(const Request& request) {
  return request.is_half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

OIIO::ImageSpec dimensions_of(const GraphInfo& info, const Request& request, const Level& level) {
  OIIO::ImageSpec spec(level.width, level.height, info.components, format_of(request));
  spec.tile_width = spec.tile_height = tile_side;
  return spec;
}

OIIO::ImageSpec spec_of(const GraphInfo& info, const Request& request, const Level& level) {
  OIIO::ImageSpec spec = dimensions_of(info, request, level);
  spec.channelnames = channel_names(info.components);
  spec.alpha_channel = info.type == "color4" ? 3 : -1;
  // As the document means it: nothing is multiplied by it.
  if (spec.alpha_channel >= 0) spec.attribute("oiio:UnassociatedAlpha", 1);
  const bool is_color = info.type == "color3" || info.type == "color4";
  if (is_color) spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("textureformat", "Plain Texture");
  spec.attribute("wrapmodes", request.wrap + "," + request.wrap);
  spec.attribute("mtlx:output", info.output);
  spec.attribute("mtlx:type", info.type);
  if (!info.warnings.empty()) spec.attribute("mtlx:warnings", info.warnings);
  return spec;
}

}  // namespace graph_image
