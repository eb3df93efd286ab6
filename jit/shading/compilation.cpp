#include "jit/shading/compilation.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "jit/record/source_bodies.h"
#include "jit/service/compile_service.h"
#include "jit/shading/find_image.h"
#include "pbs/shader_channels.h"
#include "pbs/sides.h"
#include "runtime/program/fix_inputs.h"
#include "runtime/report_stop.h"

namespace nacre {

namespace {

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

ShaderOptions from_now(const ShaderOptions& options) {
  ShaderOptions result = options;
  result.compile.stop = stop_from_now(options.compile);
  return result;
}

bool has_kernel(Type type) {
  return is_numeric(type) || type == Type::vdf || type == Type::volumeshader ||
         type == Type::displacementshader || type == Type::lightshader;
}

Compilation::Compilation(const ShaderOptions& options, const Bodies& bodies, SourceBodies& sources,
                         TextureStore& store, CompileService* service, Diagnostics& diagnostics)
    : options_(options),
      bodies_(bodies),
      sources_(sources),
      service_(service),
      diagnostics_(diagnostics),
      textures_(std::make_shared<RecordedTextures>(store, recorder_, diagnostics,
                                                   options.max_anisotropy)) {}

std::optional<std::vector<Recorded>> Compilation::record(const Graph& graph) {
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
      .max_steps = options_.compile.max_steps,
      .resolve_file =
          [&](const std::string& name, const std::string& document) {
            return find_image(name, document, options_.search_paths, roots);
          },
      .stop = options_.compile.stop};
  if (!graph.outputs.empty()) where_ = graph.outputs.front().where;
  return record_graph(graph, bodies_, record, recorder_, diagnostics_);
}

bool Compilation::may_go_on() {
  if (report_if_due(options_.compile.stop, "recording the kernels", where_, diagnostics_)) {
    return false;
  }
  std::size_t count = 0;
  for (const Function& function : recorder_.program().functions) count += function.code.size();
  const std::size_t most = options_.compile.max_instructions;
  if (count <= most) return true;
  diagnostics_.error("program-too-large", where_, "the surface leads to too large a kernel",
                     fmt::format("{} instructions at most", most));
  return false;
}

void Compilation::add_located(const Diagnostics& said) {
  for (Diagnostic one : said.all()) {
    if (one.where.file.empty() && one.where.path.empty()) one.where = where_;
    diagnostics_.add(std::move(one));
  }
}

Program Compilation::entry(const char* name, const std::vector<SliceOutput>& outputs,
                           Keeps keeps) const {
  return slice(recorder_.program(), name, outputs, keeps);
}

std::vector<std::optional<BoundKernel>> Compilation::compile(std::vector<Program> programs,
                                                             std::vector<StageReport>& stages) {
  std::vector<std::string> names;
  for (const Program& program : programs) names.push_back(program.name);
  std::vector<std::vector<StageReport>> reports;
  Diagnostics said;
  auto compiled = compile_all(std::move(programs), options_.compile, service_, said, &reports);
  add_located(said);
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

void Compilation::try_stages(std::vector<Program> programs) {
  CompileOptions options = options_.compile;
  options.backend = Backend::interpreter;
  Diagnostics said;
  compile_all(std::move(programs), options, nullptr, said);
  add_located(said);
}

std::optional<RecordedOutputs> record_outputs(Compilation& compilation, const Graph& graph,
                                              const ShaderOptions& options,
                                              Diagnostics& diagnostics) {
  const auto values = compilation.record(graph);
  if (!values) return std::nullopt;
  RecordedOutputs recorded;
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
      diagnostics.error(
          "not-numeric", graph.outputs[i].where, "output '" + name + "' has no numbers",
          "a numeric type, a medium, displacement or light", std::string(type_name(value.type)));
      return std::nullopt;
    }
    const Source& source = graph.outputs[i].source;
    const bool is_linked = source.kind == Source::Kind::link;
    recorded.outputs.push_back({name, value.type, recorded.channels.size(), list.size(),
                                is_linked ? graph.nodes[source.node].where : SourceLocation{}});
    std::ranges::move(list, std::back_inserter(recorded.channels));
  }
  return recorded;
}

