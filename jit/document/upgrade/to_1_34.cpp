// Node graphs and nodedefs get their names, connections their attributes.
#include <set>
#include <string>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

void rename_elements(const Upgrade& upgrade) {
  Document& document = upgrade.document;
  for (Element* element : elements_of(upgrade.root)) {
    if (element->category() == "opgraph") {
      Document::set_category(*element, "nodegraph");
    } else if (element->category() == "shader") {
      Document::set_category(*element, "nodedef");
      if (element->has_attribute("shadertype")) {
        document.set_attribute(*element, "type", "surfaceshader");
      }
      if (element->has_attribute("shaderprogram")) {
        document.set_attribute(*element, "node", element->attribute("shaderprogram"));
      }
    } else if (element->category() == "shaderref" && element->has_attribute("shadertype")) {
      document.remove_attribute(*element, "shadertype");
      document.set_attribute(*element, "type", "surfaceshader");
    }
  }
}

/// <parameter type="opgraphnode" value="N"> is a connection to the node N.
void replace_connections(const Upgrade& upgrade, Element& graph) {
  Document& document = upgrade.document;
  const Scope scope(document, graph);
  for (Element* node : children_of(graph)) {
    for (Element* parameter : children_of(*node)) {
      const bool connects =
          parameter->category() == "parameter" && parameter->attribute("type") == "opgraphnode";
      if (!connects) continue;
      const std::string_view source_name = parameter->attribute("value");
      if (node->category() == "output") {
        if (parameter->name() == "in") document.set_attribute(*node, "nodename", source_name);
        continue;
      }
      const Element* source = scope.find(source_name);
      const std::string_view type = source != nullptr ? source->attribute("type") : "color3";
      Document::set_category(*parameter, "input");
      move_attribute(document, *parameter, "value", "nodename");
      document.set_attribute(*parameter, "type", type);
    }
    if (node->category() == "output") {
      remove_children(document, *node, [](const Element& child) {
        return child.category() == "parameter" && child.attribute("type") == "opgraphnode";
      });
    }
  }
}

/// A shader reference is to the shader of its own name.
void name_shaders(const Upgrade& upgrade, Element& material) {
  for (Element* reference : children_of(material)) {
    if (reference->category() != "shaderref") continue;
    if (nodedef_of_shaderref(upgrade, *reference) != nullptr) continue;
    const auto found = upgrade.nodedefs.find(reference->name());
    if (found == upgrade.nodedefs.end()) continue;
    upgrade.document.set_attribute(*reference, "nodedef", found->second->name());
    upgrade.document.set_attribute(*reference, "node", found->second->attribute("node"));
  }
}

/// A shader's input that names a graph feeds that input where the shader is used.
void bind_graphs(const Upgrade& upgrade, Element& material) {
  Document& document = upgrade.document;
  visit_unbound_inputs(upgrade, material, [&](Element& reference, const Element& input) {
    if (!input.has_attribute("opgraph") || !input.has_attribute("graphoutput")) return;
    Element& binding = document.create_at("bindinput", input);
    rename(document, binding, input.name());
    document.set_attribute(binding, "type", input.attribute("type"));
    document.set_attribute(binding, "nodegraph", input.attribute("opgraph"));
    document.set_attribute(binding, "output", input.attribute("graphoutput"));
    document.append(reference, binding);
  });
}

void forget_graphs(const Upgrade& upgrade) {
  for (const auto& [name, nodedef] : upgrade.nodedefs) {
    for (Element* input : children_of(*nodedef)) {
      if (!input->has_attribute("opgraph") || !input->has_attribute("graphoutput")) continue;
      upgrade.document.remove_attribute(*input, "opgraph");
      upgrade.document.remove_attribute(*input, "graphoutput");
    }
  }
}

/// The tiles that geometries are assigned to become one set of the document.
void gather_udims(const Upgrade& upgrade) {
  std::set<std::string_view> tiles;
  Element* last = nullptr;
  for (Element* info : children_of(upgrade.root)) {
    if (info->category() != "geominfo") continue;
    for (Element* property : children_of(*info)) {
      if (property->category() == "geomattr") Document::set_category(*property, "geomprop");
      if (property->category() != "geomprop") continue;
      if (property->name() == "udimset") return;
      if (property->name() != "udim") continue;
      tiles.insert(property->attribute("value"));
      last = info;
    }
  }
  if (last == nullptr) return;
  std::string list;
  for (std::string_view tile : tiles) {
    if (!list.empty()) list += ", ";
    list += tile;
  }
  Document& document = upgrade.document;
  const Scope scope(document, upgrade.root);
  Element& info = document.create_at("geominfo", *last);
  rename(document, info, scope.free_name("geominfo1"));
  Element& set = document.create_at("geomprop", *last);
  rename(document, set, "udimset");
  document.set_attribute(set, "type", "stringarray");
  set_kept(document, set, "value", list);
  document.append(info, set);
  document.append(upgrade.root, info);
}

}  // namespace

void upgrade_to_1_34(const Upgrade& upgrade) {
  rename_elements(upgrade);
  Upgrade renamed = upgrade;  // <shader>s are nodedefs now.
  renamed.find_nodedefs();
  for (Element* graph : graphs_of(upgrade.root)) replace_connections(renamed, *graph);
  for (Element* material : children_of(upgrade.root)) {
    if (material->category() != "material") continue;
    name_shaders(renamed, *material);
    bind_graphs(renamed, *material);
  }
  forget_graphs(renamed);
  gather_udims(renamed);
}

}  // namespace nacre::upgrading
