#pragma once

#include <memory>
#include <span>
#include <vector>

namespace nacre::host {

/// Compresses pieces of a stream of raw deflate by libdeflate, which takes half of zlib's time but
/// knows whole streams only: a stream that is one block becomes a piece once that block is not the
/// last any more, and an empty one fills the byte that it ends in (RFC 1951, 3.2.3, 3.2.4).
class DeflateBlocks {
 public:
  /// So many bytes at its quickest level are one block.
  static constexpr std::size_t block_bytes = 32 << 10;

  DeflateBlocks();
  ~DeflateBlocks();
  DeflateBlocks(const DeflateBlocks&) = delete;
  DeflateBlocks& operator=(const DeflateBlocks&) = delete;

  /// Adds to `stream` what bytes become, which refers to nothing before it and
  /// ends at a byte; `is_last`: the stream ends with it. False, and nothing added, where libdeflate
  /// has made more blocks of it.
  bool add(std::span<const unsigned char> bytes, bool is_last, std::vector<unsigned char>& stream);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre::host
