#include "bench/common/material.h"

#include <algorithm>
#include <set>
#include <utility>

#include "bench/common/system.h"
#include "pbs/surface.h"

namespace nacre::bench {

const char* entry_name(Entry entry) {
  switch (entry) {
    case Entry::begin: return "begin";
    case Entry::sample: return "sample";
    case Entry::evaluate: return "evaluate";
    case Entry::albedo: return "albedo";
  }
  return "";
}

const Bodies& bodies() {
  static const Bodies made(shading_system().library().definitions());
  return made;
}

GraphOptions graph_options() { return shading_system().graph_options({}); }

RecordedMaterial::RecordedMaterial()
    : textures_(std::make_shared<RecordedTextures>(store_, recorder_, diagnostics_)) {}

std::unique_ptr<RecordedMaterial> RecordedMaterial::record(const Graph& graph, Accuracy accuracy,
                                                           ParameterMode parameters,
                                                           std::string& error,
                                                           Compensation compensation) {
  std::unique_ptr<RecordedMaterial> made(new RecordedMaterial());
  const RecordOptions options{.accuracy = accuracy,
                              .parameters = parameters,
                              .textures = made->textures_.get(),
                              .resolve_file = {}};
  const auto values = record_graph(graph, bodies(), options, made->recorder_, made->diagnostics_);
  const auto output = std::ranges::find(graph.outputs, Type::surfaceshader, &GraphOutput::type);
  SurfacePtr surface;
  if (values && output != graph.outputs.end()) {
    surface =
        as_surface((*values)[static_cast<std::size_t>(output - graph.outputs.begin())].closure);
  }
  if (surface == nullptr) {
    error = "no surface; " + made->diagnostics_.to_string();
    return nullptr;
  }
  KernelRequest request;
  request.compensation = compensation;
  made->kernels_ = record_kernels(made->recorder_, *surface, accuracy, request);
  std::set<std::uint32_t> state;
  for (const Entry entry : {Entry::sample, Entry::evaluate}) {
    for (const std::uint32_t k : state_channels(made->program(entry))) state.insert(k);
  }
  made->state_.assign(state.begin(), state.end());
  return made;
}

Program RecordedMaterial::program(Entry entry) {
  const Program& recorded = recorder_.program();
  switch (entry) {
    case Entry::begin: return slice(recorded, "begin", state_outputs(recorder_, state_));
    case Entry::sample: return slice(recorded, "sample", kernels_.sample, Keeps::load);
    case Entry::evaluate: return slice(recorded, "evaluate", kernels_.evaluate, Keeps::load);
    case Entry::albedo: return slice(recorded, "albedo", kernels_.albedo);
  }
  return {};
}

std::unique_ptr<KernelRun> run_material(const Graph& graph, ParameterMode parameters, Entry entry,
                                        const CompileOptions& options, std::string& error,
                                        Compensation compensation) {
  const std::shared_ptr<RecordedMaterial> material =
      RecordedMaterial::record(graph, options.accuracy, parameters, error, compensation);
  if (material == nullptr) return nullptr;
  const auto make = [&](Entry wanted, const Columns& given) -> std::unique_ptr<KernelRun> {
    if (wanted == Entry::begin && material->state().empty()) {
      error = "nothing to do";
      return nullptr;
    }
    Diagnostics diagnostics;
    auto kernel = compile(material->program(wanted), options, &compile_service(), diagnostics);
    error = diagnostics.to_string();
    if (kernel == nullptr) return nullptr;
    auto run = std::make_unique<KernelRun>(BoundKernel(std::move(kernel), material->textures()),
                                           given, material);
    run->counters["state_bytes"] = 4.0 * static_cast<double>(material->state().size());
    run->counters["instructions"] = static_cast<double>(run->program().entry().code.size());
    return run;
  };
  if (entry == Entry::begin || entry == Entry::albedo) return make(entry, {});
  Columns state;
  if (!material->state().empty()) {
    const auto begin = make(Entry::begin, {});
    if (begin == nullptr) return nullptr;
    (*begin)();
    state = begin->raw_results();
  }
  return make(entry, state);
}

}  // namespace nacre::bench
