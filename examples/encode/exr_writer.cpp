#include "examples/encode/exr_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "examples/encode/exr_block.h"
#include "examples/encode/file_bytes.h"
#include "runtime/texture/texel.h"

namespace nacre::host {

namespace {

using Bytes = std::vector<unsigned char>;

/// Lowest byte first, as EXR has all numbers.
template <class Number>
void append_number(Bytes& bytes, Number value) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes.push_back(static_cast<unsigned char>(value >> (8 * i) & 0xff));
  }
}

void append_int(Bytes& bytes, int value) {
  append_number(bytes, static_cast<std::uint32_t>(value));
}

void append_float(Bytes& bytes, float value) {
  append_number(bytes, std::bit_cast<std::uint32_t>(value));
}

void append_text(Bytes& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
  bytes.push_back(0);
}

void append_attribute(Bytes& header, std::string_view name, std::string_view type,
                      const Bytes& value) {
  append_text(header, name);
  append_text(header, type);
  append_int(header, static_cast<int>(value.size()));
  header.insert(header.end(), value.begin(), value.end());
}

/// Names of channels and attributes may have 255 letters then.
bool has_long_names(const ImageHeader& image) {
  constexpr std::size_t most = 31;
  return std::ranges::any_of(image.channels, [](auto& name) { return name.size() > most; }) ||
         std::ranges::any_of(image.texts, [](auto& text) { return text.first.size() > most; });
}

/// Its corners are pixels that it has.
Bytes box(int x, int y, int width, int height) {
  Bytes corners;
  for (const int corner : {x, y, x + width - 1, y + height - 1}) append_int(corners, corner);
  return corners;
}

void append_string(Bytes& header, std::string_view name, const std::string& text) {
  append_attribute(header, name, "string", {text.begin(), text.end()});
}

/// OpenEXR's own name for what OpenImageIO calls otherwise.
std::string exr_name(const std::string& name) { return name == "Software" ? "software" : name; }

std::uint16_t half_of(float value) {
  if (std::isfinite(value)) return float_to_half(value);
  if (std::isnan(value)) return 0x7e00;
  return value > 0.0f ? 0x7c00 : 0xfc00;
}

