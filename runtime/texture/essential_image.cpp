#include "runtime/texture/essential_image.h"

#include <fmt/format.h>

#include <algorithm>

namespace nacre {

namespace {

constexpr std::uint64_t always_taken = std::uint64_t{256} << 20;  // Bytes in memory.
constexpr std::uint64_t no_coder_packs = 8192;                    // Bytes into one.

}  // namespace

std::optional<Diagnostic> check_image_size(const std::string& path, std::int64_t width,
                                           std::int64_t height, const ImageLimits& limits) {
  if (width >= 1 && width <= limits.max_size && height >= 1 && height <= limits.max_size) {
    return std::nullopt;
  }
  return image_error("image-too-large", path, "the size of the image is outside the limits",
                     fmt::format("1 to {} on either side", limits.max_size),
                     fmt::format("{} x {}", width, height));
}

std::optional<Diagnostic> check_image_bytes(const ImageFile& file, const PixelBytes& bytes,
                                            const ImageLimits& limits) {
  if (bytes.decoded > limits.max_bytes) {
    return image_error("image-too-large", file.path(), "the image is too large",
                       fmt::format("at most {} bytes of pixels", limits.max_bytes),
                       fmt::format("{}", bytes.decoded));
  }
  if (bytes.kept / no_coder_packs > file.bytes()) {
    return broken_image(file.path(), "the header promises more than the file can hold");
  }
  if (bytes.in_memory > always_taken &&
      bytes.decoded / std::max<std::uint64_t>(1, limits.max_expansion) > file.bytes()) {
    return image_error(
        "image-too-large", file.path(), "a large image comes from a file that is too small for it",
        fmt::format("at most {} bytes of pixels for each byte of the file", limits.max_expansion),
        fmt::format("{}", bytes.decoded / file.bytes()));
  }
  return std::nullopt;
}

}  // namespace nacre
