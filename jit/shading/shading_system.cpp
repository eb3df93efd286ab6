#include "jit/shading/shading_system.h"

#include <algorithm>
#include <set>
#include <utility>

#include "jit/document/select.h"
#include "jit/graph/check.h"
#include "jit/graph/find.h"
#include "jit/graph/node_source.h"
#include "jit/ocio/ocio_config.h"
#include "jit/record/source_bodies.h"
#include "jit/record/textures.h"
#include "jit/service/compile_service.h"
#include "jit/shading/find_image.h"
#include "pbs/shader_channels.h"
#include "pbs/sides.h"
#include "runtime/float_environment.h"
#include "runtime/program/fix_inputs.h"
#include "runtime/program/slice.h"

namespace nacre {

namespace {

namespace fs = std::filesystem;

/// The options of a call that begins now: how long it may take becomes when it must end.
ShaderOptions from_now(const ShaderOptions& options) {
  ShaderOptions result = options;
  result.compile.stop = stop_from_now(options.compile);
  return result;
}

/// One graph being made into kernels.
class Compilation {
 public:
  Compilation(const ShaderOptions& options, const Bodies& bodies, SourceBodies& sources,
              TextureStore& store, CompileService* service, Diagnostics& diagnostics)
      : options_(options),
        bodies_(bodies),
        sources_(sources),
        service_(service),
        diagnostics_(diagnostics),
        textures_(std::make_shared<RecordedTextures>(store, recorder_, diagnostics,
                                                     options.max_anisotropy)) {}

  std::optional<std::vector<Recorded>> record(const Graph& graph) {
    const FileRoots roots = options_.files_anywhere
                                ? FileRoots{}
                                : image_roots(graph, options_.search_paths, sources_.roots());
    textures_->give_access(image_access(roots, options_.missing_images, options_.compile.stop));
    const RecordOptions record{
        .accuracy = options_.compile.accuracy,
        .parameters = options_.parameters,
        .textures = textures_.get(),
        .sources = &sources_,
        .lazy = options_.lazy,
        .before_node = [this](const GraphNode& node) { textures_->asked_by(node.where); },
        .max_instructions = options_.compile.max_instructions,
        .resolve_file =
            [&](const std::string& name, const std::string& document) {
              return find_image(name, document, options_.search_paths, roots);
            },
        .stop = options_.compile.stop};
    return record_graph(graph, bodies_, record, recorder_, diagnostics_);
  }

  /// What depends on `outputs`.
  Program entry(const char* name, const std::vector<SliceOutput>& outputs, Keeps keeps) const {
    return slice(recorder_.program(), name, outputs, keeps);
  }

  /// All entry points side by side; nothing where the compiler refuses.
  std::vector<std::optional<BoundKernel>> compile(std::vector<Program> programs,
                                                  std::vector<StageReport>& stages) {
    std::vector<std::string> names;
    for (const Program& program : programs) names.push_back(program.name);
    std::vector<std::vector<StageReport>> reports;
    auto compiled =
        compile_all(std::move(programs), options_.compile, service_, diagnostics_, &reports);
    std::vector<std::optional<BoundKernel>> kernels(compiled.size());
    for (std::size_t i = 0; i < compiled.size(); ++i) {
      for (StageReport& report : reports[i]) {
        report.name = names[i] + ": " + report.name;
        stages.push_back(std::move(report));
      }
      if (compiled[i] != nullptr) kernels[i].emplace(std::move(compiled[i]), textures_);
    }
    return kernels;
  }

  Recorder& recorder() { return recorder_; }
  std::size_t image_errors() const { return textures_->error_count(); }

