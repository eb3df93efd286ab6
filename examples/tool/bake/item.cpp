#include "examples/tool/bake/item.h"

#include <fmt/format.h>

namespace nacre::tool {

Facts settings_of(const std::string& output, const TextureSettings& texture,
                  const host::BakeSettings& settings, const UdimTile& tile) {
  const host::TextureEncoding& encoding = texture.encoding;
  Facts facts;
  facts["output"] = output;
  facts["size"] = fmt::format("{}x{}", texture.width, texture.height);
  facts["format"] = texture.extension.substr(1);
  facts["bitdepth"] = fmt::format("{}", encoding.bits);
  facts["colorspace"] = encoding.colorspace;
  facts["vectors"] = encoding.is_direction      ? "direction"
                     : encoding.encodes_vectors ? "encoded"
                                                : "raw";
  if (encoding.channels > 0) {
    facts["channels"] = fmt::format("{} from {}", encoding.channels, encoding.first_channel);
  }
  if (const auto& window = settings.window) {
    facts["window"] =
        fmt::format("{} {}, {} x {}", window->u, window->v, window->width, window->height);
  }
  facts["udim"] = encoding.is_tile ? tile.number() : "none";
  facts["samples"] = settings.sampling.count == 0
                         ? fmt::format("auto, error {}", settings.sampling.error)
                         : fmt::format("{}", settings.sampling.count);
  facts["frame"] = fmt::format("{}", settings.frame);
  facts["time"] = fmt::format("{}", settings.time);
  return facts;
}

}  // namespace nacre::tool
