#include "runtime/texture/png_chunks.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace nacre {

namespace {

constexpr std::size_t signature_size = 8;
constexpr std::size_t frame_size = 12;  // Length, type and checksum around the data.
constexpr std::array<std::string_view, 5> needed{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};

/// ISO 3309 CRC-32, reflected; PNG Specification, annex D.
constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1u) ? 0xedb88320u ^ c >> 1 : c >> 1;
    table[n] = c;
  }
  return table;
}

std::uint32_t crc(std::string_view bytes) {
  static constexpr auto table = make_crc_table();
  std::uint32_t c = 0xffffffffu;
  for (const char byte : bytes) c = table[(c ^ static_cast<unsigned char>(byte)) & 0xffu] ^ c >> 8;
  return ~c;
}

/// Four bytes, the most significant first.
std::uint32_t number(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace

std::optional<std::string> essential_png(std::string_view file, std::string& reason) {
  if (file.size() < signature_size) {
    reason = "the file ends inside its signature";
    return std::nullopt;
  }
  std::string result(file.substr(0, signature_size));
  std::string_view rest = file.substr(signature_size);
  for (;;) {
    if (rest.size() < frame_size || rest.size() - frame_size < number(rest)) {
      reason = "the file ends inside a chunk";
      return std::nullopt;
    }
    const std::size_t length = number(rest);
    const std::string_view type = rest.substr(4, 4);
    const bool first = result.size() == signature_size;
    if (first != (type == "IHDR")) {
      reason = "the first chunk, and no other, must be IHDR";
      return std::nullopt;
    }
    const std::uint32_t expected = number(rest.substr(8 + length));
    if (crc(rest.substr(4, 4 + length)) != expected) {
      reason = "a chunk has the wrong checksum";
      return std::nullopt;
    }
    const std::string_view chunk = rest.substr(0, frame_size + length);
    if (std::find(needed.begin(), needed.end(), type) != needed.end()) result += chunk;
    if (type == "IEND") return result;
    rest.remove_prefix(chunk.size());
  }
}

}  // namespace nacre
