#include "runtime/texture/image_module.h"

#include "runtime/texture/image_format.h"

namespace nacre {

const ImageModule* image_module(const std::string& path, Diagnostic& error) {
  if (!NACRE_WITH_OPENIMAGEIO) {
    error = image_error("no-image-reader", path, "this build of Nacre reads no images but JPEG",
                        "one with OpenImageIO", "NACRE_WITH_OPENIMAGEIO=OFF");
    return nullptr;
  }
  ModuleFault fault;
  const ModuleHead* const module = open_module("nacre_images", fault);
  if (module == nullptr) {
    error = image_error("no-image-reader", path, "what reads images cannot be loaded",
                        std::move(fault.expected), std::move(fault.found));
  }
  return static_cast<const ImageModule*>(module);
}

}  // namespace nacre
