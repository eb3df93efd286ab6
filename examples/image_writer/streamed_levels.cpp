#include "examples/image_writer/streamed_levels.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>

#include "examples/image_writer/spec.h"

namespace nacre::host {

namespace {

constexpr int tile_side = 64;  ///< As maketx has it.

/// Bytes of floats; what is smaller is kept whole.
constexpr std::uint64_t most_kept = std::uint64_t{256} << 20;

/// A level on its way: rows come from the top.
struct Level {
  int width, height;
  int rows = 0;                  ///< That have come.
  std::vector<float> band = {};  ///< Rows that were not written yet.
  std::vector<float> even =
      {};                 ///< The row above, where the next one makes a row of the next level.
  std::string file = {};  ///< Where its rows are kept; "": the texture itself.
  std::ofstream stream = {};
};

/// The mean of two by two texels; of a level of one row or column of two.
std::vector<float> halved(const std::vector<float>& above, const std::vector<float>& below,
                          int width, std::size_t channels) {
  const std::size_t step = width > 1 ? channels : 0;
  const auto texels = static_cast<std::size_t>(std::max(width / 2, 1));
  std::vector<float> row(texels * channels);
  for (std::size_t x = 0; x < texels; ++x) {
    const std::size_t left = 2 * x * step;
    for (std::size_t c = 0; c < channels; ++c) {
      const std::size_t a = left + c;
      const std::size_t b = left + step + c;
      row[x * channels + c] = 0.5f * (0.5f * (above[a] + above[b]) + 0.5f * (below[a] + below[b]));
    }
  }
  return row;
}

class StreamedLevels final : public ImageWriter {
 public:
  StreamedLevels(std::string file, const ImageHeader& header)
      : file_(std::move(file)),
        channels_(header.channels.size()),
        spec_(spec_of(header)),
        out_(OIIO::ImageOutput::create("tiff")) {
    spec_.attribute("textureformat", "Plain Texture");
    spec_.attribute("wrapmodes", header.repeats ? "periodic,periodic" : "clamp,clamp");
    spec_.attribute("tiff:bigtiff", 1);  // What it takes, compressed, nobody knows now.
    spec_.tile_width = spec_.tile_height = tile_side;
    for (int level = 0; level == 0 || (header.width | header.height) >> level != 0; ++level) {
      levels_.push_back({std::max(header.width >> level, 1), std::max(header.height >> level, 1)});
      if (level == 0) continue;
      levels_.back().file = fmt::format("{}.level{}", file_, level);
      levels_.back().stream.open(levels_.back().file, std::ios::binary | std::ios::trunc);
    }
    // Else tiles lie in the order they are ready.
    OIIO::attribute("tiff:multithread", 0);
    if (!out_ || !out_->open(file_, spec_)) fail();
  }

  int block_rows() const override { return 16; }

  EncodedRows encode(const ImageRows& rows) const override {
    const std::size_t texels = rows.planes[0].size();
    std::vector<float> samples(channels_ * texels);
    for (std::size_t c = 0; c < channels_; ++c) {
      for (std::size_t i = 0; i < texels; ++i) samples[i * channels_ + c] = rows.planes[c][i];
    }
    EncodedRows encoded{rows.first, rows.rows, {}, 0, 0};
    encoded.bytes.resize(samples.size() * sizeof(float));
    std::memcpy(encoded.bytes.data(), samples.data(), encoded.bytes.size());
    return encoded;
  }

  bool append(const EncodedRows& rows) override {
    const std::size_t floats = static_cast<std::size_t>(levels_[0].width) * channels_;
    for (int y = 0; y < rows.rows; ++y) {
      std::vector<float> row(floats);
      std::memcpy(row.data(), rows.bytes.data() + static_cast<std::size_t>(y) * 4 * floats,
                  4 * floats);
      add_row(0, std::move(row));
    }
    return problem_.empty();
  }

  std::string finish() override {
    for (std::size_t level = 1; level < levels_.size() && problem_.empty(); ++level) {
      write_level(levels_[level]);
    }
    if (problem_.empty() && !out_->close()) fail();
    return problem_;
  }

  std::string problem() const override { return failure(problem_); }

 private:
  void fail() {
    if (problem_.empty()) problem_ = failure(out_ ? out_->geterror() : OIIO::geterror());
  }

