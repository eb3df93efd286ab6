#include "jit/shading/shading_system.h"

#include <algorithm>
#include <set>
#include <utility>

#include "jit/graph/check.h"
#include "jit/graph/find.h"
#include "jit/record/textures.h"
#include "jit/service/compile_service.h"
#include "runtime/program/fix_inputs.h"
#include "runtime/program/slice.h"

namespace nacre {

namespace {

namespace fs = std::filesystem;

/// An image file as a document names it: beside the document, then on the
/// search paths; the name itself where nothing is found, for the complaint.
std::string find_file(const std::string& name, const std::string& document,
                      const std::vector<fs::path>& search_paths) {
  const fs::path path(name);
  if (path.is_absolute()) return name;
  std::vector<fs::path> folders;
  if (!document.empty()) folders.push_back(fs::path(document).parent_path());
  folders.insert(folders.end(), search_paths.begin(), search_paths.end());
  // A tile pattern names no file: its folder must do.
  const bool is_pattern = name.find('<') != std::string::npos;
  std::error_code ignored;
  for (const fs::path& folder : folders) {
    const fs::path candidate = (folder / path).lexically_normal();
    if (is_pattern ? fs::is_directory(candidate.parent_path().empty() ? fs::path(".")
                                                                      : candidate.parent_path(),
                                      ignored)
                   : fs::exists(candidate, ignored)) {
      return candidate.string();
    }
  }
  return folders.empty() ? name : (folders.front() / path).lexically_normal().string();
}

/// One graph being made into kernels.
class Compilation {
 public:
  Compilation(const ShaderOptions& options, const Bodies& bodies, TextureStore& store,
              CompileService* service, Diagnostics& diagnostics)
      : options_(options),
        bodies_(bodies),
        service_(service),
        diagnostics_(diagnostics),
        textures_(std::make_shared<RecordedTextures>(store, recorder_, diagnostics)) {}

  std::optional<std::vector<Recorded>> record(const Graph& graph) {
    const RecordOptions record{
        .accuracy = options_.compile.accuracy,
        .parameters = options_.parameters,
        .textures = textures_.get(),
        .resolve_file = [this](const std::string& name, const std::string& document) {
          return find_file(name, document, options_.search_paths);
        }};
    return record_graph(graph, bodies_, record, recorder_, diagnostics_);
  }

  /// One entry point; nothing where it has no outputs or the compiler refuses.
  std::optional<BoundKernel> kernel(const char* name, const std::vector<SliceOutput>& outputs,
                                    Keeps keeps, std::vector<StageReport>& stages) {
    if (outputs.empty()) return std::nullopt;
    return finish(name, slice(recorder_.program(), name, outputs, keeps), stages);
  }

  std::optional<BoundKernel> finish(const char* name, Program program,
                                    std::vector<StageReport>& stages) {
    std::vector<StageReport> reports;
    std::shared_ptr<const Kernel> compiled =
        compile(std::move(program), options_.compile, service_, diagnostics_, &reports);
    for (StageReport& report : reports) {
      report.name = std::string(name) + ": " + report.name;
      stages.push_back(std::move(report));
    }
    if (compiled == nullptr) return std::nullopt;
    return BoundKernel(std::move(compiled), textures_);
  }

  Recorder& recorder() { return recorder_; }

