#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bench/common/benchmarks.h"
#include "bench/common/material.h"
#include "bench/common/system.h"
#include "jit/graph/build/builder.h"

namespace nacre::bench {

namespace {

constexpr Tolerance tolerance{.absolute = 1e-4, .relative = 5e-3, .outliers = 0.01};

bool has_type(const NodeDef& def, Type type) {
  return def.outputs.size() == 1 && def.outputs.front().type == type;
}

/// Single lobes: BSDFs that are not made of others.
std::vector<const NodeDef*> lobes() {
  std::vector<const NodeDef*> found;
  for (const NodeDef* def : shading_system().library().definitions().all()) {
    const bool combines = std::ranges::any_of(
        def->inputs, [](const NodeDefInput& input) { return input.type == Type::bsdf; });
    if (has_type(*def, Type::bsdf) && !combines && bodies().contains(def->name)) {
      found.push_back(def);
    }
  }
  return found;
}

/// The strings of an input that choose another closure; one empty string for none.
std::vector<std::string> modes(const NodeDef& def) {
  for (const char* name : {"scatter_mode", "mode"}) {
    const NodeDefInput* input = def.input(name);
    if (input != nullptr) return {input->enums.begin(), input->enums.end()};
  }
  return {""};
}

/// A surface of the lobe alone. Roughness differs from point to point, as from a texture;
/// the rest is as the nodedef has it.
std::shared_ptr<const Graph> lobe_graph(const NodeDef& def, const std::string& mode,
                                        std::string& error) {
  GraphBuilder builder(shading_system().library());
  const auto lobe = builder.add_node(def.name, "lobe");
  if (const NodeDefInput* roughness = def.input("roughness")) {
    const std::string type(type_name(roughness->type));
    const auto varying = builder.add_node("ND_geompropvalue_" + type, "roughness");
    builder.set(varying, "geomprop", {Type::string, {}, {}, {"roughness"}});
    builder.connect(lobe, "roughness", varying);
  }
  if (!mode.empty()) {
    const char* input = def.input("scatter_mode") != nullptr ? "scatter_mode" : "mode";
    builder.set(lobe, input, {Type::string, {}, {}, {mode}});
  }
  const auto surface = builder.add_node("ND_surface", "surface");
  builder.connect(surface, "bsdf", lobe);
  builder.output("surfaceshader", surface);
  Diagnostics diagnostics;
  auto graph = builder.finish(graph_options(), diagnostics);
  if (graph) return std::make_shared<Graph>(std::move(*graph));
  error = diagnostics.to_string();
  return nullptr;
}

void register_lobe(const NodeDef& def, const std::string& mode) {
  const std::string name = mode.empty() ? def.category : def.category + "_" + mode;
  for (const Entry entry : {Entry::begin, Entry::sample, Entry::evaluate, Entry::albedo}) {
    const auto make = [&def, mode, entry](const CompileOptions& options,
                                          std::string& error) -> std::unique_ptr<KernelRun> {
      const auto graph = lobe_graph(def, mode, error);
      if (graph == nullptr) return nullptr;
      return run_material(*graph, ParameterMode::frozen, entry, options, error);
    };
    register_kernel(fmt::format("closures/{}/{}", name, entry_name(entry)), all_variants(), make,
                    tolerance);
  }
}

}  // namespace

void register_benchmarks() {
  for (const NodeDef* def : lobes()) {
    for (const std::string& mode : modes(*def)) register_lobe(*def, mode);
  }
}

}  // namespace nacre::bench
