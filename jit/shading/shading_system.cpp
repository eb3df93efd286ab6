#include "jit/shading/shading_system.h"

#include <utility>

#include "jit/graph/find.h"
#include "jit/ocio/ocio_config.h"
#include "jit/record/source_bodies.h"
#include "jit/service/compile_service.h"
#include "jit/shading/compilation.h"
#include "runtime/float_environment.h"

namespace nacre {

namespace {

namespace fs = std::filesystem;

/// Where a node pack's texts may include from: the library folders.
std::vector<fs::path> source_roots(const std::vector<fs::path>& libraries) {
  std::vector<fs::path> roots;
  std::error_code ignored;
  for (const fs::path& path : libraries) {
    roots.push_back(fs::is_directory(path, ignored) ? path : path.parent_path());
  }
  return roots;
}

}  // namespace

ShadingSystem::~ShadingSystem() = default;

std::unique_ptr<ShadingSystem> ShadingSystem::create(const SystemOptions& options,
                                                     Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  std::unique_ptr<ShadingSystem> system(new ShadingSystem());
  system->library_ = load_library(options.libraries, diagnostics,
                                  {.read = {}, .standard_sources = options.standard_sources});
  if (system->library_ == nullptr) return nullptr;
  system->bodies_ = std::make_unique<Bodies>(system->library_->definitions());
  for (const HostBody& body : options.bodies) {
    if (system->bodies_->add(body.nodedef, body.record, system->library_->definitions())) continue;
    diagnostics.error("unknown-nodedef", {},
                      "the host has a body for a nodedef that no library declares",
                      "the name of a nodedef", body.nodedef);
    return nullptr;
  }
  system->sources_ = std::make_unique<SourceBodies>(source_roots(options.libraries));
  if (!options.ocio_config.empty()) {
    system->colors_ = load_ocio_config(options.ocio_config, diagnostics);
    if (system->colors_ == nullptr) return nullptr;
  }
  system->textures_ = std::make_unique<TextureStore>(options.textures);
  system->service_ = CompileService::create(
      {.threads = options.compile_threads, .cache = options.cache, .session = {}}, diagnostics);
  return system;
}

std::optional<Graph> ShadingSystem::build(const Document& document, const GraphRequest& request,
                                          const ShaderOptions& options,
                                          Diagnostics& diagnostics) const {
  return build_graph(document, *library_, request, graph_options(options), diagnostics);
}

GraphOptions ShadingSystem::graph_options(const ShaderOptions& options) const {
  GraphOptions result = options.graph;
  result.is_native = [this](std::string_view nodedef) { return bodies_->contains(nodedef); };
  if (result.colors == nullptr) result.colors = colors_;
  result.stop = options.compile.stop;
  return result;
}

std::unique_ptr<OutputKernel> ShadingSystem::compile_outputs(
    const Document& document, const std::vector<std::string>& outputs, const ShaderOptions& asked,
    Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const ShaderOptions options = from_now(asked);
  const auto graph = build(document, {.outputs = outputs, .material = {}}, options, diagnostics);
  return graph ? compile_outputs(*graph, options, diagnostics) : nullptr;
}

std::unique_ptr<OutputKernel> ShadingSystem::compile_outputs(const Graph& graph,
                                                             const ShaderOptions& asked,
                                                             Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const ShaderOptions options = from_now(asked);
  Compilation compilation(options, *bodies_, *sources_, *textures_, service_.get(), diagnostics);
  auto recorded = record_outputs(compilation, graph, options, diagnostics);
  if (!recorded) return nullptr;
  std::vector<StageReport> stages;
  auto kernel = std::move(compilation.compile(
      {compilation.entry("outputs", recorded->channels, Keeps::pass)}, stages)[0]);
  if (!kernel) return nullptr;
  return std::make_unique<OutputKernel>(
      OutputKernel{std::move(*kernel), std::move(recorded->outputs), std::move(stages)});
}

std::unique_ptr<MaterialKernels> ShadingSystem::compile_material(const Document& document,
                                                                 const std::string& material,
                                                                 const ShaderOptions& asked,
                                                                 Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const ShaderOptions options = from_now(asked);
  const auto graph = build(document, {.outputs = {}, .material = material}, options, diagnostics);
  return graph ? make_material(*graph, location_of(document, material), options, diagnostics)
               : nullptr;
}

std::unique_ptr<MaterialKernels> ShadingSystem::compile_material(const Graph& graph,
                                                                 const ShaderOptions& options,
                                                                 Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  return make_material(graph, {}, from_now(options), diagnostics);
}

std::unique_ptr<MaterialKernels> ShadingSystem::make_material(const Graph& graph,
                                                              const SourceLocation& where,
                                                              const ShaderOptions& options,
                                                              Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  Compilation compilation(options, *bodies_, *sources_, *textures_, service_.get(), diagnostics);
  auto recorded = record_material(compilation, graph, options, where, diagnostics);
  if (!recorded) return nullptr;
  auto kernels = std::make_unique<MaterialKernels>(std::move(recorded->kernels));
  auto compiled = compilation.compile(std::move(recorded->programs), kernels->stages);
  for (std::size_t i = 0; i < compiled.size(); ++i) {
    (*kernels).*recorded->places[i] = std::move(compiled[i]);
  }
  if (diagnostics.error_count() != errors + compilation.image_errors()) return nullptr;
  return kernels;
}

}  // namespace nacre
