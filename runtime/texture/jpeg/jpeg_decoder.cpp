#include "runtime/texture/jpeg/jpeg_decoder.h"

// libjpeg's header needs the types of these.
#include <jpeglib.h>

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "runtime/texture/essential_image.h"

namespace nacre {

namespace {

constexpr int rows_between_stops = 64;

/// libjpeg's manager of errors, first as libjpeg knows it: a fault ends the call that it is in,
/// and nothing is printed.
struct Faults {
  jpeg_error_mgr manager;
  std::jmp_buf out;
  char text[JMSG_LENGTH_MAX];
  bool has_text;

  /// Also of what libjpeg could go on after: it makes up what is missing.
  static void note(j_common_ptr about) {
    auto* const faults = reinterpret_cast<Faults*>(about->err);
    if (faults->has_text) return;
    about->err->format_message(about, faults->text);
    faults->has_text = true;
  }
  [[noreturn]] static void leave(j_common_ptr about) {
    note(about);
    std::longjmp(reinterpret_cast<Faults*>(about->err)->out, 1);
  }
};

class JpegDecoder final : public ImageDecoder {
 public:
  JpegDecoder() {
    reader_.err = jpeg_std_error(&faults_.manager);
    faults_.manager.error_exit = Faults::leave;
    faults_.manager.output_message = Faults::note;
    faults_.has_text = false;
  }
  ~JpegDecoder() override {
    if (is_made_) jpeg_destroy_decompress(&reader_);
  }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  std::optional<Diagnostic> open(std::shared_ptr<const ImageFile> file, const std::string&,
                                 const ImageLimits& limits, ImageExtent extent, const Stop& stop,
                                 ImageInfo& info) override {
    file_ = std::move(file);
    stop_ = stop;
    if (auto problem = essential_jpeg(*file_, limits, extent, bytes_)) return problem;
    if (!read_header()) return broken();
    if (!is_plain()) return std::nullopt;
    info.width = static_cast<int>(reader_.image_width);
    info.height = static_cast<int>(reader_.image_height);
    info.channels = reader_.num_components;
    info.samples = SampleType::unsigned8;
    if (auto problem = check_image_size(file_->path(), info.width, info.height, limits)) {
      return problem;
    }
    const std::uint64_t pixels = std::uint64_t{reader_.image_width} * reader_.image_height;
    const std::uint64_t bytes = pixels * static_cast<std::uint64_t>(info.channels);
    return check_image_bytes(*file_, {.decoded = bytes, .kept = bytes, .in_memory = 4 * pixels},
                             limits);
  }

  std::optional<Diagnostic> read(const std::function<void(int, const float*)>& row) override {
    const std::size_t width = std::size_t{reader_.image_width};
    const std::size_t count = width * static_cast<std::size_t>(reader_.num_components);
    std::vector<JSAMPLE> bytes(count);
    std::vector<float> samples(count);
    if (!begin()) return broken();
    for (JDIMENSION y = 0; y < reader_.image_height; ++y) {
      if (y % rows_between_stops == 0 && stop_.is_due()) return broken();
      if (!read_row(bytes.data()) || faults_.has_text) return broken();
      // As OpenImageIO does: by the factor, not by dividing.
      for (std::size_t i = 0; i < count; ++i) {
        samples[i] = static_cast<float>(bytes[i]) * (1.0f / 255.0f);
      }
      row(static_cast<int>(y), samples.data());
    }
    return std::nullopt;
  }

  /// Grey, or red, green and blue, or what libjpeg makes these of.
  bool is_plain() const {
    const J_COLOR_SPACE space = reader_.jpeg_color_space;
    return reader_.num_components == 1
               ? space == JCS_GRAYSCALE
               : reader_.num_components == 3 && (space == JCS_YCbCr || space == JCS_RGB);
  }

 private:
  Diagnostic broken() const {
    return broken_image(file_->path(), "JPEG error: " + std::string(faults_.text));
  }

  // What libjpeg leaves in its middle has nothing to clean up: these hold no object of ours.

  bool read_header() {
    if (setjmp(faults_.out) != 0) return false;
    jpeg_create_decompress(&reader_);
    is_made_ = true;
    jpeg_mem_src(&reader_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
    return jpeg_read_header(&reader_, TRUE) == JPEG_HEADER_OK;
  }

  bool begin() {
    if (setjmp(faults_.out) != 0) return false;
    return jpeg_start_decompress(&reader_) == TRUE && !faults_.has_text;
  }

  bool read_row(JSAMPLE* to) {
    if (setjmp(faults_.out) != 0) return false;
    return jpeg_read_scanlines(&reader_, &to, 1) == 1;
  }

  Faults faults_{};
  jpeg_decompress_struct reader_{};
  bool is_made_ = false;
  std::shared_ptr<const ImageFile> file_;
  std::string bytes_;
  Stop stop_;
};

}  // namespace

std::unique_ptr<ImageDecoder> open_jpeg(std::shared_ptr<const ImageFile> file,
                                        const std::string& layer, const ImageLimits& limits,
                                        ImageExtent extent, const Stop& stop, ImageInfo& info,
                                        std::optional<Diagnostic>& problem) {
  constexpr int most_channels = 3;
  if (!layer.empty() || limits.max_channels < most_channels || limits.max_layers < 1) {
    return nullptr;
  }
  auto decoder = std::make_unique<JpegDecoder>();
  problem = decoder->open(std::move(file), layer, limits, extent, stop, info);
  if (problem || !decoder->is_plain()) return nullptr;
  return decoder;
}

}  // namespace nacre