std::optional<RecordedMaterial> record_material(Compilation& compilation, const Graph& graph,
                                                const ShaderOptions& options,
                                                const SourceLocation& where,
                                                Diagnostics& diagnostics) {
  const auto has = [&](Type type) {
    return std::ranges::any_of(graph.outputs,
                               [&](const GraphOutput& output) { return output.type == type; });
  };
  if (!has(Type::surfaceshader) && !has(Type::volumeshader) && !has(Type::displacementshader)) {
    diagnostics.error("no-surface", where, "the material has no shader",
                      "a surface, volume or displacement shader");
    return std::nullopt;
  }
  const auto values = compilation.record(graph);
  if (!values) return std::nullopt;
  const SurfaceSides sides = sides_of(graph, *values, diagnostics);
  const bool is_back = options.side == Side::back && sides.back != nullptr;
  const SurfacePtr surface = is_back ? sides.back : sides.front;
  if (surface == nullptr && has(Type::surfaceshader)) {
    diagnostics.error("no-surface", where, "the material's surface shader is not connected",
                      "a surface shader");
    return std::nullopt;
  }
  const SurfaceKernels surface_kernels =
      surface == nullptr
          ? SurfaceKernels{}
          : record_kernels(compilation.recorder(), *surface, options.compile.accuracy,
                           options.kernels, [&] { return compilation.may_go_on(); });
  if (!surface_kernels.complete) return std::nullopt;
  RecordedMaterial recorded;
  MaterialKernels& kernels = recorded.kernels;
  kernels.has_surface = surface != nullptr;
  kernels.has_back = sides.back != nullptr;
  kernels.lobes = surface_kernels.lobes;
  kernels.manifest = surface_kernels.manifest;
  kernels.not_modelled = surface_kernels.not_modelled;
  std::set<std::uint32_t> state;
  const auto add = [&](std::optional<BoundKernel> MaterialKernels::* place, Program program) {
    for (const std::uint32_t k : state_channels(program)) state.insert(k);
    recorded.programs.push_back(std::move(program));
    recorded.places.push_back(place);
  };
  const auto add_entry = [&](std::optional<BoundKernel> MaterialKernels::* place, const char* name,
                             const std::vector<SliceOutput>& outputs, Keeps keeps) {
    if (!outputs.empty()) add(place, compilation.entry(name, outputs, keeps));
  };
  add_entry(&MaterialKernels::sample, "sample", surface_kernels.sample, Keeps::load);
  add_entry(&MaterialKernels::evaluate, "evaluate", surface_kernels.evaluate, Keeps::load);
  kernels.state.assign(state.begin(), state.end());
  if (options.kernels.evaluate_at && !surface_kernels.evaluate.empty()) {
    const auto is_of_point = [](std::string_view channel) { return !channel.starts_with("wi."); };
    add(&MaterialKernels::evaluate_at,
        fix_inputs(compilation.entry("evaluate_at", surface_kernels.evaluate, Keeps::load),
                   is_of_point));
  }
  add_entry(&MaterialKernels::albedo, "albedo", surface_kernels.albedo, Keeps::pass);
  add_entry(&MaterialKernels::emission, "emission", surface_kernels.emission, Keeps::pass);
  add_entry(&MaterialKernels::opacity, "opacity", surface_kernels.opacity, Keeps::pass);
  for (const Recorded& value : *values) {
    const bool is_displacement = value.type == Type::displacementshader;
    if (!is_displacement && value.type != Type::volumeshader) continue;
    const char* name = is_displacement ? "displacement" : "volume";
    const auto list = shader_channels(compilation.recorder(), options.compile.accuracy, value);
    if (all_zero(list)) {
      kernels.manifest.push_back(std::string(name) + ": always nothing");
      continue;
    }
    add_entry(is_displacement ? &MaterialKernels::displacement : &MaterialKernels::volume, name,
              list, Keeps::pass);
  }
  add_entry(&MaterialKernels::begin, "begin", state_outputs(compilation.recorder(), kernels.state),
            Keeps::pass);
  return recorded;
}

}  // namespace nacre