  /// A row of a level, and with every second one a row of the next.
  void add_row(std::size_t number, std::vector<float> row) {
    Level& level = levels_[number];
    level.band.insert(level.band.end(), row.begin(), row.end());
    ++level.rows;
    if (level.rows % tile_side == 0 || level.rows == level.height) write_band(level);
    if (number + 1 == levels_.size()) return;
    if (level.height == 1) return add_row(number + 1, halved(row, row, level.width, channels_));
    if (level.rows % 2 == 1) {
      level.even = std::move(row);
    } else {
      add_row(number + 1, halved(level.even, row, level.width, channels_));
    }
  }

  void write_band(Level& level) {
    if (level.file.empty()) {
      write_tiles(level, level.band, (level.rows - 1) / tile_side * tile_side);
    } else {
      level.stream.write(reinterpret_cast<const char*>(level.band.data()),
                         static_cast<std::streamsize>(level.band.size() * sizeof(float)));
      if (!level.stream && problem_.empty()) problem_ = "the levels could not be kept";
    }
    level.band.clear();
  }

  /// Rows from `first` on, as many as a tile has or are left, with zeros beyond the edges.
  void write_tiles(const Level& level, const std::vector<float>& band, int first) {
    const std::size_t row = static_cast<std::size_t>(level.width) * channels_;
    const std::size_t tile_row = tile_side * channels_;
    std::vector<float> tile(tile_side * tile_row);
    for (int x = 0; x < level.width && problem_.empty(); x += tile_side) {
      std::fill(tile.begin(), tile.end(), 0.0f);
      const std::size_t floats =
          static_cast<std::size_t>(std::min(tile_side, level.width - x)) * channels_;
      for (std::size_t y = 0; y < band.size() / row; ++y) {
        const auto from = band.begin() + static_cast<std::ptrdiff_t>(
                                             y * row + static_cast<std::size_t>(x) * channels_);
        std::copy_n(from, floats, tile.begin() + static_cast<std::ptrdiff_t>(y * tile_row));
      }
      if (!out_->write_tile(x, first, 0, OIIO::TypeDesc::FLOAT, tile.data())) fail();
    }
  }

  /// From the file that keeps it.
  void write_level(Level& level) {
    level.stream.close();
    OIIO::ImageSpec spec(level.width, level.height, spec_.nchannels, spec_.format);
    spec.channelnames = spec_.channelnames;
    spec.tile_width = spec.tile_height = tile_side;
    for (const char* const name : {"compression", "textureformat", "wrapmodes"}) {
      spec.attribute(name, spec_.get_string_attribute(name));
    }
    for (const char* const name : {"oiio:UnassociatedAlpha", "tiff:half", "tiff:bigtiff"}) {
      spec.attribute(name, 1);
    }
    spec.attribute("DateTime", "");
    // Levels are pages to TIFF.
    if (!out_->open(file_, spec, OIIO::ImageOutput::AppendSubimage)) return fail();
    std::ifstream kept(level.file, std::ios::binary);
    for (int first = 0; first < level.height && problem_.empty(); first += tile_side) {
      const auto rows = static_cast<std::size_t>(std::min(tile_side, level.height - first));
      std::vector<float> band(rows * static_cast<std::size_t>(level.width) * channels_);
      kept.read(reinterpret_cast<char*>(band.data()),
                static_cast<std::streamsize>(band.size() * sizeof(float)));
      if (!kept) problem_ = "the levels could not be kept";
      if (problem_.empty()) write_tiles(level, band, first);
    }
  }

  std::string file_;
  std::size_t channels_;
  OIIO::ImageSpec spec_;
  std::unique_ptr<OIIO::ImageOutput> out_;
  std::vector<Level> levels_;
  std::string problem_;
};

}  // namespace

bool is_streamed(const ImageHeader& header) {
  const std::uint64_t bytes = std::uint64_t{4} * header.channels.size() *
                              static_cast<std::uint64_t>(header.width) *
                              static_cast<std::uint64_t>(header.height);
  return bytes > most_kept && std::has_single_bit(static_cast<unsigned>(header.width)) &&
         std::has_single_bit(static_cast<unsigned>(header.height));
}

std::unique_ptr<ImageWriter> stream_levels(const std::string& file, const ImageHeader& header,
                                           std::string& problem) {
  auto image = std::make_unique<StreamedLevels>(file, header);
  if (image->append({})) return image;
  problem = image->problem();
  return nullptr;
}

}  // namespace nacre::host
