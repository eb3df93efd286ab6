#include "examples/image_writer/levels.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cstring>
#include <filesystem>
#include <system_error>

#include "examples/image_writer/copy_levels.h"
#include "examples/image_writer/spec.h"

namespace nacre::host {

namespace {

class LevelWriter final : public ImageWriter {
 public:
  LevelWriter(std::string file, const ImageHeader& header)
      : file_(std::move(file)),
        repeats_(header.repeats),
        texts_(header.texts),
        image_(spec_of(header)) {}

  int block_rows() const override { return 16; }

  EncodedRows encode(const ImageRows& rows) const override {
    const std::size_t channels = rows.planes.size();
    const std::size_t texels = rows.planes[0].size();
    std::vector<float> samples(channels * texels);
    for (std::size_t c = 0; c < channels; ++c) {
      for (std::size_t i = 0; i < texels; ++i) samples[i * channels + c] = rows.planes[c][i];
    }
    EncodedRows encoded{rows.first, rows.rows, {}, 0, 0};
    encoded.bytes.resize(samples.size() * sizeof(float));
    std::memcpy(encoded.bytes.data(), samples.data(), encoded.bytes.size());
    return encoded;
  }

  bool append(const EncodedRows& rows) override {
    const OIIO::ROI roi(0, image_.spec().width, rows.first, rows.first + rows.rows, 0, 1, 0,
                        image_.nchannels());
    return image_.set_pixels(roi, OIIO::TypeDesc::FLOAT, rows.bytes.data());
  }

  std::string finish() override {
    // Else tiles lie in the order they are ready. The smaller levels have no attribute of
    // their own for it, only the process has.
    OIIO::attribute("tiff:multithread", 0);
    OIIO::ImageSpec config;
    config.attribute("maketx:highlightcomp", 0);
    config.attribute("tiff:half", 1);
    config.attribute("DateTime", "");
    for (const auto& [name, text] : texts_) config.attribute(name, text);
    config.attribute("wrapmodes", repeats_ ? "periodic,periodic" : "clamp,clamp");
    const std::string levels = file_ + ".levels.tx";
    std::string why;
    if (OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image_, levels,
                                         config)) {
      why = copy_levels(levels, file_);
    } else {
      why = OIIO::geterror();
      if (why.empty()) why = "the texture could not be made";
    }
    std::error_code ignored;
    std::filesystem::remove(levels, ignored);
    return why;
  }

  std::string problem() const override { return failure(image_.geterror()); }

 private:
  std::string file_;
  bool repeats_;
  std::vector<std::pair<std::string, std::string>> texts_;
  OIIO::ImageBuf image_;
};

}  // namespace

std::unique_ptr<ImageWriter> write_levels(const std::string& file, const ImageHeader& header) {
  return std::make_unique<LevelWriter>(file, header);
}

}  // namespace nacre::host
