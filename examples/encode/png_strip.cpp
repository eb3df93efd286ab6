#include "examples/encode/png_strip.h"

#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <span>

#include "examples/encode/deflate_blocks.h"

namespace nacre::host {

namespace {

/// PNG's number of the filter that subtracts what is on the left.
constexpr unsigned char filter_sub = 1;

std::vector<unsigned char> filtered(const std::vector<unsigned char>& rows, std::size_t row_bytes,
                                    std::size_t texel_bytes) {
  const std::size_t count = rows.size() / row_bytes;
  std::vector<unsigned char> bytes(count * (row_bytes + 1));
  for (std::size_t y = 0; y < count; ++y) {
    const unsigned char* from = rows.data() + y * row_bytes;
    unsigned char* to = bytes.data() + y * (row_bytes + 1);
    *to++ = filter_sub;
    std::memcpy(to, from, texel_bytes);
    for (std::size_t i = texel_bytes; i < row_bytes; ++i) {
      to[i] = static_cast<unsigned char>(from[i] - from[i - texel_bytes]);
    }
  }
  return bytes;
}

/// As zlib calls it.
struct Deflate {
  int strategy;
  int flush;
  int memory;  ///< Its level, 1 to 9.
};

/// A piece of a stream of raw deflate by zlib, at its quickest level.
std::vector<unsigned char> deflated(std::span<const unsigned char> bytes, const Deflate& how) {
  z_stream stream{};
  if (deflateInit2(&stream, 1, Z_DEFLATED, -MAX_WBITS, how.memory, how.strategy) != Z_OK) {
    throw std::bad_alloc();
  }
  const auto size = static_cast<uInt>(bytes.size());
  std::vector<unsigned char> out(deflateBound(&stream, size) + 16);  // And the mark of a flush.
  stream.next_in = const_cast<Bytef*>(bytes.data());                 // It is only read.
  stream.avail_in = size;
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, how.flush);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// Bytes that codes take which know how frequent each byte is, and no more: the entropy.
double coded_size(const std::vector<unsigned char>& bytes) {
  std::array<int, 256> counts{};
  for (const unsigned char byte : bytes) ++counts[byte];
  const auto all = static_cast<double>(bytes.size());
  double bits = 0.0;
  for (const int count : counts) {
    if (count > 0) bits -= count * std::log2(count / all);
  }
  return bits / 8.0;
}

/// Whether codes for frequent bytes leave much, of which looking for what was there before saves
/// less than a tenth: tried with the first bytes.
bool is_noise(const std::vector<unsigned char>& bytes) {
  constexpr std::ptrdiff_t tried = 8 << 10;
  if (bytes.size() < 4 * tried) return false;
  const std::vector<unsigned char> some(bytes.begin(), bytes.begin() + tried);
  const double coded = coded_size(some);
  if (coded < 0.375 * tried) return false;
  const std::vector<unsigned char> small =
      deflated(some, {.strategy = Z_DEFAULT_STRATEGY, .flush = Z_FINISH, .memory = 5});
  return static_cast<double>(small.size()) > 0.9 * coded;
}

/// The same of what is no noise, mostly by libdeflate: a bake waits for this more than for shading.
std::vector<unsigned char> deflated(std::span<const unsigned char> bytes, bool is_last) {
  DeflateBlocks blocks;
  std::vector<unsigned char> stream;
  std::size_t most = 2 * DeflateBlocks::block_bytes;  // Mostly one block too, and fewer begin anew.
  while (!bytes.empty()) {
    const auto block = bytes.first(std::min(bytes.size(), most));
    const bool ends = is_last && block.size() == bytes.size();
    const bool is_added = blocks.add(block, ends, stream);
    if (!is_added && most > DeflateBlocks::block_bytes) {
      most = DeflateBlocks::block_bytes;
      continue;
    }
    bytes = bytes.subspan(block.size());
    if (is_added) continue;
    const std::vector<unsigned char> piece =
        deflated(block, {.strategy = Z_DEFAULT_STRATEGY,
                         .flush = ends ? Z_FINISH : Z_SYNC_FLUSH,
                         .memory = MAX_MEM_LEVEL});
    stream.insert(stream.end(), piece.begin(), piece.end());
  }
  return stream;
}

}  // namespace

PngStrip compress_strip(const std::vector<unsigned char>& rows, std::size_t row_bytes,
                        std::size_t texel_bytes, bool is_last) {
  const std::vector<unsigned char> bytes = filtered(rows, row_bytes, texel_bytes);
  PngStrip strip;
  // A flush ends at a byte, so that the next piece can follow.
  strip.deflated = is_noise(bytes) ? deflated(bytes, {.strategy = Z_HUFFMAN_ONLY,
                                                      .flush = is_last ? Z_FINISH : Z_SYNC_FLUSH,
                                                      .memory = MAX_MEM_LEVEL})
                                   : deflated(bytes, is_last);
  strip.checksum = libdeflate_adler32(1, bytes.data(), bytes.size());
  strip.raw_bytes = bytes.size();
  return strip;
}

std::vector<unsigned char> png_chunk(const char* letters, const std::vector<unsigned char>& data) {
  std::vector<unsigned char> chunk;
  chunk.reserve(data.size() + 12);
  append_big_endian(chunk, static_cast<std::uint32_t>(data.size()));
  chunk.insert(chunk.end(), letters, letters + 4);
  chunk.insert(chunk.end(), data.begin(), data.end());
  append_big_endian(chunk, libdeflate_crc32(0, chunk.data() + 4, chunk.size() - 4));
  return chunk;
}

std::uint32_t joined_checksum(std::uint32_t first, std::uint32_t second, std::uint64_t bytes) {
  return static_cast<std::uint32_t>(adler32_combine(first, second, static_cast<z_off_t>(bytes)));
}

void append_big_endian(std::vector<unsigned char>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<unsigned char>(value >> shift));
  }
}

}  // namespace nacre::host
