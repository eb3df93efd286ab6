// What OpenImageIO looks for in mtlx.imageio.so: nothing else is visible (plug_in.map).
#include <nacre/nacre.h>

#include <string>

#include "examples/image_input/graph_input.h"
#include "examples/image_input/output_store.h"

extern "C" {

OIIO_EXPORT extern const int mtlx_imageio_version;
OIIO_EXPORT extern const char* const mtlx_input_extensions[];
OIIO_EXPORT const char* mtlx_imageio_library_version();
OIIO_EXPORT OIIO::ImageInput* mtlx_input_imageio_create();

const int mtlx_imageio_version = OIIO_PLUGIN_VERSION;

const char* const mtlx_input_extensions[] = {"mtlx", "mtlxtex", nullptr};

const char* mtlx_imageio_library_version() {
  static const std::string text = std::string("Nacre ") + nacre_version_text();
  return text.c_str();
}

OIIO::ImageInput* mtlx_input_imageio_create() {
  return new graph_image::GraphInput(graph_image::shared_store());
}
}
