#include "examples/encode/exr_block.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>
#include <span>

namespace nacre::host {

namespace {

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
  }
};

using Compressor = std::unique_ptr<libdeflate_compressor, FreeCompressor>;

/// The quickest level: noise does not get smaller by trying harder.
Compressor new_compressor() {
  Compressor compressor(libdeflate_alloc_compressor(1));
  if (compressor == nullptr) throw std::bad_alloc();
  return compressor;
}

/// What `bytes` become, nothing if more than `most`.
std::vector<unsigned char> compressed(libdeflate_compressor* compressor,
                                      std::span<const unsigned char> bytes, std::size_t most) {
  std::vector<unsigned char> out(most);
  out.resize(
      libdeflate_zlib_compress(compressor, bytes.data(), bytes.size(), out.data(), out.size()));
  return out;
}

std::size_t worth_it(std::size_t size) { return size - size / 8; }

/// Tries one part in eight, from all over the block.
bool is_worth_trying(libdeflate_compressor* compressor, std::span<const unsigned char> bytes) {
  constexpr std::size_t piece = 1024;
  constexpr std::size_t every = 8;
  std::vector<unsigned char> some;
  for (std::size_t at = 0; at + piece <= bytes.size(); at += every * piece) {
    some.insert(some.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                bytes.begin() + static_cast<std::ptrdiff_t>(at + piece));
  }
  return some.size() < every * piece ||
         !compressed(compressor, some, worth_it(some.size())).empty();
}

}  // namespace

std::vector<unsigned char> compress_exr_block(std::vector<unsigned char> bytes) {
  const std::size_t size = bytes.size();
  std::vector<unsigned char> parted(size);
  unsigned char* even = parted.data();
  unsigned char* odd = parted.data() + (size + 1) / 2;
  for (std::size_t i = 0; i + 1 < size; i += 2) {
    *even++ = bytes[i];
    *odd++ = bytes[i + 1];
  }
  if (size % 2 != 0) *even = bytes[size - 1];
  for (std::size_t i = size; i-- > 1;) {
    parted[i] = static_cast<unsigned char>(parted[i] - parted[i - 1] + 128);
  }
  const Compressor compressor = new_compressor();
  if (!is_worth_trying(compressor.get(), parted)) return bytes;
  std::vector<unsigned char> small = compressed(compressor.get(), parted, worth_it(size));
  return small.empty() ? bytes : small;
}

}  // namespace nacre::host
