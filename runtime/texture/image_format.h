#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/diagnostic.h"

namespace nacre {

/// The readers we let image files reach: what textures and environments come in.
/// OpenImageIO has about thirty; each is an attack surface, and left to itself it tries
/// all of them on an unknown file.
enum class ImageFormat { exr, png, jpeg, tiff, hdr, tga, bmp, gif };

/// How much of a file is looked at.
enum class ImageExtent {
  header,  ///< What says of which size and type the pixels are. They may be damaged or missing.
  whole
};

/// OpenImageIO's name of the reader.
std::string_view reader_name(ImageFormat format);

/// How many bytes recognise_image looks at.
inline constexpr std::size_t image_signature_bytes = 18;

/// Decides by the first bytes, never by the name: a JPEG called .png reads, and a text
/// called .png is refused. TGA, which has no signature, is a header that makes sense for
/// one (Truevision TGA 2.0, true colour or grey, without palette); BMP, whose signature is
/// two letters, needs a header of a known size behind them. `.tx` is TIFF.
std::optional<ImageFormat> recognise_image(std::span<const unsigned char> first_bytes);

/// Headers of BMP are told by their sizes: OS/2's, Windows' third, fourth and fifth version,
/// and two between that Adobe's programs write.
bool is_bmp_header_size(std::uint32_t bytes);

/// An error about an image file, as every function of this folder reports it.
Diagnostic image_error(std::string code, const std::string& path, std::string message,
                       std::string expected = {}, std::string found = {});

/// The image is damaged, and what its reader says of it, on one line.
Diagnostic broken_image(const std::string& path, std::string reason);

}  // namespace nacre
