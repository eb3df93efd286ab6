#include "examples/common/image_writer.h"

#include <algorithm>

#include "examples/common/atomic_file.h"
#include "examples/encode/exr_writer.h"
#include "examples/encode/png_writer.h"

namespace nacre::host {

namespace {

/// Null, with the reason, where no .tx is written.
const ImageWriterModule* writer_module(std::string& problem) {
  if (!NACRE_WITH_OPENIMAGEIO) {
    problem = "this build of Nacre writes no .tx (NACRE_WITH_OPENIMAGEIO=OFF)";
    return nullptr;
  }
  ModuleFault fault;
  const ModuleHead* const module = open_module("nacre_image_writer", fault);
  if (module == nullptr) problem = "no " + fault.expected + ": " + fault.found;
  return static_cast<const ImageWriterModule*>(module);
}

}  // namespace

std::string write_planes(ImageWriter& image, const ImageHeader& header,
                         std::span<const std::vector<float>> planes) {
  std::vector<std::vector<float>> block(planes.size());
  const auto width = static_cast<std::ptrdiff_t>(header.width);
  for (int first = 0; first < header.height; first += image.block_rows()) {
    const int rows = std::min(image.block_rows(), header.height - first);
    for (std::size_t c = 0; c < planes.size(); ++c) {
      const auto begin = planes[c].begin() + first * width;
      block[c].assign(begin, begin + rows * width);
    }
    if (!image.append(image.encode({first, rows, block}))) return image.problem();
  }
  return image.finish();
}

std::unique_ptr<ImageWriter> open_image(const std::string& file, const ImageHeader& header,
                                        std::string& problem) {
  switch (header.kind) {
    case ImageKind::exr: return write_exr(file, header, problem);
    case ImageKind::png: return write_png(file, header, problem);
    case ImageKind::tx: break;
  }
  const ImageWriterModule* const module = writer_module(problem);
  return module == nullptr ? nullptr : module->open(file, header, problem);
}

bool prepare_image(const std::string& path, Diagnostics& diagnostics) {
  std::string problem;
  if (path.ends_with(".tx") && writer_module(problem) == nullptr) {
    return write_failed(path, problem, diagnostics);
  }
  return prepare_output(path, diagnostics);
}

}  // namespace nacre::host
