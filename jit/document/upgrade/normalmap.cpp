#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

Element& add_value(const Upgrade& upgrade, Element& node, std::string_view name,
                   std::string_view type, std::string_view value) {
  Element& input = add_input(upgrade.document, node, name, type, node);
  upgrade.document.set_attribute(input, "value", value);
  return input;
}

/// An object-space map is decoded to [-1, 1] and normalised, and that is all.
void decode_object_space(const Upgrade& upgrade, Scope& scope, Element& node) {
  Document& document = upgrade.document;
  Element& twice = scope.add_node("multiply", "multiply", "vector3", node);
  Element& in1 = add_input(document, twice, "in1", "vector3", node);
  if (const Element* in = input_of(node, "in")) {
    copy_binding(document, *in, in1);
  } else {
    document.set_attribute(in1, "value", "0.5, 0.5, 1.0");  // The default of the input.
  }
  add_value(upgrade, twice, "in2", "float", "2");
  Element& decoded = scope.add_node("subtract", "subtract", "vector3", node);
  connect(document, add_input(document, decoded, "in1", "vector3", node), twice);
  add_value(upgrade, decoded, "in2", "float", "1");
  remove_children(document, node, [](const Element& child) { return child.category() == "input"; });
  connect(document, add_input(document, node, "in", "vector3", node), decoded);
  rename_nodedef(upgrade, node, "ND_normalize_vector3");
  Document::set_category(node, "normalize");
}

/// The binding of a vector that the node has, or of the world's where it has none.
void bind_frame(const Upgrade& upgrade, Scope& scope, Element& node, std::string_view name,
                Element& to) {
  if (const Element* given = input_of(node, name)) {
    copy_binding(upgrade.document, *given, to);
    return;
  }
  Element& world =
      scope.add_node(name, std::string("normalmap_") + std::string(name), "vector3", node);
  add_value(upgrade, world, "space", "string", "world");
  connect(upgrade.document, to, world);
}

/// The bitangent was that of the frame given, and would be the surface's.
void add_bitangent(const Upgrade& upgrade, Scope& scope, Element& node) {
  Document& document = upgrade.document;
  // The frame first, so that it stands before the product.
  Element& cross = document.create_at("crossproduct", node);
  rename(document, cross, scope.free_name("normalmap_cross"));
  document.set_attribute(cross, "type", "vector3");
  bind_frame(upgrade, scope, node, "normal", add_input(document, cross, "in1", "vector3", node));
  bind_frame(upgrade, scope, node, "tangent", add_input(document, cross, "in2", "vector3", node));
  scope.adopt(cross, node);
  Element& unit = scope.add_node("normalize", "normalmap_cross_norm", "vector3", node);
  connect(document, add_input(document, unit, "in", "vector3", node), cross);
  connect(document, add_input(document, node, "bitangent", "vector3", node), unit);
}

void replace(const Upgrade& upgrade, Scope& scope, Element& node) {
  const Element* space = input_of(node, "space");
  if (space != nullptr && is_connected(*space)) {
    cannot_upgrade(upgrade, *space, "the space of a normal map is not known beforehand",
                   "value=\"tangent\" or value=\"object\"");
    return;
  }
  if (space != nullptr && space->attribute("value") == "object") {
    decode_object_space(upgrade, scope, node);
    return;
  }
  if (space != nullptr) remove_child(upgrade.document, node, *space);
  const bool has_frame =
      input_of(node, "normal") != nullptr || input_of(node, "tangent") != nullptr;
  if (has_frame && input_of(node, "bitangent") == nullptr) add_bitangent(upgrade, scope, node);
  if (node.attribute("nodedef") == "ND_normalmap") {
    rename_nodedef(upgrade, node, "ND_normalmap_float");
  }
}

}  // namespace

void replace_normalmap(const Upgrade& upgrade) {
  for (Element* graph : graphs_of(upgrade.root)) {
    Scope scope(upgrade.document, *graph);
    for (Element* node : scope.children()) {
      if (node->category() != "normalmap" || has_own_nodedef(upgrade, *node)) continue;
      replace(upgrade, scope, *node);
    }
    scope.finish();
  }
}

}  // namespace nacre::upgrading