class ExrWriter final : public ImageWriter {
 public:
  ExrWriter(const std::string& file, const ImageHeader& header)
      : width_(static_cast<std::size_t>(header.width)),
        top_(header.display ? header.display->y : 0),
        is_half_(header.samples == SampleType::half),
        order_(header.channels.size()),
        file_(file) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return header.channels[a] < header.channels[b];
    });
    file_.append(head(header));
    table_ = file_.size();
    const int blocks = (header.height + exr_block_rows - 1) / exr_block_rows;
    file_.append(Bytes(8 * static_cast<std::size_t>(blocks)));
  }

  int block_rows() const override { return exr_block_rows; }

  EncodedRows encode(const ImageRows& rows) const override {
    Bytes raw(rows.planes.size() * rows.planes[0].size() * (is_half_ ? 2 : 4));
    unsigned char* next = raw.data();
    for (int y = 0; y < rows.rows; ++y) {
      for (const std::size_t channel : order_) {
        const float* row = rows.planes[channel].data() + static_cast<std::size_t>(y) * width_;
        next = is_half_ ? put_halves(row, next) : put_floats(row, next);
      }
    }
    const Bytes packed = compress_exr_block(std::move(raw));
    EncodedRows encoded{rows.first, rows.rows, {}, 0, 0};
    encoded.bytes.reserve(packed.size() + 8);
    append_int(encoded.bytes, top_ + rows.first);
    append_int(encoded.bytes, static_cast<int>(packed.size()));
    encoded.bytes.insert(encoded.bytes.end(), packed.begin(), packed.end());
    return encoded;
  }

  bool append(const EncodedRows& rows) override {
    append_number(offsets_, file_.size());
    return file_.append(rows.bytes);
  }

  std::string finish() override {
    file_.replace(table_, offsets_);
    return file_.finish();
  }

  std::string problem() const override { return file_.problem(); }

 private:
  Bytes head(const ImageHeader& image) const {
    Bytes bytes;
    append_int(bytes, 20000630);                    // The magic number.
    constexpr int version = 2, long_names = 0x400;  // Scan lines.
    append_int(bytes, has_long_names(image) ? version | long_names : version);
    Bytes channels;
    for (const std::size_t channel : order_) {
      append_text(channels, image.channels[channel]);
      append_int(channels, is_half_ ? 1 : 2);
      append_int(channels, 0);  // Not made for perceptual codes.
      append_int(channels, 1);  // A sample for each texel, along x and along y.
      append_int(channels, 1);
    }
    channels.push_back(0);
    append_attribute(bytes, "channels", "chlist", channels);
    append_attribute(bytes, "compression", "compression", {3});  // ZIP.
    if (image.chromaticities) {
      Bytes points;
      for (const float number : *image.chromaticities) append_float(points, number);
      append_attribute(bytes, "chromaticities", "chromaticities", points);
    }
    const ImageHeader::Display all =
        image.display.value_or(ImageHeader::Display{0, 0, image.width, image.height});
    append_attribute(bytes, "dataWindow", "box2i", box(all.x, all.y, image.width, image.height));
    append_attribute(bytes, "displayWindow", "box2i", box(0, 0, all.width, all.height));
    append_attribute(bytes, "lineOrder", "lineOrder", {0});  // From the top.
    // Linear is what a reader takes for granted.
    if (image.colorspace != "Linear") {
      append_string(bytes, "oiio:ColorSpace", image.colorspace);
    }
    Bytes one;
    append_float(one, 1.0f);
    append_attribute(bytes, "pixelAspectRatio", "float", one);
    append_attribute(bytes, "screenWindowCenter", "v2f", Bytes(8));
    append_attribute(bytes, "screenWindowWidth", "float", one);
    for (const auto& [name, text] : image.texts) append_string(bytes, exr_name(name), text);
    append_string(bytes, "wrapmodes", image.repeats ? "periodic,periodic" : "clamp,clamp");
    bytes.push_back(0);
    return bytes;
  }

  unsigned char* put_floats(const float* row, unsigned char* next) const {
    for (std::size_t x = 0; x < width_; ++x) {
      const auto bits = std::bit_cast<std::uint32_t>(row[x]);
      for (int shift = 0; shift < 32; shift += 8) {
        *next++ = static_cast<unsigned char>(bits >> shift);
      }
    }
    return next;
  }

  unsigned char* put_halves(const float* row, unsigned char* next) const {
    for (std::size_t x = 0; x < width_; ++x) {
      const std::uint16_t half = half_of(row[x]);
      *next++ = static_cast<unsigned char>(half & 0xff);
      *next++ = static_cast<unsigned char>(half >> 8);
    }
    return next;
  }

  std::size_t width_;
  int top_;  ///< The first row, in the display window.
  bool is_half_;
  std::vector<std::size_t> order_;  ///< Channels as the file has them: by name.
  FileBytes file_;
  std::uint64_t table_ = 0;  ///< Where the file says where its blocks are.
  Bytes offsets_;
};

}  // namespace

std::unique_ptr<ImageWriter> write_exr(const std::string& file, const ImageHeader& header,
                                       std::string& problem) {
  const bool is_float =
      header.samples == SampleType::half || header.samples == SampleType::floating;
  // The format counts a block's bytes with 31 bits.
  constexpr std::uint64_t most = std::uint64_t{1} << 31;
  const std::uint64_t block = std::uint64_t{4} * exr_block_rows *
                              static_cast<std::uint64_t>(header.width) * header.channels.size();
  if (!is_float || header.channels.empty() || block >= most) {
    problem = "an exr holds channels of 16 or 32 bits, 2 GB in 16 rows of them";
    return nullptr;
  }
  auto image = std::make_unique<ExrWriter>(file, header);
  problem = image->problem();
  return problem.empty() ? std::move(image) : nullptr;
}

}  // namespace nacre::host
