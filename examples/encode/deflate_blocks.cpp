#include "examples/encode/deflate_blocks.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <new>

namespace nacre::host {

namespace {

/// An empty block of stored bytes behind the three bits of its head: its length, and that again
/// with all bits changed.
constexpr std::array<unsigned char, 4> empty_block{0, 0, 0xff, 0xff};
/// The same with its head, and the last.
constexpr std::array<unsigned char, 5> last_block{1, 0, 0, 0xff, 0xff};

struct Free {
  void operator()(libdeflate_compressor* it) const { libdeflate_free_compressor(it); }
  void operator()(libdeflate_decompressor* it) const { libdeflate_free_decompressor(it); }
};

}  // namespace

struct DeflateBlocks::State {
  std::unique_ptr<libdeflate_compressor, Free> compressor{libdeflate_alloc_compressor(1)};
  std::unique_ptr<libdeflate_decompressor, Free> decompressor{libdeflate_alloc_decompressor()};
  std::vector<unsigned char> out, back;
};

DeflateBlocks::DeflateBlocks() : state_(std::make_unique<State>()) {
  if (!state_->compressor || !state_->decompressor) throw std::bad_alloc();
}

DeflateBlocks::~DeflateBlocks() = default;

bool DeflateBlocks::add(std::span<const unsigned char> bytes, bool is_last,
                        std::vector<unsigned char>& stream) {
  std::vector<unsigned char>& out = state_->out;
  libdeflate_compressor* const compressor = state_->compressor.get();
  out.resize(libdeflate_deflate_compress_bound(compressor, bytes.size()));
  std::size_t size =
      libdeflate_deflate_compress(compressor, bytes.data(), bytes.size(), out.data(), out.size());
  const bool is_one_block = size > 0 && (out[0] & 1) != 0;  // The first is the last.
  if (!is_one_block) return false;
  if (is_last) {
    stream.insert(stream.end(), out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size));
    return true;
  }
  out[0] &= 0xfe;
  // How many bits of the last byte are left is not said: the head of the empty block, which is
  // three zeros, is in them or goes on in a byte more. With the wrong one nothing can be unpacked,
  // for the lengths do not match.
  state_->back.resize(bytes.size());
  for (std::size_t more = 0; more <= 1; ++more) {
    out.resize(size);
    out.resize(size + more, 0);
    out.insert(out.end(), empty_block.begin(), empty_block.end());
    const std::size_t piece = out.size();
    out.insert(out.end(), last_block.begin(), last_block.end());
    const bool is_right =
        libdeflate_deflate_decompress(state_->decompressor.get(), out.data(), out.size(),
                                      state_->back.data(), state_->back.size(),
                                      nullptr) == LIBDEFLATE_SUCCESS &&
        std::ranges::equal(state_->back, bytes);
    if (!is_right) continue;
    stream.insert(stream.end(), out.begin(), out.begin() + static_cast<std::ptrdiff_t>(piece));
    return true;
  }
  return false;
}

}  // namespace nacre::host
