#include "examples/image_writer/copy_levels.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "examples/image_writer/spec.h"

namespace nacre::host {

namespace {

/// Writes one level of an open texture, tile by tile, with zeros in what lies outside the
/// image at its edges.
bool copy_tiles(OIIO::ImageInput& in, OIIO::ImageOutput& out, int level) {
  const OIIO::ImageSpec spec = in.spec();
  const std::size_t texel = spec.pixel_bytes();
  const auto row = static_cast<std::size_t>(spec.tile_width) * texel;
  std::vector<char> tile(row * static_cast<std::size_t>(spec.tile_height));
  for (int y = 0; y < spec.height; y += spec.tile_height) {
    for (int x = 0; x < spec.width; x += spec.tile_width) {
      if (!in.read_tiles(0, level, x, std::min(x + spec.tile_width, spec.width), y,
                         std::min(y + spec.tile_height, spec.height), 0, 1, 0, spec.nchannels,
                         spec.format, tile.data(), static_cast<OIIO::stride_t>(texel),
                         static_cast<OIIO::stride_t>(row))) {
        return false;
      }
      if (!out.write_tile(x, y, 0, spec.format, tile.data())) return false;
      std::fill(tile.begin(), tile.end(), '\0');
    }
  }
  return true;
}

}  // namespace

std::string copy_levels(const std::string& from, const std::string& to) {
  OIIO::ImageSpec as_it_is;
  as_it_is.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::open(from, &as_it_is);
  const auto out = OIIO::ImageOutput::create("tiff");
  if (!in || !out) return failure(OIIO::geterror());
  for (int level = 0; in->seek_subimage(0, level); ++level) {
    OIIO::ImageSpec spec = in->spec();
    spec.attribute("DateTime", "");
    spec.attribute("tiff:half", 1);
    std::string known;
    for (const char* name : {"oiio:ConstantColor", "oiio:AverageColor", "oiio:SHA-1"}) {
      const std::string value(spec.get_string_attribute(name));
      if (!value.empty()) known += fmt::format("{}{}={}", known.empty() ? "" : " ", name, value);
    }
    if (!known.empty()) spec.attribute("ImageDescription", known);
    // Levels are pages to TIFF.
    const auto mode = level == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage;
    if (!out->open(to, spec, mode)) return failure(out->geterror());
    if (!copy_tiles(*in, *out, level)) {
      return failure(in->has_error() ? in->geterror() : out->geterror());
    }
  }
  in->geterror();  // Of the level that there is none of.
  return out->close() ? std::string() : failure(out->geterror());
}

}  // namespace nacre::host
