#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "bench/common/benchmarks.h"
#include "bench/common/material.h"
#include "bench/common/system.h"
#include "jit/graph/builder.h"

namespace nacre::bench {

namespace {

/// Where an input of the type can be read from the points; empty if nowhere.
std::string property_nodedef(Type type) {
  const std::string name = "ND_geompropvalue_" + std::string(type_name(type));
  return shading_system().library().definitions().nodedef(name) != nullptr ? name : std::string();
}

/// Numbers in, numbers out; images have a program of their own.
bool is_measured(const NodeDef& def) {
  const auto numeric = [](const auto& port) { return component_count(port.type) > 0; };
  const auto is_file = [](const auto& port) { return port.type == Type::filename; };
  return bodies().contains(def.name) && std::ranges::all_of(def.outputs, numeric) &&
         std::ranges::none_of(def.inputs, is_file);
}

/// The more components the better it stands for its category.
int rank(const NodeDef& def) {
  return def.outputs.front().type == Type::color3    ? 100
         : def.outputs.front().type == Type::vector3 ? 90
                                                     : component_count(def.outputs.front().type);
}

/// The node with every number varying but for what must be the same everywhere.
std::shared_ptr<const Graph> node_graph(const NodeDef& def, std::string& error) {
  GraphBuilder builder(shading_system().library());
  const auto node = builder.add_node(def.name, "node");
  for (const NodeDefInput& input : def.inputs) {
    const std::string source = property_nodedef(input.type);
    const bool is_number = component_count(input.type) > 0 && input.type != Type::integer;
    if (input.uniform || !is_number || source.empty() || !input.defaultgeomprop.empty()) continue;
    const std::string name(input.name);
    const auto value = builder.add_node(source, name);
    builder.set(value, "geomprop", {Type::string, {}, {}, {name}});
    builder.connect(node, name, value);
  }
  for (const NodeDefOutput& output : def.outputs) {
    builder.output(std::string(output.name), node, output.name);
  }
  Diagnostics diagnostics;
  auto graph = builder.finish(graph_options(), diagnostics);
  if (graph) return std::make_shared<Graph>(std::move(*graph));
  error = diagnostics.to_string();
  return nullptr;
}

void register_node(const NodeDef& def) {
  const auto make = [&def](const CompileOptions& options,
                           std::string& error) -> std::unique_ptr<KernelRun> {
    const auto graph = node_graph(def, error);
    if (graph == nullptr) return nullptr;
    ShaderOptions shader;
    shader.compile = options;
    Diagnostics diagnostics;
    const auto made = shading_system().compile_outputs(*graph, shader, diagnostics);
    if (made == nullptr) {
      error = diagnostics.to_string();
      return nullptr;
    }
    return std::make_unique<KernelRun>(made->kernel);
  };
  register_kernel(fmt::format("nodes/{}/{}", def.category, def.name.substr(3)), quick_variants(),
                  make);
}

}  // namespace

/// One nodedef of each category; all of them with NACRE_BENCH_ALL set.
void register_benchmarks() {
  const bool all = std::getenv("NACRE_BENCH_ALL") != nullptr;
  std::map<std::string_view, const NodeDef*> chosen;
  for (const NodeDef* def : shading_system().library().definitions().all()) {
    if (!is_measured(*def)) continue;
    const NodeDef*& best = chosen[all ? def->name : std::string_view(def->category)];
    if (best == nullptr || rank(*def) > rank(*best)) best = def;
  }
  for (const auto& [name, def] : chosen) register_node(*def);
}

}  // namespace nacre::bench
