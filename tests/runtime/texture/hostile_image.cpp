#include "tests/runtime/texture/hostile_image.h"

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

/// The bits that say that there is a colour table, and how large it is.
char table_flags(const std::string& table) {
  if (table.empty()) return 0;
  int bits = 1;
  while ((std::size_t{3} << bits) < table.size()) ++bits;
  return static_cast<char>(0x80 | (bits - 1));
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

std::string png_chunk(const std::string& type, const std::string& data) {
  std::string bytes;
  put_big(bytes, static_cast<std::uint32_t>(data.size()));
  bytes += type + data;
  put_big(bytes, crc(type + data));
  return bytes;
}

std::string png_start(const PngFields& fields) {
  std::string header;
  put_big(header, fields.width);
  put_big(header, fields.height);
  for (const int each :
       {fields.depth, fields.color_type, fields.compression, fields.filter, fields.interlacing}) {
    header += static_cast<char>(each);
  }
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header);
}

std::string zlib_stored(const std::string& bytes) {
  std::string stream("\x78\x01");
  for (std::size_t at = 0; at == 0 || at < bytes.size(); at += 65535) {
    const std::string block = bytes.substr(at, 65535);
    stream += at + 65535 >= bytes.size() ? '\1' : '\0';
    put(stream, static_cast<std::uint32_t>(block.size()), 2);
    put(stream, ~static_cast<std::uint32_t>(block.size()), 2);
    stream += block;
  }
  // Adler-32, RFC 1950.
  std::uint32_t low = 1, high = 0;
  for (const char byte : bytes) {
    low = (low + static_cast<unsigned char>(byte)) % 65521;
    high = (high + low) % 65521;
  }
  put_big(stream, high << 16 | low);
  return stream;
}

std::string png_of_noise(std::uint32_t width, std::uint32_t height, std::size_t packed) {
  std::string noise;
  for (std::size_t i = 0; i < packed; ++i) noise += static_cast<char>(i * i >> 3);
  return png_start({.width = width, .height = height}) + png_chunk("IDAT", noise) +
         png_chunk("IEND", "");
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

std::string bmp(const BmpFields& fields, const std::string& pixels, const std::string& palette) {
  std::string header;
  put(header, fields.header_size, 4);
  if (fields.header_size == 12) {
    put(header, static_cast<std::uint32_t>(fields.width), 2);
    put(header, static_cast<std::uint32_t>(fields.height), 2);
    put(header, 1, 2);
    put(header, fields.bits, 2);
  } else {
    put(header, static_cast<std::uint32_t>(fields.width), 4);
    put(header, static_cast<std::uint32_t>(fields.height), 4);
    put(header, 1, 2);
    put(header, fields.bits, 2);
    put(header, fields.packing, 4);
    for (int i = 0; i < 3; ++i) put(header, 0, 4);
    put(header, fields.colors, 4);
    put(header, 0, 4);
    for (const std::uint32_t mask : fields.masks) put(header, mask, 4);
    if (header.size() < fields.header_size) header.resize(fields.header_size, '\x01');
  }
  header += palette;
  std::string file("BM");
  put(file, 0, 4);
  put(file, 0, 4);
  const auto end = static_cast<std::uint32_t>(14 + header.size());
  put(file, fields.pixels_at == 0 ? end : fields.pixels_at, 4);
  return file + header + pixels;
}

std::string gif_start(int width, int height, const std::string& table) {
  std::string start("GIF89a");
  put(start, static_cast<std::uint32_t>(width), 2);
  put(start, static_cast<std::uint32_t>(height), 2);
  start += table_flags(table);
  start.append(2, '\0');
  return start + table;
}

std::string gif_frame(const GifFrame& frame, const std::string& pixels) {
  std::string result(",");
  for (const int each : {frame.left, frame.top, frame.width, frame.height}) {
    put(result, static_cast<std::uint32_t>(each), 2);
  }
  result += static_cast<char>(table_flags(frame.table) | (frame.is_interlaced ? 0x40 : 0));
  result += frame.table;
  result += static_cast<char>(frame.code_size);
  // The table of codes is cleared before each, so that it does not grow.
  std::string codes;
  std::uint32_t bits = 0;
  int count = 0;
  const auto put = [&](std::uint32_t code) {
    bits |= code << count;
    for (count += frame.code_size + 1; count >= 8; count -= 8, bits >>= 8) {
      codes += static_cast<char>(bits & 0xffu);
    }
  };
  for (const char pixel : pixels) {
    put(1u << frame.code_size);
    put(static_cast<unsigned char>(pixel));
  }
  put((1u << frame.code_size) + 1);
  if (count > 0) codes += static_cast<char>(bits);
  for (std::size_t at = 0; at < codes.size(); at += 255) {
    const std::string block = codes.substr(at, 255);
    result += static_cast<char>(block.size());
    result += block;
  }
  result += '\0';
  return result;
}

std::string gif_transparency(int color) {
  return std::string("\x21\xf9\x04\x01\0\0", 6) + static_cast<char>(color) + '\0';
}

}  // namespace nacre
