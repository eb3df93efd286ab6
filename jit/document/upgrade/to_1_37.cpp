#include <array>
#include <string>
#include <unordered_set>

#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

/// The type of a nodedef becomes its output `out`.
void replace_nodedef_type(const Upgrade& upgrade, Element& nodedef) {
  Document& document = upgrade.document;
  if (!nodedef.has_attribute("type")) return;
  const std::string_view type = nodedef.attribute("type");
  if (!type.empty() && type != "multioutput") {
    Element* output = child_of(nodedef, "output", "out");
    if (output == nullptr) {
      output = &document.create_at("output", nodedef);
      rename(document, *output, "out");
      document.set_attribute(*output, "type", type);
      document.append(nodedef, *output);
    }
    for (std::string_view name : {"defaultinput", "default"}) {
      if (nodedef.has_attribute(name)) {
        document.set_attribute(*output, name, nodedef.attribute(name));
      }
    }
  }
  for (std::string_view name : {"type", "defaultinput", "default"}) {
    document.remove_attribute(nodedef, name);
  }
}

/// Nodedefs that only gave a shader its name and defaults are no more; what they
/// stood for is the node they name.
void remove_shader_nodedefs(const Upgrade& upgrade) {
  std::unordered_set<const Element*> gone;
  for (const auto& [name, nodedef] : upgrade.nodedefs) {
    if (nodedef->has_attribute("shadertype")) gone.insert(nodedef);
  }
  if (gone.empty()) return;
  Document& document = upgrade.document;
  for (Element* material : children_of(upgrade.root)) {
    if (material->category() != "material") continue;
    for (Element* reference : children_of(*material)) {
      const auto found = upgrade.nodedefs.find(reference->attribute("nodedef"));
      if (found == upgrade.nodedefs.end() || !gone.contains(found->second)) continue;
      document.remove_attribute(*reference, "nodedef");
      if (!reference->has_attribute("node")) {
        document.set_attribute(*reference, "node", found->second->attribute("node"));
      }
    }
  }
  remove_children(document, upgrade.root,
                  [&](const Element& child) { return gone.contains(&child); });
}

/// compare gives in1 up to the cutoff and in2 above, ifgreatereq the other way.
void replace_compare(const Upgrade& upgrade, Element& node) {
  Document& document = upgrade.document;
  Document::set_category(node, "ifgreatereq");
  for (Element* child : children_of(node)) {
    constexpr auto names = std::to_array<std::array<std::string_view, 2>>(
        {{"intest", "value1"}, {"cutoff", "value2"}, {"in1", "in2"}, {"in2", "in1"}});
    for (const auto& [before, after] : names) {
      if (child->name() != before) continue;
      Document::set_category(*child, "input");
      rename(document, *child, after);
      break;
    }
  }
}

std::string with_count(std::string_view category, int count) {
  return std::string(category) + static_cast<char>('0' + count);
}

int component_count_of(std::string_view type) {
  if (type == "vector4" || type == "color4") return 4;
  return type == "vector3" || type == "color3" ? 3 : 2;
}

/// A backdrop was a node with parameters and is an element with attributes.
void replace_backdrop(const Upgrade& upgrade, Element& backdrop) {
  Document& document = upgrade.document;
  document.remove_attribute(backdrop, "type");
  const auto moves = [](const Element& child) {
    return child.category() == "parameter" && child.has_attribute("value");
  };
  constexpr std::size_t most = 64;
  for (const Element* child : children_of(backdrop)) {
    if (!moves(*child) || backdrop.attributes().size() > most) continue;
    document.set_attribute(backdrop, child->name(), child->attribute("value"));
  }
  remove_children(document, backdrop, moves);
}

void set_node(const Upgrade& upgrade, Element& node, std::string_view category) {
  Document::set_category(node, upgrade.document.intern(category));
  // Nodedefs of the standard are found again by the new category and the types.
  if (!has_own_nodedef(upgrade, node)) upgrade.document.remove_attribute(node, "nodedef");
}

/// `attrname`, an attribute or a parameter, is the input `geomprop`.
void replace_attribute_name(const Upgrade& upgrade, Element& node) {
  Document& document = upgrade.document;
  if (Element* parameter = child_named(node, "attrname")) {
    rename(document, *parameter, "geomprop");
    Document::set_category(*parameter, "input");
  } else if (node.has_attribute("attrname")) {
    Element& input = add_input(document, node, "geomprop", "string", node);
    document.set_attribute(input, "value", node.attribute("attrname"));
    document.remove_attribute(node, "attrname");
  }
}

void replace_node(const Upgrade& upgrade, Element& node) {
  const std::string_view category = node.category();
  const std::string_view type = node.attribute("type");
  if (category == "invert" && (type == "matrix33" || type == "matrix44")) {
    set_node(upgrade, node, "invertmatrix");
  } else if (category == "rotate") {
    set_node(upgrade, node, type == "vector2" ? "rotate2d" : "rotate3d");
  } else if (category == "compare") {
    set_node(upgrade, node, category);
    replace_compare(upgrade, node);
  } else if (category == "transformpoint" || category == "transformvector" ||
             category == "transformnormal") {
    const bool has_spaces =
        child_named(node, "fromspace") != nullptr || child_named(node, "tospace") != nullptr;
    if (!has_spaces) set_node(upgrade, node, "transformmatrix");
  } else if (category == "combine") {
    const int count = input_of(node, "in4") != nullptr   ? 4
                      : input_of(node, "in3") != nullptr ? 3
                                                         : 2;
    set_node(upgrade, node, with_count(category, count));
  } else if (category == "separate") {
    if (const Element* in = input_of(node, "in")) {
      set_node(upgrade, node, with_count(category, component_count_of(in->attribute("type"))));
    }
  } else if (category == "geomattrvalue") {
    set_node(upgrade, node, "geompropvalue");
    replace_attribute_name(upgrade, node);
  } else if (category == "backdrop") {
    replace_backdrop(upgrade, node);
  }
}

}  // namespace

void upgrade_to_1_37(const Upgrade& upgrade) {
  for (const auto& [name, nodedef] : upgrade.nodedefs) replace_nodedef_type(upgrade, *nodedef);
  remove_shader_nodedefs(upgrade);
  for (Element* info : children_of(upgrade.root)) {
    if (info->category() != "geominfo") continue;
    for (Element* property : children_of(*info)) {
      if (property->category() == "geomattr") Document::set_category(*property, "geomprop");
    }
  }
  for (Element* graph : graphs_of(upgrade.root)) {
    for (Element* node : children_of(*graph)) replace_node(upgrade, *node);
  }
}

}  // namespace nacre::upgrading
