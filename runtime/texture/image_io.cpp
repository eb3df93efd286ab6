#include "runtime/texture/image_io.h"

#include <exception>
#include <utility>

#include "runtime/texture/image_module.h"
#include "runtime/texture/jpeg/jpeg_decoder.h"

namespace nacre {

ImageReader::ImageReader() = default;
ImageReader::~ImageReader() = default;

std::optional<Diagnostic> ImageReader::guarded(
    const std::function<std::optional<Diagnostic>()>& work) {
  std::optional<Diagnostic> problem;
  try {
    problem = work();
  } catch (const std::exception& error) {
    problem = broken_image(path_, error.what());
  }
  if (!problem) return std::nullopt;
  decoder_.reset();
  // A reader that gets no more bytes says many things.
  if (stop_.is_due()) {
    problem = image_error("stopped", path_, "the image was not read in the time that there was");
  }
  return problem;
}

std::optional<Diagnostic> ImageReader::open(const std::string& path, const std::string& layer,
                                            const ImageLimits& limits, const Stop& stop) {
  return open(path, layer, limits, stop, ImageExtent::whole);
}

std::optional<Diagnostic> ImageReader::look(const std::string& path, const std::string& layer,
                                            const ImageLimits& limits, const Stop& stop) {
  auto problem = open(path, layer, limits, stop, ImageExtent::header);
  decoder_.reset();
  return problem;
}

std::optional<Diagnostic> ImageReader::open(const std::string& path, const std::string& layer,
                                            const ImageLimits& limits, const Stop& stop,
                                            ImageExtent extent) {
  path_ = path;
  info_ = {};
  stop_ = stop;
  decoder_.reset();
  return guarded([&] { return open_image(layer, limits, extent); });
}

std::optional<Diagnostic> ImageReader::open_image(const std::string& layer,
                                                  const ImageLimits& limits, ImageExtent extent) {
  Diagnostic error;
  auto file = ImageFile::open(path_, limits, error);
  if (file == nullptr) return error;
  info_.file = file->identity();
  if (file->format() == ImageFormat::jpeg) {
    std::optional<Diagnostic> problem;
    decoder_ = open_jpeg(file, layer, limits, extent, stop_, info_, problem);
    if (decoder_ != nullptr || problem) return problem;
  }
  const ImageModule* const module = image_module(path_, error);
  if (module == nullptr) return error;
  decoder_ = module->make_decoder();
  return decoder_->open(std::move(file), layer, limits, extent, stop_, info_);
}

std::optional<Diagnostic> ImageReader::read(const std::function<void(int, const float*)>& row) {
  return guarded([&] { return decoder_->read(row); });
}

}  // namespace nacre
