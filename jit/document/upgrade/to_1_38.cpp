#include <unordered_map>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

/// The arguments of atan2 changed places.
void swap_atan2(const Upgrade& upgrade, Element& node) {
  for (Element* child : children_of(node)) {
    if (child->name() == "in1") {
      rename(upgrade.document, *child, "in2");
    } else if (child->name() == "in2") {
      rename(upgrade.document, *child, "in1");
    }
  }
}

/// A node may not be called as an input of its graph any more.
void rename_collisions(const Upgrade& upgrade, Element& graph) {
  Document& document = upgrade.document;
  Scope scope(document, graph);
  std::unordered_map<std::string_view, std::string_view> renamed;
  for (Element* node : scope.children()) {
    for (const Element* port : children_of(*node)) {
      const std::string_view name = port->attribute("interfacename");
      Element* collides = name.empty() ? nullptr : scope.find(name);
      if (collides == nullptr || collides->category() == "input" ||
          collides->category() == "output" || collides->category() == "token") {
        continue;
      }
      scope.rename(*collides, scope.free_name(name));
      renamed.emplace(name, collides->name());
    }
  }
  if (renamed.empty()) return;
  for (Element* port : ports_of(graph)) {
    const auto found = renamed.find(port->attribute("nodename"));
    if (found != renamed.end()) document.set_attribute(*port, "nodename", found->second);
  }
}

/// <parameter> is <input>, uniform where a nodedef declares it.
void replace_parameters(const Upgrade& upgrade) {
  for (Element* element : elements_of(upgrade.root)) {
    if (element->category() != "parameter") continue;
    Document::set_category(*element, "input");
    if (element->parent()->category() == "nodedef") {
      upgrade.document.set_attribute(*element, "uniform", "true");
    }
  }
}

}  // namespace

void upgrade_to_1_38(const Upgrade& upgrade) {
  replace_color2(upgrade);
  replace_materials(upgrade);
  for (Element* graph : graphs_of(upgrade.root)) {
    for (Element* node : children_of(*graph)) {
      if (node->category() == "atan2" && !has_own_nodedef(upgrade, *node)) {
        swap_atan2(upgrade, *node);
      }
    }
  }
  rename_closures(upgrade);
  for (Element* graph : graphs_of(upgrade.root)) {
    if (graph->category() != "nodegraph") continue;
    upgrade.document.remove_attribute(*graph, "version");
    rename_collisions(upgrade, *graph);
  }
  replace_parameters(upgrade);
}

}  // namespace nacre::upgrading
