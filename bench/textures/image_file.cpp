#include "bench/textures/image_file.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace nacre::bench {

std::string write_image() {
  OIIO::ImageBuf image(OIIO::ImageSpec(image_size, image_size, 4, OIIO::TypeDesc::UINT8));
  for (OIIO::ImageBuf::Iterator<unsigned char> texel(image); !texel.done(); ++texel) {
    for (int c = 0; c < 4; ++c) {
      // Whole periods, so that it tiles.
      const double wave = 2.0 * std::numbers::pi / image_size;
      const double across = std::sin(wave * texel.x() * (3 + c) + c);
      const double up = std::cos(wave * texel.y() * (5 - c));
      texel[c] = static_cast<float>(0.5 + 0.24 * (across + up));
    }
  }
  OIIO::ImageSpec settings;
  settings.attribute("maketx:filtername", "box");
  const auto path =
      std::filesystem::temp_directory_path() / ("nacre-bench-" + std::to_string(getpid()) + ".tx");
  const bool made = OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image,
                                                     path.string(), settings);
  return made ? path.string() : std::string();
}

}  // namespace nacre::bench
