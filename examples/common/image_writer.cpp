#include "examples/common/image_writer.h"

#include "examples/common/atomic_file.h"

namespace nacre::host {

namespace {

/// Null, with the reason, where no images are written.
const ImageWriterModule* writer_module(std::string& problem) {
  if (!NACRE_WITH_OPENIMAGEIO) {
    problem = "this build of Nacre writes no images (NACRE_WITH_OPENIMAGEIO=OFF)";
    return nullptr;
  }
  ModuleFault fault;
  const ModuleHead* const module = open_module("nacre_image_writer", fault);
  if (module == nullptr) problem = "no " + fault.expected + ": " + fault.found;
  return static_cast<const ImageWriterModule*>(module);
}

}  // namespace

std::unique_ptr<ImageWriter> open_image(const std::string& file, const ImageHeader& header,
                                        std::string& problem) {
  const ImageWriterModule* const module = writer_module(problem);
  return module == nullptr ? nullptr : module->open(file, header, problem);
}

bool prepare_image(const std::string& path, Diagnostics& diagnostics) {
  std::string problem;
  if (writer_module(problem) == nullptr) return write_failed(path, problem, diagnostics);
  return prepare_output(path, diagnostics);
}

}  // namespace nacre::host