 private:
  const ShaderOptions& options_;
  const Bodies& bodies_;
  SourceBodies& sources_;
  CompileService* service_;
  Diagnostics& diagnostics_;
  Recorder recorder_;
  std::shared_ptr<RecordedTextures> textures_;
};

/// Where a node pack's texts may include from: the library folders.
std::vector<fs::path> source_roots(const std::vector<fs::path>& libraries) {
  std::vector<fs::path> roots;
  std::error_code ignored;
  for (const fs::path& path : libraries) {
    roots.push_back(fs::is_directory(path, ignored) ? path : path.parent_path());
  }
  return roots;
}

std::vector<SliceOutput> channels(const std::string& name, const Recorded& value) {
  std::vector<SliceOutput> list;
  const int count = component_count(value.type);
  for (int i = 0; i < count; ++i) {
    list.push_back({slot_name(name, i, count), value.parts[static_cast<std::size_t>(i)]});
  }
  return list;
}

/// The sides of the material that a graph is of. Reports a back that is not shown.
SurfaceSides sides_of(const Graph& graph, const std::vector<Recorded>& values,
                      Diagnostics& diagnostics) {
  SurfacePtr front;
  SurfacePtr back;
  const GraphOutput* back_output = nullptr;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const GraphOutput& output = graph.outputs[i];
    if (output.type != Type::surfaceshader) continue;
    if (output.name == "backsurfaceshader") {
      back = as_surface(values[i].closure);
      back_output = &output;
    } else if (front == nullptr) {
      front = as_surface(values[i].closure);
    }
  }
  const bool two_shaders = front != nullptr && back != nullptr && front != back;
  SurfaceSides sides = surface_sides(std::move(front), std::move(back));
  if (two_shaders && sides.back == nullptr) {
    const bool is_node = back_output->source.kind == Source::Kind::link;
    diagnostics.warning("back-not-shown",
                        is_node ? graph.nodes[back_output->source.node].where : SourceLocation{},
                        "the backsurfaceshader is not shown, for neither side is thin-walled",
                        "a thin-walled surface on one of the sides");
  }
  return sides;
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

void ShadingSystem::check(const Document& document, const ShaderOptions& asked,
                          Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const ShaderOptions options = from_now(asked);
  if (!check_document(document, *library_, graph_options(options), diagnostics)) return;
  Diagnostics known;
  const Definitions definitions(document, &library_->definitions(), known);
  for (const NodeDef* def : definitions.all()) {
    const Element* source = definitions.source_of(*def);
    if (source == nullptr || &source->document() != &document || !may_be_source(*def)) continue;
    sources_->check(node_source(*def, *source), *def, diagnostics);
  }
  // What only recording finds: images that cannot be read, nodes without a body.
  const auto try_recording = [&](const GraphRequest& request) {
    Diagnostics already_known;
    const auto graph = build(document, request, options, already_known);
    if (!graph) return;
    Compilation(options, *bodies_, *sources_, *textures_, service_.get(), diagnostics)
        .record(*graph);
  };
  // All at once, so that what they share is recorded once. A material that names its
  // shader node adds that; those that name graphs come one by one.
  GraphRequest all;
  std::set<std::string> shaders;
  for (const FoundOutput& output : find_outputs(document)) {
    if (output.type != Type::material) all.outputs.push_back(output.name);
  }
  std::vector<std::string> others;
  for (const FoundMaterial& material : find_materials(document)) {
    bool is_simple = true;
    for (const std::string* shader : {&material.surfaceshader, &material.backsurfaceshader,
                                      &material.displacementshader, &material.volumeshader}) {
      if (shader->empty()) continue;
      const Element* element = document.root().child(*shader);
      const bool is_plain = element != nullptr && is_node(*element);
      is_simple = is_simple && is_plain;
      if (is_plain && shaders.insert(*shader).second) all.outputs.push_back(*shader);
    }
    if (!is_simple) others.push_back(material.name);
  }
  try_recording(all);
  for (const std::string& material : others) try_recording({.outputs = {}, .material = material});
  for (const FoundMaterial& material : find_materials(document)) {
    if (material.surfaceshader.empty() || material.backsurfaceshader.empty()) continue;
    check_sides(document, material.name, options, diagnostics);
  }
}

void ShadingSystem::check_sides(const Document& document, const std::string& material,
                                const ShaderOptions& options, Diagnostics& diagnostics) {
  Diagnostics already_known;
  const auto graph = build(document, {.outputs = {}, .material = material}, options, already_known);
  if (!graph) return;
  Compilation compilation(options, *bodies_, *sources_, *textures_, service_.get(), already_known);
  if (const auto values = compilation.record(*graph)) sides_of(*graph, *values, diagnostics);
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
  const auto values = compilation.record(graph);
  if (!values) return nullptr;
  std::vector<SliceOutput> slices;
  std::vector<OutputKernel::Output> outputs;
  for (std::size_t i = 0; i < values->size(); ++i) {
    const Recorded& value = (*values)[i];
    const std::string& name = graph.outputs[i].name;
    std::vector<SliceOutput> list =
        is_numeric(value.type)
            ? channels(name, value)
            : shader_channels(compilation.recorder(), options.compile.accuracy, value);
    if (!is_numeric(value.type)) {
      for (SliceOutput& channel : list) channel.name = name + '.' + channel.name;
    }
    if (list.empty()) {
      diagnostics.error("not-numeric", {}, "output '" + name + "' has no numbers",
                        "a numeric type, a medium, displacement or light",
                        std::string(type_name(value.type)));
      return nullptr;
    }
    outputs.push_back({name, value.type, slices.size(), list.size()});
    std::ranges::move(list, std::back_inserter(slices));
  }
  std::vector<StageReport> stages;
  auto kernel = std::move(
      compilation.compile({compilation.entry("outputs", slices, Keeps::pass)}, stages)[0]);
  if (!kernel) return nullptr;
  return std::make_unique<OutputKernel>(
      OutputKernel{std::move(*kernel), std::move(outputs), std::move(stages)});
}

std::unique_ptr<MaterialKernels> ShadingSystem::compile_material(const Document& document,
                                                                 const std::string& material,
                                                                 const ShaderOptions& asked,
                                                                 Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const ShaderOptions options = from_now(asked);
  const auto graph = build(document, {.outputs = {}, .material = material}, options, diagnostics);
  return graph ? compile_material(*graph, options, diagnostics) : nullptr;
}

std::unique_ptr<MaterialKernels> ShadingSystem::compile_material(const Graph& graph,
                                                                 const ShaderOptions& asked,
                                                                 Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  const ShaderOptions options = from_now(asked);
  const std::size_t errors = diagnostics.error_count();
  const auto has = [&](Type type) {
    return std::ranges::any_of(graph.outputs,
                               [&](const GraphOutput& output) { return output.type == type; });
  };
  if (!has(Type::surfaceshader) && !has(Type::volumeshader)) {
    diagnostics.error("no-surface", {}, "the material has no surface shader");
    return nullptr;
  }
  Compilation compilation(options, *bodies_, *sources_, *textures_, service_.get(), diagnostics);
  const auto values = compilation.record(graph);
  if (!values) return nullptr;
  const SurfaceSides sides = sides_of(graph, *values, diagnostics);
  const bool is_back = options.side == Side::back && sides.back != nullptr;
  const SurfacePtr surface = is_back ? sides.back : sides.front;
  if (surface == nullptr && has(Type::surfaceshader)) {
    diagnostics.error("no-surface", {}, "the material's surface shader is not connected");
    return nullptr;
  }
  const SurfaceKernels recorded = surface == nullptr
                                      ? SurfaceKernels{}
                                      : record_kernels(compilation.recorder(), *surface,
                                                       options.compile.accuracy, options.kernels);
  auto kernels = std::make_unique<MaterialKernels>();
  kernels->has_surface = surface != nullptr;
  kernels->has_back = sides.back != nullptr;
  std::vector<Program> programs;
  std::vector<std::optional<BoundKernel>*> places;
  std::set<std::uint32_t> state;
  const auto add = [&](std::optional<BoundKernel>& place, Program program) {
    for (const std::uint32_t k : state_channels(program)) state.insert(k);
    programs.push_back(std::move(program));
    places.push_back(&place);
  };
  const auto add_entry = [&](std::optional<BoundKernel>& place, const char* name,
                             const std::vector<SliceOutput>& outputs, Keeps keeps) {
    if (!outputs.empty()) add(place, compilation.entry(name, outputs, keeps));
  };
  add_entry(kernels->sample, "sample", recorded.sample, Keeps::load);
  add_entry(kernels->evaluate, "evaluate", recorded.evaluate, Keeps::load);
  kernels->state.assign(state.begin(), state.end());
  if (options.kernels.evaluate_at && !recorded.evaluate.empty()) {
    const auto is_of_point = [](std::string_view channel) { return !channel.starts_with("wi."); };
    add(kernels->evaluate_at,
        fix_inputs(compilation.entry("evaluate_at", recorded.evaluate, Keeps::load), is_of_point));
  }
  add_entry(kernels->albedo, "albedo", recorded.albedo, Keeps::pass);
  add_entry(kernels->emission, "emission", recorded.emission, Keeps::pass);
  add_entry(kernels->opacity, "opacity", recorded.opacity, Keeps::pass);
  for (const Recorded& value : *values) {
    const bool is_displacement = value.type == Type::displacementshader;
    if (!is_displacement && value.type != Type::volumeshader) continue;
    add_entry(is_displacement ? kernels->displacement : kernels->volume,
              is_displacement ? "displacement" : "volume",
              shader_channels(compilation.recorder(), options.compile.accuracy, value),
              Keeps::pass);
  }
  add_entry(kernels->begin, "begin", state_outputs(compilation.recorder(), kernels->state),
            Keeps::pass);
  auto compiled = compilation.compile(std::move(programs), kernels->stages);
  for (std::size_t i = 0; i < compiled.size(); ++i) *places[i] = std::move(compiled[i]);
  kernels->lobes = recorded.lobes;
  kernels->manifest = recorded.manifest;
  if (diagnostics.error_count() != errors + compilation.image_errors()) return nullptr;
  return kernels;
}

}  // namespace nacre
