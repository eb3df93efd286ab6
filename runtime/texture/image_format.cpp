#include "runtime/texture/image_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

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
    Signature{"GIF8"sv, ImageFormat::gif},
    Signature{"BM"sv, ImageFormat::bmp},
};

bool has_extension(std::string_view path, std::string_view extension) {
  if (path.size() < extension.size()) return false;
  return std::equal(extension.begin(), extension.end(), path.end() - extension.size(),
                    [](char a, char b) {
                      return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
                    });
}

}  // namespace

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

std::optional<ImageFormat> recognise_image(std::span<const unsigned char> first_bytes,
                                           std::string_view path) {
  for (const Signature& signature : signatures) {
    if (first_bytes.size() < signature.bytes.size()) continue;
    if (std::equal(signature.bytes.begin(), signature.bytes.end(), first_bytes.begin(),
                   [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; })) {
      return signature.format;
    }
  }
  if (has_extension(path, ".tga") || has_extension(path, ".tpic")) return ImageFormat::tga;
  return std::nullopt;
}

std::optional<ImageFormat> probe_image(const std::string& path, Diagnostic& error) {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) {
    error = image_error("missing-image", path, "the image does not exist");
    return std::nullopt;
  }
  if (!fs::is_regular_file(status)) {  // Opening a pipe would wait for ever.
    error = image_error("unreadable-image", path, "the image is not a regular file");
    return std::nullopt;
  }
  std::ifstream file(path, std::ios::binary);
  std::array<char, 16> bytes{};
  file.read(bytes.data(), bytes.size());
  const auto count = static_cast<std::size_t>(file.gcount());
  if (file.bad() || count == 0) {
    error = image_error("unreadable-image", path,
                        file.is_open() ? "the image is empty" : "the image cannot be opened");
    return std::nullopt;
  }
  std::array<unsigned char, 16> first{};
  std::copy(bytes.begin(), bytes.end(), first.begin());
  const auto format = recognise_image(std::span(first).first(count), path);
  if (!format) {
    error = image_error("unsupported-image", path, "the image is of no supported format",
                        "exr, png, jpeg, tiff, tx, hdr, tga, bmp or gif",
                        fmt::format("a file beginning with bytes {:02x} {:02x} {:02x} {:02x}",
                                    first[0], first[1], first[2], first[3]));
  }
  return format;
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

}  // namespace nacre
