#include "examples/tool/material_inputs.h"

#include <algorithm>

#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

/// "NG/out" for an input that a graph's output feeds, else "". A graph with one
/// output need not be named with it.
std::string graph_output(const Document& document, const Element& input) {
  const std::string_view graph = input.attribute("nodegraph");
  if (graph.empty()) return std::string(input.attribute("output"));
  std::string_view output = input.attribute("output");
  const Element* scope = document.root().child(graph);
  if (output.empty() && scope != nullptr) {
    for (const Element& child : scope->children()) {
      if (child.category() == "output") output = child.name();
    }
  }
  return std::string(graph) + '/' + std::string(output);
}

}  // namespace

std::vector<std::string> material_inputs(const Document& document, const std::string& material,
                                         Diagnostics& diagnostics) {
  for (const FoundMaterial& found : find_materials(document)) {
    if (found.name != material) continue;
    const Element* shader = document.root().child(found.surfaceshader);
    std::vector<std::string> names;
    if (shader == nullptr) return names;
    for (const Element& input : shader->children()) {
      if (input.category() != "input") continue;
      const std::string name = graph_output(document, input);
      const bool is_known = std::find(names.begin(), names.end(), name) != names.end();
      if (!name.empty() && !is_known) names.push_back(name);
    }
    return names;
  }
  std::string known;
  for (const FoundMaterial& found : find_materials(document)) {
    known += (known.empty() ? "" : ", ") + found.name;
  }
  diagnostics.error("unknown-material", {document.files().front(), 0, 0, {}},
                    "there is no material '" + material + "'",
                    known.empty() ? "a material" : "one of " + known);
  return {};
}

}  // namespace nacre::tool
