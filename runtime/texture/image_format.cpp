#include "runtime/texture/image_format.h"

#include <algorithm>
#include <array>

namespace nacre {

namespace {

struct Signature {
  std::string_view bytes;
  ImageFormat format;
};

using namespace std::string_view_literals;

constexpr std::array signatures{
    Signature{"\x76\x2f\x31\x01"sv, ImageFormat::exr},
    Signature{"\x89PNG\r\n\x1a\n"sv, ImageFormat::png},
    Signature{"\xff\xd8\xff"sv, ImageFormat::jpeg},
    Signature{"II*\0"sv, ImageFormat::tiff},
    Signature{"MM\0*"sv, ImageFormat::tiff},
    Signature{"II+\0"sv, ImageFormat::tiff},  // BigTIFF
    Signature{"MM\0+"sv, ImageFormat::tiff},
    Signature{"#?RADIANCE"sv, ImageFormat::hdr},
    Signature{"#?RGBE"sv, ImageFormat::hdr},
    Signature{"GIF87a"sv, ImageFormat::gif},
    Signature{"GIF89a"sv, ImageFormat::gif},
};

/// No palette, which would be five numbers more; true colour or grey, packed or not.
bool is_tga(std::span<const unsigned char> header) {
  if (header.size() < image_signature_bytes || header[1] != 0) return false;
  if (std::any_of(header.begin() + 3, header.begin() + 8, [](auto byte) { return byte != 0; })) {
    return false;
  }
  const int kind = header[2] & ~8;  // 8: packed.
  const int bits = header[16];
  const bool is_color =
      kind == 2 && header[2] <= 10 && (bits == 15 || bits == 16 || bits == 24 || bits == 32);
  const bool is_grey = kind == 3 && header[2] <= 11 && (bits == 8 || bits == 16);
  return (is_color || is_grey) && (header[17] & 0xc0) == 0;
}

/// The letters, four bytes that must be zero, and the size of the header that follows.
bool is_bmp(std::span<const unsigned char> header) {
  if (header.size() < image_signature_bytes || header[0] != 'B' || header[1] != 'M') return false;
  if (std::any_of(header.begin() + 6, header.begin() + 10, [](auto byte) { return byte != 0; })) {
    return false;
  }
  return header[15] == 0 && header[16] == 0 && header[17] == 0 && is_bmp_header_size(header[14]);
}

}  // namespace

bool is_bmp_header_size(std::uint32_t bytes) {
  constexpr std::array<std::uint32_t, 6> sizes{12, 40, 52, 56, 108, 124};
  return std::find(sizes.begin(), sizes.end(), bytes) != sizes.end();
}

std::string_view reader_name(ImageFormat format) {
  switch (format) {
    case ImageFormat::exr: return "openexr";
    case ImageFormat::png: return "png";
    case ImageFormat::jpeg: return "jpeg";
    case ImageFormat::tiff: return "tiff";
    case ImageFormat::hdr: return "hdr";
    case ImageFormat::tga: return "targa";
    case ImageFormat::bmp: return "bmp";
    case ImageFormat::gif: return "gif";
  }
  return "";
}

std::optional<ImageFormat> recognise_image(std::span<const unsigned char> first_bytes) {
  for (const Signature& signature : signatures) {
    if (first_bytes.size() < signature.bytes.size()) continue;
    if (std::equal(signature.bytes.begin(), signature.bytes.end(), first_bytes.begin(),
                   [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; })) {
      return signature.format;
    }
  }
  if (is_bmp(first_bytes)) return ImageFormat::bmp;
  if (is_tga(first_bytes)) return ImageFormat::tga;
  return std::nullopt;
}

Diagnostic image_error(std::string code, const std::string& path, std::string message,
                       std::string expected, std::string found) {
  Diagnostic error;
  error.code = std::move(code);
  error.where.file = path;
  error.message = std::move(message);
  error.expected = std::move(expected);
  error.found = std::move(found);
  return error;
}

Diagnostic broken_image(const std::string& path, std::string reason) {
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  while (!reason.empty() && (reason.back() == ' ' || reason.back() == '.')) reason.pop_back();
  return image_error("broken-image", path, "the image cannot be read", {},
                     reason.empty() ? "no reason given by the reader" : std::move(reason));
}

}  // namespace nacre
