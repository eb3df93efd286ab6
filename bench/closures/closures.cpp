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

/// One way in which a lobe is timed.
struct Form {
  std::string name;  ///< "dielectric_bsdf_RT_film".
  std::string mode;  ///< Of its input scatter_mode or mode; empty: it has none.
  bool isotropic = false, film = false, beckmann = false;
  bool once = false;  ///< Without what comes back of several scatterings.
};

const char* mode_input(const NodeDef& def) {
  return def.input("scatter_mode") != nullptr ? "scatter_mode" : "mode";
}

/// Where facets have a roughness for each axis, both differ from point to point and from each
/// other, but in the forms that end in "isotropic" or "once".
std::vector<Form> forms(const NodeDef& def) {
  std::vector<std::string> modes{""};
  if (const NodeDefInput* mode = def.input(mode_input(def))) {
    modes.assign(mode->enums.begin(), mode->enums.end());
  }
  const NodeDefInput* roughness = def.input("roughness");
  const bool has_axes = roughness != nullptr && roughness->type == Type::vector2;
  std::vector<Form> found;
  for (const std::string& mode : modes) {
    const std::string name = mode.empty() ? def.category : def.category + "_" + mode;
    found.push_back({.name = name, .mode = mode});
    if (!has_axes) continue;
    found.push_back({.name = name + "_isotropic", .mode = mode, .isotropic = true});
    found.push_back({.name = name + "_once", .mode = mode, .isotropic = true, .once = true});
    if (def.input("thinfilm_thickness") != nullptr && mode != "T") {
      found.push_back(
          {.name = name + "_film_isotropic", .mode = mode, .isotropic = true, .film = true});
    }
    found.push_back(
        {.name = name + "_beckmann_isotropic", .mode = mode, .isotropic = true, .beckmann = true});
  }
  return found;
}

/// The library's nodedefs do not list it: nodes that do have graphs of lobes with it.
void set_beckmann(Graph& graph) {
  for (GraphNode& node : graph.nodes) {
    for (GraphInput& input : node.inputs) {
      if (input.name == "distribution") input.source.value.texts = {"beckmann"};
    }
  }
}

/// A surface of the lobe alone. Roughness differs from point to point, as from a texture;
/// the rest is as the nodedef and the form have it.
std::shared_ptr<const Graph> lobe_graph(const NodeDef& def, const Form& form, std::string& error) {
  GraphBuilder builder(shading_system().library());
  const auto lobe = builder.add_node(def.name, "lobe");
  const auto property = [&](Type type) {
    const auto node =
        builder.add_node("ND_geompropvalue_" + std::string(type_name(type)), "roughness");
    builder.set(node, "geomprop", {Type::string, {}, {}, {"roughness"}});
    return node;
  };
  const NodeDefInput* roughness = def.input("roughness");
  if (form.isotropic) {
    const auto both = builder.add_node("ND_combine2_vector2", "both");
    const auto one = property(Type::float_);
    for (const char* axis : {"in1", "in2"}) builder.connect(both, axis, one);
    builder.connect(lobe, "roughness", both);
  } else if (roughness != nullptr) {
    builder.connect(lobe, "roughness", property(roughness->type));
  }
  if (!form.mode.empty()) {
    builder.set(lobe, mode_input(def), {Type::string, {}, {}, {form.mode}});
  }
  if (form.film) {
    builder.set(lobe, "thinfilm_thickness", {Type::float_, {450.0f}, {}, {}});
    builder.set(lobe, "thinfilm_ior", {Type::float_, {1.35f}, {}, {}});
  }
  const auto surface = builder.add_node("ND_surface", "surface");
  builder.connect(surface, "bsdf", lobe);
  builder.output("surfaceshader", surface);
  Diagnostics diagnostics;
  auto graph = builder.finish(graph_options(), diagnostics);
  if (!graph) {
    error = diagnostics.to_string();
    return nullptr;
  }
  if (form.beckmann) set_beckmann(*graph);
  return std::make_shared<Graph>(std::move(*graph));
}

void register_lobe(const NodeDef& def, const Form& form) {
  for (const Entry entry : {Entry::begin, Entry::sample, Entry::evaluate, Entry::albedo}) {
    const auto make = [&def, form, entry](const CompileOptions& options,
                                          std::string& error) -> std::unique_ptr<KernelRun> {
      const auto graph = lobe_graph(def, form, error);
      if (graph == nullptr) return nullptr;
      return run_material(*graph, ParameterMode::frozen, entry, options, error,
                          form.once ? Compensation::nothing : Compensation::all);
    };
    register_kernel(fmt::format("closures/{}/{}", form.name, entry_name(entry)), all_variants(),
                    make, tolerance);
  }
}

}  // namespace

void register_benchmarks() {
  for (const NodeDef* def : lobes()) {
    for (const Form& form : forms(*def)) register_lobe(*def, form);
  }
}

}  // namespace nacre::bench
