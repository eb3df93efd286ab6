#include "jit/shading/compilation.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "jit/compile/compile.h"
#include "jit/compile/fact_kernel.h"
#include "jit/compile/facts.h"
#include "jit/compile/lower.h"
#include "jit/compile/stages.h"
#include "jit/graph/find.h"
#include "jit/passes/scale_footprints.h"
#include "jit/record/leaves.h"
#include "jit/record/pattern.h"
#include "jit/record/text_bodies.h"
#include "jit/shading/find_image.h"
#include "jit/shading/state_facts.h"
#include "jit/shading/unfit_patterns.h"
#include "pbs/exterior.h"
#include "pbs/shader_channels.h"
#include "runtime/node/drawn_texels.h"
#include "runtime/node/live_anisotropy.h"
#include "runtime/program/drop_footprints.h"
#include "runtime/report_stop.h"

namespace nacre {

std::vector<SliceOutput> channels_of(const std::string& name, const Recorded& value) {
  std::vector<SliceOutput> list;
  const int count = component_count(value.type);
  for (int i = 0; i < count; ++i) {
    list.push_back({slot_name(name, i, count), value.parts[static_cast<std::size_t>(i)]});
  }
  return list;
}

ShaderOptions from_now(const ShaderOptions& options) {
  ShaderOptions result = options;
  result.compile.stop = stop_from_now(options.compile);
  // A pattern may name what nobody wrote.
  result.graph.default_parameters |= !options.live.empty();
  return result;
}

bool has_kernel(Type type) {
  return is_numeric(type) || type == Type::vdf || type == Type::volumeshader ||
         type == Type::displacementshader || type == Type::lightshader;
}

Compilation::Compilation(const SystemParts& parts, ShaderOptions options, Diagnostics& diagnostics)
    : parts_(parts),
      options_(std::move(options)),
      diagnostics_(diagnostics),
      textures_(std::make_shared<RecordedTextures>(*parts.textures, recorder_, diagnostics,
                                                   options_.max_anisotropy)),
      errors_before_(diagnostics.error_count()) {}

std::optional<Graph> Compilation::build(const Document& document, const GraphRequest& request) {
  // Of a parameter of the document another of its materials may be known.
  unfound_facts_ = options_.compile.facts;
  std::erase_if(unfound_facts_, [&](const Fact& fact) {
    const std::size_t slash = fact.name.rfind('/');
    return slash != std::string::npos && find_element(document, fact.name.substr(0, slash));
  });
  document_ = &document;
  return Stages(&stages_).run(
      "graph", [&] { return parts_.build(document, request, options_, diagnostics_); },
      [&](const std::optional<Graph>& graph, StageReport& report) {
        if (!graph) return;
        report.nodes = graph->nodes.size();
        if (options_.compile.keep_text) report.text = to_string(*graph);
      });
}

std::unique_ptr<OutputKernel> Compilation::make_outputs(const Graph& graph) {
  const std::size_t errors = diagnostics_.error_count();
  auto recorded = record_outputs(graph);
  if (!recorded) return nullptr;
  auto kernel = std::move(compile(std::move(recorded->programs)).front());
  if (!kernel || !is_complete(errors)) return nullptr;
  return std::make_unique<OutputKernel>(
      OutputKernel{std::move(*kernel), std::move(recorded->outputs), live_parameters(graph),
                   std::move(facts_), std::move(stages_)});
}

std::unique_ptr<MaterialKernels> Compilation::make_material(const Graph& graph,
                                                            const SourceLocation& where) {
  auto recorded = record_material(graph, where);
  return recorded ? finish(graph, std::move(*recorded)) : nullptr;
}

std::unique_ptr<MaterialKernels> Compilation::finish(const Graph& graph,
                                                     RecordedMaterial recorded) {
  auto kernels = std::make_unique<MaterialKernels>(std::move(recorded.kernels));
  auto compiled = compile(std::move(recorded.programs));
  for (std::size_t i = 0; i < compiled.size(); ++i) {
    (*kernels).*recorded.places[i] = std::move(compiled[i]);
  }
  kernels->parameters = live_parameters(graph);
  kernels->facts = std::move(facts_);
  kernels->stages = std::move(stages_);
  return is_complete(errors_before_) ? std::move(kernels) : nullptr;
}

bool Compilation::is_complete(std::size_t errors_before) const {
  return diagnostics_.error_count() == errors_before + textures_->error_count();
}

RecordOptions Compilation::record_options(const FileRoots& roots) {
  return {.accuracy = options_.compile.accuracy,
          .parameters = options_.parameters,
          .live = options_.live,
          .textures = textures_.get(),
          .texts = parts_.texts.get(),
          .holds_lobes = options_.holds_lobes,
          .lazy = options_.lazy,
          .before_node = [this](const GraphNode& node) { textures_->asked_by(node.where); },
          .fade_noise = options_.fade_noise && options_.footprints,
          .max_instructions = options_.compile.max_instructions,
          .max_steps = options_.compile.max_steps,
          .resolve_file =
              [this, roots](const std::string& name, const std::string& document) {
                return resolve_image(name, document, roots);
              },
          .stop = options_.compile.stop};
}

std::string Compilation::resolve_image(const std::string& name, const std::string& document,
                                       const FileRoots& roots) {
  if (parts_.textures->image(name) != nullptr) return name;
  if (parts_.resolver) {
    const auto given = parts_.resolver(name, document, FileKind::image);
    if (given) return textures_->accept(*given);
  }
  return find_image(name, document, options_.search_paths, roots);
}

std::vector<Parameter> Compilation::live_parameters(const Graph& graph) const {
  RecordOptions options;
  options.parameters = options_.parameters;
  options.live = options_.live;
  std::vector<Parameter> live;
  std::ranges::copy_if(graph.parameters, std::back_inserter(live),
                       [&](const Parameter& each) { return is_live(each, options); });
  return live;
}

bool Compilation::varies(std::string_view slot) const {
  // A pattern of the parameter, or of one of its components.
  return fits_any(std::string(slot), options_.varying) ||
         fits_any(std::string(slot.substr(0, slot.rfind('.'))), options_.varying);
}

std::optional<std::vector<Recorded>> Compilation::record(const Graph& graph) {
  const FileRoots roots = options_.files_anywhere
                              ? FileRoots{}
                              : image_roots(graph, options_.search_paths, parts_.texts->roots());
  ImageAccess access = image_access(roots, options_.missing_images, options_.compile.stop);
  access.defers_tiles = options_.defer_tiles;
  textures_->give_access(std::move(access));
  const RecordOptions options = record_options(roots);
  warn_of_unfit(graph, options);
  if (!options_.varying.empty()) {
    recorder_.vary_parameters([this](std::string_view slot) { return varies(slot); });
  }
  // By their names and no pattern: who varies all parameters need not know what is outside.
  const auto is_named = [&](std::string_view channel) {
    return std::ranges::find(options_.varying, channel) != options_.varying.end();
  };
  if (is_named(exterior_index_channel)) offer_exterior_index(recorder_);
  if (is_named(drawn_texels_channel)) offer_drawn_texels(recorder_);
  // Recorded first, it is a slot that facets read; see pbs/facets.cpp.
  if (options_.kernels.min_alpha) recorder_.parameter("min_alpha", Scalar::f32, 0);
  if (options_.footprints && options_.live_footprints) {
    offer_live_anisotropy(recorder_, textures_->max_anisotropy());
  }
  if (!graph.outputs.empty()) where_ = graph.outputs.front().where;
  return Stages(&stages_).run(
      "record",
      [&] { return record_graph(graph, *parts_.bodies, options, recorder_, diagnostics_); },
      [&](const auto&, StageReport& report) {
        report.instructions = instruction_count(recorder_.program());
      });
}

void Compilation::warn_of_unfit(const Graph& graph, const RecordOptions& options) {
  DocumentInputs document(document_, parts_.library->definitions());
  for (const std::string& pattern : unfit_live(options_.live, graph, document)) {
    diagnostics_.warning("unfit-pattern", {}, "no parameter is live by this pattern",
                         "one of a parameter's path, \"node/input\"", "'" + pattern + "'");
  }
  for (const std::string& pattern : unfit_varying(options_.varying, graph, options, document)) {
    diagnostics_.warning("unfit-pattern", {}, "no parameter comes with the points by this pattern",
                         "one of a live parameter's path, \"node/input\"", "'" + pattern + "'");
  }
}

bool Compilation::may_go_on() {
  if (report_if_due(options_.compile.stop, "recording the kernels", where_, diagnostics_)) {
    return false;
  }
  if (!is_too_large(recorder_.program(), options_.compile)) return true;
  diagnostics_.error("program-too-large", where_, "the surface leads to too large a kernel",
                     fmt::format("{} instructions at most", options_.compile.max_instructions));
  return false;
}

void Compilation::add_located(const Diagnostics& said) {
  for (Diagnostic one : said.all()) {
    if (one.where.file.empty() && one.where.path.empty()) one.where = where_;
    diagnostics_.add(std::move(one));
  }
}

namespace {

/// A slot of an element of the document, which has a path. Those that hosts set beside are others
/// from call to call: of evaluate_at the one point is some.
bool is_of_document(std::string_view slot) {
  return slot.find('/') != std::string_view::npos && !slot.starts_with("geomprop.");
}

}  // namespace

std::vector<std::optional<BoundKernel>> Compilation::compile(std::vector<Program> programs) {
  std::vector<std::string> names;
  for (Program& program : programs) {
    names.push_back(program.name);
    if (!options_.footprints) {
      program = drop_footprints(program);
    } else if (options_.live_footprints) {
      offer_footprint_scale(program, varies("footprint_scale"));
    }
  }
  std::vector<std::vector<StageReport>> reports;
  Diagnostics said;
  CompileOptions options = options_.compile;
  if (options_.fit_parameters) options.fits_slot = is_of_document;
  if (!options.facts.empty() && options.backend == Backend::reference) {
    said.warning("unread-fact", {}, "the reference engine computes as if no facts were known");
  } else {
    warn_of_unread(unfound_facts_, programs, said);
  }
  std::ranges::move(state_facts(programs, options), std::back_inserter(options.facts));
  auto compiled = compile_all(std::move(programs), options, parts_.service.get(), said, &reports);
  add_located(said);
  for (const Fact& fact : options_.compile.facts) facts_.push_back({fact, 0});
  std::vector<std::optional<BoundKernel>> kernels(compiled.size());
  for (std::size_t i = 0; i < compiled.size(); ++i) {
    if (dynamic_cast<const FactKernel*>(compiled[i].get()) != nullptr) add_uses(reports[i]);
    for (StageReport& report : reports[i]) {
      report.name = names[i] + ": " + report.name;
      stages_.push_back(std::move(report));
    }
    if (compiled[i] != nullptr) kernels[i].emplace(std::move(compiled[i]), textures_);
  }
  return kernels;
}

void Compilation::add_uses(const std::vector<StageReport>& reports) {
  const auto decided = std::ranges::find(reports, "decide", &StageReport::name);
  for (FactUse& use : facts_) {
    if (decided == reports.end()) {
      use.saved.reset();
      continue;
    }
    for (const FactUse& part : decided->facts) {
      if (!use.saved || !is_part_of(part.fact, use.fact)) continue;
      use.saved = part.saved ? std::optional(*use.saved + *part.saved) : std::nullopt;
    }
  }
}

void Compilation::try_stages(std::vector<Program> programs) {
  CompileOptions options = options_.compile;
  options.backend = Backend::interpreter;
  Diagnostics said;
  compile_all(std::move(programs), options, nullptr, said);
  add_located(said);
}

std::optional<Compilation::RecordedOutputs> Compilation::record_outputs(const Graph& graph) {
  const auto values = record(graph);
  if (!values) return std::nullopt;
  RecordedOutputs recorded;
  std::vector<SliceOutput> channels;
  for (std::size_t i = 0; i < values->size(); ++i) {
    const Recorded& value = (*values)[i];
    const std::string& name = graph.outputs[i].name;
    std::vector<SliceOutput> list =
        is_numeric(value.type) ? channels_of(name, value)
                               : shader_channels(recorder_, options_.compile.accuracy, value);
    if (!is_numeric(value.type)) {
      for (SliceOutput& channel : list) channel.name = name + '.' + channel.name;
    }
    if (list.empty()) {
      diagnostics_.error(
          "not-numeric", graph.outputs[i].where, "output '" + name + "' has no numbers",
          "a numeric type, a medium, displacement or light", std::string(type_name(value.type)));
      return std::nullopt;
    }
    const Source& source = graph.outputs[i].source;
    const bool is_linked = source.kind == Source::Kind::link;
    recorded.outputs.push_back({name, value.type, channels.size(), list.size(),
                                is_linked ? graph.nodes[source.node].where : SourceLocation{}});
    std::ranges::move(list, std::back_inserter(channels));
  }
  recorded.programs.push_back(slice(recorder_.program(), "outputs", channels, Keeps::pass));
  return recorded;
}

}  // namespace nacre
