#include "examples/common/image_writer.h"
#include "examples/image_writer/levels.h"
#include "examples/image_writer/streamed_levels.h"

namespace nacre::host {

namespace {

std::unique_ptr<ImageWriter> open(const std::string& file, const ImageHeader& header,
                                  std::string& problem) {
  return is_streamed(header) ? stream_levels(file, header, problem) : write_levels(file, header);
}

}  // namespace

}  // namespace nacre::host

const nacre::ModuleHead* nacre_module() {
  static constexpr nacre::host::ImageWriterModule module{{NACRE_BUILD_KEY, "nacre_image_writer"},
                                                         nacre::host::open};
  return &module;
}
