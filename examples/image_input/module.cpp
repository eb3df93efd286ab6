// nacre_graphs.so: what the plug-in loads with the first graph.
#include "examples/image_input/graph_module.h"
#include "examples/image_input/open_graph.h"

extern "C" const graph_image::GraphModule* nacre_module();

const graph_image::GraphModule* nacre_module() {
  static constexpr graph_image::GraphModule module{NACRE_BUILD_KEY, graph_image::open_graph};
  return &module;
}
