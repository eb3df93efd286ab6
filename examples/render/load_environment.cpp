#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "examples/render/environment.h"
#include "runtime/texture/image_io.h"

namespace nacre::host {

std::optional<Environment> Environment::load(const std::string& path, float scale, float rotation,
                                             const ImageLimits& limits, Diagnostics& diagnostics,
                                             const Stop& stop, Drawn drawn) {
  ImageReader reader;
  if (auto problem = reader.open(path, {}, limits, stop)) {
    diagnostics.add(std::move(*problem));
    return {};
  }
  const ImageInfo info = reader.info();
  const auto width = static_cast<std::size_t>(info.width);
  const auto channels = static_cast<std::size_t>(info.channels);
  std::size_t unusable = 0;
  try {
    std::vector<Vec3> texels;
    texels.reserve(width * static_cast<std::size_t>(info.height));
    auto problem = reader.read([&](int, const float* row) {
      for (std::size_t x = 0; x < width; ++x, row += channels) {
        const Vec3 rgb =
            channels >= 3 ? Vec3{row[0], row[1], row[2]} : Vec3{row[0], row[0], row[0]};
        texels.push_back(scale * rgb);
        const auto is_light = [](float v) { return std::isfinite(v) && v >= 0.f; };
        if (!is_light(rgb.x) || !is_light(rgb.y) || !is_light(rgb.z)) ++unusable;
      }
    });
    if (problem) {
      diagnostics.add(std::move(*problem));
      return {};
    }
    if (unusable != 0) {
      diagnostics.warning("bad-radiance", {path, 0, 0, {}},
                          "what is negative or not finite in the environment counts as 0",
                          "radiance", fmt::format("{} such texels", unusable));
    }
    return Environment(info.width, info.height, texels, rotation, drawn);
  } catch (const std::bad_alloc&) {
    diagnostics.error("out-of-memory", {path, 0, 0, {}}, "the environment does not fit in memory");
    return {};
  }
}

}  // namespace nacre::host