 private:
  const ShaderOptions& options_;
  const Bodies& bodies_;
  CompileService* service_;
  Diagnostics& diagnostics_;
  Recorder recorder_;
  std::shared_ptr<RecordedTextures> textures_;
};

std::vector<SliceOutput> channels(const std::string& name, const Recorded& value) {
  std::vector<SliceOutput> list;
  const int count = component_count(value.type);
  for (int i = 0; i < count; ++i) {
    list.push_back({slot_name(name, i, count), value.parts[static_cast<std::size_t>(i)]});
  }
  return list;
}

void keep_union(const std::optional<BoundKernel>& kernel, std::set<std::uint32_t>& state) {
  if (!kernel.has_value()) return;
  for (const std::uint32_t k : state_channels(kernel->program())) state.insert(k);
}

}  // namespace

ShadingSystem::~ShadingSystem() = default;

std::unique_ptr<ShadingSystem> ShadingSystem::create(const SystemOptions& options,
                                                     Diagnostics& diagnostics) {
  std::unique_ptr<ShadingSystem> system(new ShadingSystem());
  system->library_ = load_library(options.libraries, diagnostics);
  if (system->library_ == nullptr) return nullptr;
  system->bodies_ = std::make_unique<Bodies>(system->library_->definitions());
  system->textures_ = std::make_unique<TextureStore>(options.textures);
  system->service_ = CompileService::create(
      {.threads = options.compile_threads, .cache = options.cache}, diagnostics);
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
  return result;
}

void ShadingSystem::check(const Document& document, const ShaderOptions& options,
                          Diagnostics& diagnostics) {
  if (!check_document(document, *library_, graph_options(options), diagnostics)) return;
  // What only recording finds: images that cannot be read, nodes without a body.
  const auto try_recording = [&](const GraphRequest& request) {
    Diagnostics already_known;
    const auto graph = build(document, request, options, already_known);
    if (!graph) return;
    Compilation(options, *bodies_, *textures_, service_.get(), diagnostics).record(*graph);
  };
  for (const FoundOutput& output : find_outputs(document)) {
    try_recording({.outputs = {output.name}, .material = {}});
  }
  for (const FoundMaterial& material : find_materials(document)) {
    try_recording({.outputs = {}, .material = material.name});
  }
}

std::unique_ptr<OutputKernel> ShadingSystem::compile_outputs(
    const Document& document, const std::vector<std::string>& outputs,
    const ShaderOptions& options, Diagnostics& diagnostics) {
  const auto graph = build(document, {.outputs = outputs, .material = {}}, options, diagnostics);
  return graph ? compile_outputs(*graph, options, diagnostics) : nullptr;
}

std::unique_ptr<OutputKernel> ShadingSystem::compile_outputs(const Graph& graph,
                                                             const ShaderOptions& options,
                                                             Diagnostics& diagnostics) {
  Compilation compilation(options, *bodies_, *textures_, service_.get(), diagnostics);
  const auto values = compilation.record(graph);
  if (!values) return nullptr;
  std::vector<SliceOutput> slices;
  std::vector<OutputKernel::Output> outputs;
  for (std::size_t i = 0; i < values->size(); ++i) {
    const Recorded& value = (*values)[i];
    if (!is_numeric(value.type)) {
      diagnostics.error("not-numeric", {}, "output '" + graph.outputs[i].name + "' has no numbers",
                        "a numeric type", std::string(type_name(value.type)));
      return nullptr;
    }
    outputs.push_back({graph.outputs[i].name, value.type, slices.size()});
    for (SliceOutput& channel : channels(graph.outputs[i].name, value)) {
      slices.push_back(std::move(channel));
    }
  }
  std::vector<StageReport> stages;
  auto kernel = compilation.kernel("outputs", slices, Keeps::pass, stages);
  if (!kernel) return nullptr;
  return std::make_unique<OutputKernel>(
      OutputKernel{std::move(*kernel), std::move(outputs), std::move(stages)});
}

std::unique_ptr<MaterialKernels> ShadingSystem::compile_material(const Document& document,
                                                                 const std::string& material,
                                                                 const ShaderOptions& options,
                                                                 Diagnostics& diagnostics) {
  const auto graph = build(document, {.outputs = {}, .material = material}, options, diagnostics);
  return graph ? compile_material(*graph, options, diagnostics) : nullptr;
}

std::unique_ptr<MaterialKernels> ShadingSystem::compile_material(const Graph& graph,
                                                                 const ShaderOptions& options,
                                                                 Diagnostics& diagnostics) {
  const auto found = std::find_if(
      graph.outputs.begin(), graph.outputs.end(),
      [](const GraphOutput& output) { return output.type == Type::surfaceshader; });
  if (found == graph.outputs.end()) {
    diagnostics.error("no-surface", {}, "the material has no surface shader");
    return nullptr;
  }
  Compilation compilation(options, *bodies_, *textures_, service_.get(), diagnostics);
  const auto values = compilation.record(graph);
  if (!values) return nullptr;
  const auto index = static_cast<std::size_t>(found - graph.outputs.begin());
  const SurfacePtr surface = as_surface((*values)[index].closure);
  if (surface == nullptr) {
    diagnostics.error("no-surface", {}, "the material's surface shader is not connected");
    return nullptr;
  }
  const SurfaceKernels recorded = record_kernels(compilation.recorder(), *surface,
                                                 options.compile.accuracy, options.kernels);
  auto kernels = std::make_unique<MaterialKernels>();
  auto& stages = kernels->stages;
  kernels->sample = compilation.kernel("sample", recorded.sample, Keeps::load, stages);
  kernels->evaluate = compilation.kernel("evaluate", recorded.evaluate, Keeps::load, stages);
  if (options.kernels.evaluate_at && !recorded.evaluate.empty()) {
    const Program evaluate =
        slice(compilation.recorder().program(), "evaluate_at", recorded.evaluate, Keeps::load);
    kernels->evaluate_at = compilation.finish(
        "evaluate_at",
        fix_inputs(evaluate, [](std::string_view channel) { return !channel.starts_with("wi."); }),
        stages);
  }
  kernels->albedo = compilation.kernel("albedo", recorded.albedo, Keeps::pass, stages);
  kernels->emission = compilation.kernel("emission", recorded.emission, Keeps::pass, stages);
  kernels->opacity = compilation.kernel("opacity", recorded.opacity, Keeps::pass, stages);
  std::set<std::uint32_t> state;
  keep_union(kernels->sample, state);
  keep_union(kernels->evaluate, state);
  kernels->state.assign(state.begin(), state.end());
  kernels->begin = compilation.kernel("begin", state_outputs(compilation.recorder(), kernels->state),
                                      Keeps::pass, stages);
  kernels->lobes = recorded.lobes;
  kernels->manifest = recorded.manifest;
  if (diagnostics.has_errors()) return nullptr;
  return kernels;
}

}  // namespace nacre
