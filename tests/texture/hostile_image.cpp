#include "tests/texture/hostile_image.h"

#include <algorithm>
#include <map>

namespace nacre {

namespace {

void put(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i));
}

void put_big(std::string& bytes, std::uint32_t value) {
  for (int i = 4; i-- > 0;) bytes += static_cast<char>(value >> (8 * i));
}

/// ISO 3309 CRC-32, a bit at a time.
std::uint32_t crc(const std::string& bytes) {
  std::uint32_t c = 0xffffffffu;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) c = (c & 1u) != 0 ? 0xedb88320u ^ c >> 1 : c >> 1;
  }
  return ~c;
}

void put_chunk(std::string& bytes, const std::string& type, const std::string& data) {
  put_big(bytes, static_cast<std::uint32_t>(data.size()));
  bytes += type + data;
  put_big(bytes, crc(type + data));
}

}  // namespace

std::string tiff(std::uint32_t width, std::uint32_t height, const std::vector<TiffEntry>& more,
                 std::uint32_t next) {
  std::map<int, TiffEntry> entries;
  const std::uint32_t pixels = std::min(width * height, 1u << 16);
  for (const auto& [tag, value] : std::map<int, std::uint32_t>{{256, width},
                                                               {257, height},
                                                               {258, 8},
                                                               {259, 1},
                                                               {262, 1},
                                                               {273, 8},
                                                               {277, 1},
                                                               {278, height},
                                                               {279, pixels}}) {
    entries[tag] = {.tag = tag, .value = value};
  }
  std::string texts;
  const std::uint32_t directory = 8 + pixels;
  for (const TiffEntry& entry : more) entries[entry.tag] = entry;
  const auto after = static_cast<std::uint32_t>(directory + 2 + 12 * entries.size() + 4);
  std::string bytes = "II*";
  bytes += '\0';
  put(bytes, directory, 4);
  bytes.append(pixels, '\x55');
  put(bytes, static_cast<std::uint32_t>(entries.size()), 2);
  for (auto& [tag, entry] : entries) {
    if (!entry.text.empty()) {
      entry.count = static_cast<std::uint32_t>(entry.text.size());
      entry.value = after + static_cast<std::uint32_t>(texts.size());
      texts += entry.text;
    }
    put(bytes, static_cast<std::uint32_t>(tag), 2);
    put(bytes, static_cast<std::uint32_t>(entry.type), 2);
    put(bytes, entry.count, 4);
    put(bytes, entry.value, 4);
  }
  put(bytes, next, 4);
  return bytes + texts;
}

std::string png_of_noise(std::uint32_t width, std::uint32_t height, std::size_t packed) {
  std::string bytes = "\x89PNG\r\n\x1a\n", header, noise;
  put_big(header, width);
  put_big(header, height);
  header += std::string("\x08\0\0\0\0", 5);
  for (std::size_t i = 0; i < packed; ++i) noise += static_cast<char>(i * i >> 3);
  put_chunk(bytes, "IHDR", header);
  put_chunk(bytes, "IDAT", noise);
  put_chunk(bytes, "IEND", "");
  return bytes;
}

std::string tga_header(int width, int height, int kind, int bits) {
  std::string bytes(18, '\0');
  bytes[2] = static_cast<char>(kind);
  bytes[12] = static_cast<char>(width & 255);
  bytes[13] = static_cast<char>(width >> 8);
  bytes[14] = static_cast<char>(height & 255);
  bytes[15] = static_cast<char>(height >> 8);
  bytes[16] = static_cast<char>(bits);
  return bytes;
}

}  // namespace nacre
