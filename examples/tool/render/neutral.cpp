#include "examples/tool/render/neutral.h"

#include "jit/graph/build/builder.h"

namespace nacre::tool {

std::unique_ptr<MaterialKernels> neutral_material(ShadingSystem& system,
                                                  const ShaderOptions& options,
                                                  Diagnostics& diagnostics) {
  GraphBuilder builder(system.library());
  const auto diffuse = builder.add_node("ND_oren_nayar_diffuse_bsdf", "neutral/bsdf");
  builder.set(diffuse, "color", {Type::color3, {0.4f, 0.4f, 0.4f}, {}, {}});
  const auto surface = builder.add_node("ND_surface", "neutral");
  builder.connect(surface, "bsdf", diffuse);
  builder.output("surfaceshader", surface);
  const auto graph = builder.finish(system.graph_options(options), diagnostics);
  return graph ? system.compile_material(*graph, options, diagnostics) : nullptr;
}

}  // namespace nacre::tool
