#include "runtime/texture/png_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <vector>

namespace nacre {

namespace {

constexpr std::size_t piece_size = 1 << 16;
constexpr std::uint64_t most_surplus = 1 << 16;  // libpng unpacks that too.
constexpr unsigned char last_filter = 4;         // PNG, 9.2.

std::uint32_t four_bytes(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// Rows of one pass, a byte for the filter before each.
struct Pass {
  std::uint64_t rows = 0;
  std::uint64_t row_bytes = 0;
};

/// Where the pixels of a pass begin, and how far apart they are (PNG, 8.2: Adam7).
struct PassGrid {
  std::uint32_t x, y, step_x, step_y;
};
constexpr std::array<PassGrid, 1> all_at_once{{{0, 0, 1, 1}}};
constexpr std::array<PassGrid, 7> adam7{{{0, 0, 8, 8},
                                         {4, 0, 8, 8},
                                         {0, 4, 4, 8},
                                         {2, 0, 4, 4},
                                         {0, 2, 2, 4},
                                         {1, 0, 2, 2},
                                         {0, 1, 1, 2}}};

std::vector<Pass> passes_of(const PngHeader& header) {
  std::vector<Pass> passes;
  const auto add = [&](const PassGrid& grid) {
    if (header.width <= grid.x || header.height <= grid.y) return;
    const std::uint64_t columns = (header.width - grid.x + grid.step_x - 1) / grid.step_x;
    const std::uint64_t rows = (header.height - grid.y + grid.step_y - 1) / grid.step_y;
    passes.push_back({rows, 1 + (columns * header.samples() * header.depth + 7) / 8});
  };
  if (header.interlacing == 0) {
    for (const PassGrid& grid : all_at_once) add(grid);
  } else {
    for (const PassGrid& grid : adam7) add(grid);
  }
  return passes;
}

}  // namespace

PngHeader::PngHeader(std::string_view bytes)
    : width(four_bytes(bytes, 0)),
      height(four_bytes(bytes, 4)),
      depth(static_cast<unsigned char>(bytes[8])),
      color_type(static_cast<unsigned char>(bytes[9])),
      methods(static_cast<unsigned char>(bytes[10] | bytes[11])),
      interlacing(static_cast<unsigned char>(bytes[12])) {}

bool PngHeader::is_valid() const {
  const bool is_byte = depth == 8 || depth == 16;
  const bool is_less = depth == 1 || depth == 2 || depth == 4;
  if (methods != 0 || interlacing > 1) return false;
  switch (color_type) {
    case 0: return is_byte || is_less;
    case 3: return is_less || depth == 8;
    case 2:
    case 4:
    case 6: return is_byte;
    default: return false;
  }
}

std::uint32_t PngHeader::samples() const {
  switch (color_type) {
    case 2: return 3;
    case 4: return 2;
    case 6: return 4;
    default: return 1;
  }
}

struct PngData::State {
  z_stream stream{};
  std::vector<unsigned char> piece = std::vector<unsigned char>(piece_size);
  std::vector<Pass> passes;   ///< That there is more to come of.
  std::uint64_t at = 0;       ///< In the row.
  std::uint64_t surplus = 0;  ///< Behind the last row.
  bool is_begun = false;
  bool is_over = false;

  /// False for a filter that there is not, and much more than there are rows.
  bool count(std::size_t size) {
    for (std::size_t i = 0; i < size;) {
      if (passes.empty()) return (surplus += size - i) <= most_surplus;
      Pass& pass = passes.front();
      if (at == 0 && piece[i] > last_filter) return false;
      const std::uint64_t step = std::min<std::uint64_t>(pass.row_bytes - at, size - i);
      at += step;
      i += static_cast<std::size_t>(step);
      if (at < pass.row_bytes) return true;
      at = 0;
      if (--pass.rows == 0) passes.erase(passes.begin());
    }
    return true;
  }
};

PngData::PngData(const PngHeader& header) : state_(std::make_unique<State>()) {
  state_->passes = passes_of(header);
  // With the window that the data ask for, as libpng has it.
  state_->is_begun = ::inflateInit2(&state_->stream, 0) == Z_OK;
}

PngData::~PngData() {
  if (state_->is_begun) ::inflateEnd(&state_->stream);
}

bool PngData::take(std::string_view bytes) {
  if (!state_->is_begun) return false;
  z_stream& stream = state_->stream;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  while (!state_->is_over && (stream.avail_in > 0 || stream.avail_out == 0)) {
    stream.next_out = state_->piece.data();
    stream.avail_out = static_cast<uInt>(state_->piece.size());
    const int result = ::inflate(&stream, Z_NO_FLUSH);
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR) return false;
    if (!state_->count(state_->piece.size() - stream.avail_out)) return false;
    state_->is_over = result == Z_STREAM_END;
    if (result == Z_BUF_ERROR) break;
  }
  return true;
}

bool PngData::is_whole() const { return state_->passes.empty() && state_->is_over; }

}  // namespace nacre
