#include "examples/common/image_writer.h"
#include "examples/image_writer/levels.h"
#include "examples/image_writer/rows.h"

namespace nacre::host {

namespace {

std::unique_ptr<ImageWriter> open(const std::string& file, const ImageHeader& header,
                                  std::string& problem) {
  switch (header.kind) {
    case ImageKind::exr: return write_rows(file, "openexr", header, problem);
    case ImageKind::png: return write_rows(file, "png", header, problem);
    case ImageKind::tx: break;
  }
  return write_levels(file, header);
}

}  // namespace

}  // namespace nacre::host

const nacre::ModuleHead* nacre_module() {
  static constexpr nacre::host::ImageWriterModule module{{NACRE_BUILD_KEY, "nacre_image_writer"},
                                                         nacre::host::open};
  return &module;
}
