// What of a recording each kernel of a material computes.
#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "jit/record/leaves.h"
#include "jit/record/text_lobe.h"
#include "jit/shading/compilation.h"
#include "pbs/shader_channels.h"
#include "pbs/sides.h"
#include "runtime/channel/channel_name.h"
#include "runtime/program/fix_inputs.h"
#include "runtime/program/stand_in.h"

namespace nacre {

namespace {

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

/// The kernels of a material that are no surface's.
struct OtherKernel {
  Type type;
  KernelEntry entry;
  const char* name;
  std::optional<BoundKernel> MaterialKernels::* place;
};
constexpr OtherKernel other_kernels[] = {
    {Type::displacementshader, entry_displacement, "displacement", &MaterialKernels::displacement},
    {Type::lightshader, entry_light, "light", &MaterialKernels::light},
    {Type::volumeshader, entry_volume, "volume", &MaterialKernels::volume}};

/// The results of `shade`: those of evaluate, and of sample by names that say whose they are.
std::vector<SliceOutput> shade_results(const SurfaceKernels& kernels) {
  std::vector<SliceOutput> results = kernels.evaluate;
  for (SliceOutput result : kernels.sample) {
    const bool is_plain = result.name == "lobe" || result.name == "flags";
    if (!is_plain) result.name = "next." + result.name;
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<SliceOutput> joined(std::vector<SliceOutput> first,
                                const std::vector<SliceOutput>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

std::optional<Compilation::RecordedMaterial> Compilation::record_material(
    const Graph& graph, const SourceLocation& where) {
  const auto has = [&](Type type) {
    return std::ranges::any_of(graph.outputs,
                               [&](const GraphOutput& output) { return output.type == type; });
  };
  if (!has(Type::surfaceshader) && !has(Type::volumeshader) && !has(Type::displacementshader) &&
      !has(Type::lightshader)) {
    diagnostics_.error("no-surface", where, "the material has no shader",
                       "a surface, volume, displacement or light shader");
    return std::nullopt;
  }
  const auto values = record(graph);
  if (!values) return std::nullopt;
  const SurfaceSides sides = sides_of(graph, *values, diagnostics_);
  const bool is_back = options_.side == Side::back && sides.back != nullptr;
  const SurfacePtr surface = is_back ? sides.back : sides.front;
  if (surface == nullptr && has(Type::surfaceshader)) {
    diagnostics_.error("no-surface", where, "the material's surface shader is not connected",
                       "a surface shader");
    return std::nullopt;
  }
  const SurfaceKernels surface_kernels = record_surface(surface);
  if (!surface_kernels.complete) return std::nullopt;
  RecordedMaterial recorded;
  MaterialKernels& kernels = recorded.kernels;
  kernels.has_surface = surface != nullptr;
  kernels.has_light = has(Type::lightshader);
  kernels.has_volume = has(Type::volumeshader);
  kernels.has_back = sides.back != nullptr;
  kernels.lobes = surface_kernels.lobes;
  kernels.manifest = surface_kernels.manifest;
  std::ranges::copy(textures_->uniform_texels(), std::back_inserter(kernels.manifest));
  kernels.not_modelled = surface_kernels.not_modelled;
  const std::size_t errors = diagnostics_.error_count();
  const std::vector<SliceOutput> point = point_results(graph, *values, surface_kernels, where);
  if (diagnostics_.error_count() != errors) return std::nullopt;
  std::set<std::uint32_t> state;
  const auto add = [&](std::optional<BoundKernel> MaterialKernels::* place, Program program) {
    for (const std::uint32_t k : state_channels(program)) state.insert(k);
    recorded.programs.push_back(std::move(program));
    recorded.places.push_back(place);
  };
  const auto wants = [&](KernelEntry entry) { return (options_.kernels.entries & entry) != 0; };
  const auto add_entry = [&](std::optional<BoundKernel> MaterialKernels::* place, const char* name,
                             const std::vector<SliceOutput>& outputs, Keeps keeps) {
    if (!outputs.empty()) add(place, slice(recorder_.program(), name, outputs, keeps));
  };
  // What triangles share is displaced alike, and paths need media that are the same where they come
  // in and go out: these see no drawn texels.
  const auto add_whole = [&](std::optional<BoundKernel> MaterialKernels::* place, const char* name,
                             const std::vector<SliceOutput>& outputs) {
    if (outputs.empty()) return;
    add(place, with_stand_ins(slice(recorder_.program(), name, outputs, Keeps::pass), 1));
  };
  if (wants(entry_sample)) {
    add_entry(&MaterialKernels::sample, "sample", surface_kernels.sample, Keeps::load);
  }
  if (wants(entry_evaluate)) {
    add_entry(&MaterialKernels::evaluate, "evaluate", surface_kernels.evaluate, Keeps::load);
  }
  if (wants(entry_evaluate_at) && !surface_kernels.evaluate.empty()) {
    const auto is_of_point = [](std::string_view channel) { return !channel.starts_with("wi."); };
    const Program evaluate =
        slice(recorder_.program(), "evaluate_at", surface_kernels.evaluate, Keeps::load);
    std::ranges::copy_if(evaluate.inputs, std::back_inserter(kernels.of_point),
                         [&](const Channel& input) { return is_of_point(input.name); });
    for (const std::uint32_t k : state_channels(evaluate)) state.insert(k);
    add(&MaterialKernels::evaluate_at, fix_inputs(evaluate, is_of_point));
  }
  kernels.state.assign(state.begin(), state.end());
  add_entry(&MaterialKernels::albedo, "albedo", surface_kernels.albedo, Keeps::pass);
  add_entry(&MaterialKernels::emission, "emission", surface_kernels.emission, Keeps::pass);
  add_entry(&MaterialKernels::opacity, "opacity", surface_kernels.opacity, Keeps::pass);
  add_whole(&MaterialKernels::interior, "interior", surface_kernels.interior);
  add_whole(&MaterialKernels::subsurface, "subsurface", surface_kernels.subsurface);
  add_entry(&MaterialKernels::shadow, "shadow", surface_kernels.shadow, Keeps::pass);
  add_entry(&MaterialKernels::emit, "emit", surface_kernels.emit, Keeps::pass);
  for (const Recorded& value : *values) {
    const auto found = std::ranges::find(other_kernels, value.type, &OtherKernel::type);
    if (found == std::end(other_kernels) || !wants(found->entry)) continue;
    const auto list = shader_channels(recorder_, options_.compile.accuracy, value);
    if (all_zero(list)) {
      kernels.manifest.push_back(std::string(found->name) + ": always nothing");
      continue;
    }
    add_whole(found->place, found->name, list);
    const Program& made = recorded.programs.back();
    if (found->type == Type::displacementshader) {
      kernels.recorded_displacement = std::make_shared<const Program>(made);
    }
  }
  // The state has no place in a call that asks everything at once.
  if (wants(entry_shade)) {
    add_entry(&MaterialKernels::shade, "shade", joined(shade_results(surface_kernels), point),
              Keeps::pass);
  }
  std::vector<SliceOutput> begin = state_outputs(recorder_, kernels.state);
  if (wants(entry_begin) || !begin.empty()) begin = joined(std::move(begin), point);
  add_entry(&MaterialKernels::begin, "begin", begin, Keeps::pass);
  return recorded;
}

SurfaceKernels Compilation::record_surface(const SurfacePtr& surface) {
  SurfaceKernels kernels;
  if (surface == nullptr) return kernels;
  try {
    return record_kernels(recorder_, *surface, options_.compile.accuracy, options_.kernels,
                          [this] { return may_go_on(); });
  } catch (const LobeFailure&) {
    kernels.complete = false;
    return kernels;
  }
}

std::vector<SliceOutput> Compilation::point_results(const Graph& graph,
                                                    const std::vector<Recorded>& values,
                                                    const SurfaceKernels& kernels,
                                                    const SourceLocation& where) {
  std::vector<SliceOutput> results = kernels.point;
  const auto stores = [&](std::string_view name) {
    return std::ranges::any_of(results, [&](const SliceOutput& result) {
      return parse_channel(result.name).group == name;
    });
  };
  for (const std::string& name : options_.kernels.with_begin) {
    if (stores(name)) continue;  // Of the surface, or named twice.
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (graph.outputs[i].name != name || !is_numeric(values[i].type)) continue;
      results = joined(std::move(results), channels_of(name, values[i]));
      break;
    }
    if (stores(name)) continue;
    diagnostics_.error("unknown-request", where, "the material has no such result of a point",
                       "one of its surface, or a value of its graph", "'" + name + "'");
  }
  return results;
}

}  // namespace nacre
