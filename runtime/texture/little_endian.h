#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace nacre {

// Numbers in files that have their lowest byte first.

constexpr std::uint32_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

constexpr std::uint32_t two_bytes_at(std::string_view bytes, std::size_t at) {
  return byte_at(bytes, at) | byte_at(bytes, at + 1) << 8;
}

constexpr std::uint32_t four_bytes_at(std::string_view bytes, std::size_t at) {
  return two_bytes_at(bytes, at) | two_bytes_at(bytes, at + 2) << 16;
}

inline void append_two_bytes(std::string& bytes, std::uint32_t value) {
  bytes += static_cast<char>(value & 0xffu);
  bytes += static_cast<char>(value >> 8 & 0xffu);
}

inline void append_four_bytes(std::string& bytes, std::uint32_t value) {
  append_two_bytes(bytes, value & 0xffffu);
  append_two_bytes(bytes, value >> 16);
}

}  // namespace nacre
