#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bench/common/benchmarks.h"
#include "bench/common/material.h"
#include "bench/common/system.h"
#include "jit/graph/build/builder.h"

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

/// uv.x > threshold ? fractal3d : uv.y, so that all points, half of them or none take
/// the expensive side; recorded apart, or for all points as a select.
std::optional<Graph> choice_graph(float threshold) {
  GraphBuilder builder(shading_system().library());
  const auto uv = builder.add_node("ND_texcoord_vector2", "uv");
  const auto parts = builder.add_node("ND_separate2_vector2", "parts");
  const auto noise = builder.add_node("ND_fractal3d_float", "noise");
  const auto choice = builder.add_node("ND_ifgreater_float", "choice");
  builder.connect(parts, "in", uv);
  builder.connect(choice, "value1", parts, "outx");
  builder.set(choice, "value2", {Type::float_, {threshold}, {}, {}});
  builder.connect(choice, "in1", noise);
  builder.connect(choice, "in2", parts, "outy");
  builder.output("out", choice);
  Diagnostics diagnostics;
  return builder.finish(graph_options(), diagnostics);
}

void register_choice(const std::string& name, float threshold, bool lazy) {
  const auto make = [threshold, lazy](const CompileOptions& options,
                                      std::string& error) -> std::unique_ptr<KernelRun> {
    const auto graph = choice_graph(threshold);
    ShaderOptions shader;
    shader.compile = options;
    shader.lazy = lazy;
    Diagnostics diagnostics;
    const auto made =
        graph ? shading_system().compile_outputs(*graph, shader, diagnostics) : nullptr;
    if (made != nullptr) return std::make_unique<KernelRun>(made->kernel);
    error = diagnostics.to_string();
    return nullptr;
  };
  register_kernel(fmt::format("nodes/choice_{}/{}", name, lazy ? "apart" : "both_sides"),
                  quick_variants(), make);
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
  for (const bool lazy : {true, false}) {
    register_choice("none", 2.0f, lazy);
    register_choice("half", 0.5f, lazy);
    register_choice("all", -1.0f, lazy);
  }
}

}  // namespace nacre::bench
