#include "examples/render/image_io.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "examples/common/atomic_file.h"
#include "examples/common/checked_file.h"
#include "examples/common/srgb.h"

namespace nacre::host {

namespace {

std::uint8_t byte_of(float v) { return static_cast<std::uint8_t>(255.f * v + 0.5f); }

/// Linear radiance as a screen shows it, 0 to 1.
Vec3 toned(Vec3 pixel, const WriteOptions& options) {
  Vec3 rgb = is_finite(pixel) ? std::exp2(options.exposure) * pixel : Vec3{};
  const float l = luminance(rgb);
  if (options.white > 0.f && l > 0.f) {
    rgb = ((1.f + l / (options.white * options.white)) / (1.f + l)) * rgb;
  }
  return {srgb_encode(rgb.x), srgb_encode(rgb.y), srgb_encode(rgb.z)};
}

std::vector<std::uint8_t> developed(const Film& film, const WriteOptions& options) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(film.pixels().size() * (film.has_alpha() ? 4 : 3));
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const float alpha = film.alpha(x, y);
      const Vec3 rgb = toned(alpha > 0.f ? (1.f / alpha) * film.mean(x, y) : Vec3{}, options);
      for (const float v : {rgb.x, rgb.y, rgb.z}) bytes.push_back(byte_of(v));
      if (film.has_alpha()) bytes.push_back(byte_of(alpha));
    }
  }
  return bytes;
}

/// The linear channels, side by side.
std::vector<float> interleaved(const Film& film) {
  std::vector<float> values;
  values.reserve(film.pixels().size() * (film.has_alpha() ? 4 : 3));
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const Vec3 rgb = film.mean(x, y);
      values.insert(values.end(), {rgb.x, rgb.y, rgb.z});
      if (film.has_alpha()) values.push_back(film.alpha(x, y));
    }
  }
  return values;
}

/// Empty when written; otherwise why not.
std::string write_file(const Film& film, const std::string& path, bool exr,
                       const WriteOptions& options) {
  CheckedFile written(path);
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(exr ? "openexr" : "png");
  if (!out) return failure(OIIO::geterror());
  out->set_ioproxy(&written);
  const OIIO::TypeDesc type =
      !exr ? OIIO::TypeDesc::UINT8 : (options.half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  OIIO::ImageSpec spec(film.width(), film.height(), film.has_alpha() ? 4 : 3, type);
  spec.attribute("oiio:ColorSpace", exr ? "Linear" : "sRGB");
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // Else the writer notes the time.
  if (!exr) spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!out->open(path, spec)) return failure(out->geterror());
  const bool ok = exr ? out->write_image(OIIO::TypeDesc::FLOAT, interleaved(film).data())
                      : out->write_image(OIIO::TypeDesc::UINT8, developed(film, options).data());
  if (!ok || !out->close()) return failure(out->geterror());
  return written.finish();
}

}  // namespace

bool is_image_name(const std::string& path, Diagnostics& diagnostics) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".exr" || extension == ".png") return true;
  diagnostics.error("unknown-image-format", {path, 0, 0, {}}, "cannot write this kind of image",
                    "a name ending in .exr or .png", "\"" + extension + "\"");
  return false;
}

bool write_image(const Film& film, const std::string& path, const WriteOptions& options,
                 Diagnostics& diagnostics) {
  if (!is_image_name(path, diagnostics)) return false;
  const std::string extension = std::filesystem::path(path).extension().string();
  return write_atomically(
      path,
      [&](const std::string& file) { return write_file(film, file, extension == ".exr", options); },
      diagnostics);
}

}  // namespace nacre::host
