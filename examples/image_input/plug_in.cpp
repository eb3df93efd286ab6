// What OpenImageIO looks for in mtlx.imageio.so: nothing else is visible (plug_in.map).
#include "examples/image_input/graph_input.h"
#include "examples/image_input/graph_module.h"

extern "C" {

OIIO_EXPORT extern const int mtlx_imageio_version;
OIIO_EXPORT extern const char* const mtlx_input_extensions[];
OIIO_EXPORT const char* mtlx_imageio_library_version();
OIIO_EXPORT OIIO::ImageInput* mtlx_input_imageio_create();

const int mtlx_imageio_version = OIIO_PLUGIN_VERSION;

const char* const mtlx_input_extensions[] = {"mtlx", "mtlxtex", nullptr};

const char* mtlx_imageio_library_version() { return "Nacre " NACRE_PLUG_IN_VERSION; }

OIIO::ImageInput* mtlx_input_imageio_create() {
  return new graph_image::GraphInput(graph_image::open_by_module);
}
}
