#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace nacre::fuzz {

/// Reads decisions from the fuzzer's bytes; zeros when they run out.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> data) : data_(data) {}

  std::uint32_t byte() { return at_ < data_.size() ? data_[at_++] : 0; }
  /// 0 ... limit - 1; limit up to 65536.
  std::uint32_t below(std::uint32_t limit) {
    const std::uint32_t word = limit > 256 ? byte() << 8 | byte() : byte();
    return limit == 0 ? 0 : word % limit;
  }
  bool flip() { return (byte() & 1) != 0; }

 private:
  std::span<const std::uint8_t> data_;
  std::size_t at_ = 0;
};

struct RandomDocument {
  std::string text;
  bool valid = true;  ///< No fault was put in: it must build.
};

/// A document of a node graph and a material, whose nodes are picked from the
/// data library and connected by type, as the bytes say. In half of them
/// attributes are then made wrong: names, types, values, connections.
RandomDocument random_document(Bytes bytes);

}  // namespace nacre::fuzz
