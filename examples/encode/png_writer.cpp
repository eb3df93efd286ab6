#include "examples/encode/png_writer.h"

#include <algorithm>
#include <array>

#include "examples/encode/file_bytes.h"
#include "examples/encode/png_strip.h"
#include "examples/encode/sample_codes.h"

namespace nacre::host {

namespace {

/// Texels of a block, roughly: enough that compression loses little where blocks begin anew.
constexpr int block_texels = 1 << 16;
/// And so many blocks at least, where there are rows for it, that many threads have work.
constexpr int least_blocks = 32;

/// What the header of a zlib stream says: deflate, a window of 32 KB, compressed in haste.
constexpr std::array<unsigned char, 2> zlib_header{0x78, 0x01};

class PngWriter final : public ImageWriter {
 public:
  PngWriter(const std::string& file, const ImageHeader& header)
      : header_(header),
        channels_(header.channels.size()),
        sample_bytes_(header.samples == SampleType::unsigned16 ? 2 : 1),
        file_(file) {
    file_.append(std::array<unsigned char, 8>{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'});
    append_header();
    append_colorspace();
    for (const auto& [name, text] : header.texts) append_text(name, text);
  }

  int block_rows() const override {
    const int most = (header_.height + least_blocks - 1) / least_blocks;
    return std::clamp(block_texels / header_.width, 1, most);
  }

  EncodedRows encode(const ImageRows& rows) const override {
    const std::vector<unsigned char> samples = sample_bytes_ == 2 ? words_of(rows) : bytes_of(rows);
    const std::size_t texel_bytes = channels_ * sample_bytes_;
    const bool is_last = rows.first + rows.rows == header_.height;
    PngStrip strip = compress_strip(samples, static_cast<std::size_t>(header_.width) * texel_bytes,
                                    texel_bytes, is_last);
    if (rows.first == 0) {
      strip.deflated.insert(strip.deflated.begin(), zlib_header.begin(), zlib_header.end());
    }
    return {rows.first, rows.rows, png_chunk("IDAT", strip.deflated), strip.checksum,
            strip.raw_bytes};
  }

  bool append(const EncodedRows& rows) override {
    checksum_ =
        rows.first == 0 ? rows.checksum : joined_checksum(checksum_, rows.checksum, rows.raw_bytes);
    return file_.append(rows.bytes);
  }

  std::string finish() override {
    std::vector<unsigned char> checksum;
    append_big_endian(checksum, checksum_);
    file_.append(png_chunk("IDAT", checksum));
    file_.append(png_chunk("IEND", {}));
    return file_.finish();
  }

  std::string problem() const override { return file_.problem(); }

 private:
  void append_header() {
    constexpr std::array<unsigned char, 4> kinds{0, 4, 2, 6};  // By channels.
    std::vector<unsigned char> data;
    append_big_endian(data, static_cast<std::uint32_t>(header_.width));
    append_big_endian(data, static_cast<std::uint32_t>(header_.height));
    data.push_back(static_cast<unsigned char>(8 * sample_bytes_));
    data.push_back(kinds[channels_ - 1]);
    data.insert(data.end(), {0, 0, 0});  // Deflate, filters by row, not interlaced.
    file_.append(png_chunk("IHDR", data));
  }

  /// sRGB, and gAMA and cHRM for readers that do not know it; "Linear" is a gamma of 1; what
  /// PNG has no number for is named, as OpenImageIO does.
  void append_colorspace() {
    const auto numbers = [&](const char* letters, std::initializer_list<std::uint32_t> values) {
      std::vector<unsigned char> data;
      for (const std::uint32_t value : values) append_big_endian(data, value);
      file_.append(png_chunk(letters, data));
    };
    if (header_.colorspace == "sRGB") {
      numbers("gAMA", {45455});
      file_.append(png_chunk("sRGB", {0}));  // Perceptual.
      numbers("cHRM", {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000});
    } else if (header_.colorspace == "Linear") {
      numbers("gAMA", {100000});
    }
    if (!header_.colorspace.empty()) append_text("oiio:ColorSpace", header_.colorspace);
  }

  void append_text(const std::string& name, const std::string& text) {
    const std::string all = name + '\0' + text;
    file_.append(png_chunk("tEXt", {all.begin(), all.end()}));
  }

  bool is_coded(std::size_t channel) const { return header_.codes_srgb && channel != 3; }

  std::vector<unsigned char> bytes_of(const ImageRows& rows) const {
    std::vector<unsigned char> bytes(rows.planes[0].size() * channels_);
    for (std::size_t c = 0; c < channels_; ++c) {
      const std::vector<float>& plane = rows.planes[c];
      put_codes(plane.data(), plane.size(), is_coded(c), bytes.data() + c, channels_);
    }
    return bytes;
  }

  std::vector<unsigned char> words_of(const ImageRows& rows) const {
    std::vector<std::uint16_t> words(rows.planes[0].size() * channels_);
    for (std::size_t c = 0; c < channels_; ++c) {
      const std::vector<float>& plane = rows.planes[c];
      put_codes(plane.data(), plane.size(), is_coded(c), words.data() + c, channels_);
    }
    std::vector<unsigned char> bytes(2 * words.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
      bytes[2 * i] = static_cast<unsigned char>(words[i] >> 8);
      bytes[2 * i + 1] = static_cast<unsigned char>(words[i] & 0xff);
    }
    return bytes;
  }

  ImageHeader header_;
  std::size_t channels_;
  std::size_t sample_bytes_;
  FileBytes file_;
  std::uint32_t checksum_ = 1;
};

}  // namespace

std::unique_ptr<ImageWriter> write_png(const std::string& file, const ImageHeader& header,
                                       std::string& problem) {
  const bool is_integer =
      header.samples == SampleType::unsigned8 || header.samples == SampleType::unsigned16;
  if (!is_integer || header.channels.empty() || header.channels.size() > 4) {
    problem = "a png holds one to four channels of 8 or 16 bits";
    return nullptr;
  }
  auto image = std::make_unique<PngWriter>(file, header);
  problem = image->problem();
  return problem.empty() ? std::move(image) : nullptr;
}

}  // namespace nacre::host
