#include <charconv>
#include <string>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

/// A connection wins over a value; later versions know one of them only.
void remove_unused_values(const Upgrade& upgrade, Element& node) {
  if (node.category() == "nodegraph" || node.category() == "nodedef") return;
  for (Element* input : children_of(node)) {
    if (input->category() == "input" && is_connected(*input)) {
      upgrade.document.remove_attribute(*input, "value");
    }
  }
}

/// The radius of subsurface_bsdf was a vector and is a colour.
void convert_radius(const Upgrade& upgrade, Scope& scope, Element& node) {
  Document& document = upgrade.document;
  Element* radius = input_of(node, "radius");
  if (radius == nullptr || radius->attribute("type") != "vector3") return;
  Element& convert = scope.add_node("convert", "convert", "color3", node);
  copy_binding(document, *radius, add_input(document, convert, "in", "vector3", *radius));
  connect(document, *radius, convert);
  document.set_attribute(*radius, "type", "color3");
}

/// `which` outside of the five inputs there were meant the first.
void limit_switch(const Upgrade& upgrade, Element& node) {
  Element* which = input_of(node, "which");
  if (which == nullptr || !which->has_attribute("value")) return;
  const std::string_view text = which->attribute("value");
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && value >= 5) upgrade.document.set_attribute(*which, "value", "0");
}

void rename_atan2(const Upgrade& upgrade, Element& node) {
  if (Element* y = input_of(node, "in1")) rename(upgrade.document, *y, "iny");
  if (Element* x = input_of(node, "in2")) rename(upgrade.document, *x, "inx");
}

void replace_nodes(const Upgrade& upgrade, Element& graph) {
  Scope scope(upgrade.document, graph);
  for (Element* node : scope.children()) {
    if (has_own_nodedef(upgrade, *node)) continue;
    if (node->category() == "subsurface_bsdf") convert_radius(upgrade, scope, *node);
    if (node->category() == "switch") limit_switch(upgrade, *node);
    if (node->category() == "atan2") rename_atan2(upgrade, *node);
    if (node->category() == "arrayappend") {
      cannot_upgrade(upgrade, *node, "arrayappend is no more, and nothing takes its place",
                     "the array as a value");
    }
  }
  scope.finish();
}

}  // namespace

void upgrade_to_1_39(const Upgrade& upgrade) {
  replace_channels(upgrade);
  for (Element* graph : graphs_of(upgrade.root)) {
    for (Element* node : children_of(*graph)) remove_unused_values(upgrade, *node);
  }
  replace_thin_film(upgrade);
  for (Element* graph : graphs_of(upgrade.root)) replace_nodes(upgrade, *graph);
  replace_swizzle(upgrade);
  replace_normalmap(upgrade);
}

}  // namespace nacre::upgrading
