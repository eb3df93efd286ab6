#include "jit/shading/shading_system.h"

#include <utility>

#include "jit/graph/find.h"
#include "jit/shading/check.h"
#include "jit/shading/compilation.h"
#include "jit/shading/system_parts.h"
#include "jit/shading/variants.h"
#include "runtime/float_environment.h"

namespace nacre {

ShadingSystem::ShadingSystem(std::unique_ptr<SystemParts> parts) : parts_(std::move(parts)) {}

ShadingSystem::~ShadingSystem() = default;

std::unique_ptr<ShadingSystem> ShadingSystem::create(const SystemOptions& options,
                                                     Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  auto parts = SystemParts::create(options, diagnostics);
  if (parts == nullptr) return nullptr;
  return std::unique_ptr<ShadingSystem>(new ShadingSystem(std::move(parts)));
}

const Library& ShadingSystem::library() const { return *parts_->library; }

TextureStore& ShadingSystem::textures() { return *parts_->textures; }

GraphOptions ShadingSystem::graph_options(const ShaderOptions& options) const {
  return parts_->graph_options(options);
}

std::unique_ptr<OutputKernel> ShadingSystem::compile_outputs(
    const Document& document, const std::vector<std::string>& outputs, const ShaderOptions& options,
    Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  Compilation compilation(*parts_, from_now(options), diagnostics);
  const auto graph = compilation.build(document, {.outputs = outputs, .material = {}});
  return graph ? compilation.make_outputs(*graph) : nullptr;
}

std::unique_ptr<OutputKernel> ShadingSystem::compile_outputs(const Graph& graph,
                                                             const ShaderOptions& options,
                                                             Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  return Compilation(*parts_, from_now(options), diagnostics).make_outputs(graph);
}

std::unique_ptr<MaterialKernels> ShadingSystem::compile_material(const Document& document,
                                                                 const std::string& material,
                                                                 const ShaderOptions& options,
                                                                 Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  Compilation compilation(*parts_, from_now(options), diagnostics);
  const auto graph = compilation.build(
      document,
      {.outputs = {}, .material = material, .values = values_of(options.kernels.with_begin)});
  return graph ? compilation.make_material(*graph, location_of(document, material)) : nullptr;
}

std::unique_ptr<MaterialKernels> ShadingSystem::compile_material(const Graph& graph,
                                                                 const ShaderOptions& options,
                                                                 Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  return Compilation(*parts_, from_now(options), diagnostics).make_material(graph, {});
}

std::vector<std::unique_ptr<MaterialKernels>> ShadingSystem::compile_variants(
    const Document& document, const std::string& material, std::span<const ShaderOptions> variants,
    Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  return make_variants(document, material, *parts_, variants, diagnostics);
}

void ShadingSystem::check(const Document& document, const ShaderOptions& options,
                          Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  check_shading(document, *parts_, from_now(options), diagnostics);
}

}  // namespace nacre
