#include <string>
#include <unordered_set>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

/// The letters of a color2, r and a, as those of a vector2.
void rename_letters(const Upgrade& upgrade, Element& element, std::string_view attribute) {
  if (!element.has_attribute(attribute)) return;
  std::string letters(element.attribute(attribute));
  for (char& letter : letters) {
    if (letter == 'r') letter = 'x';
    if (letter == 'a') letter = 'y';
  }
  set_kept(upgrade.document, element, attribute, letters);
}

void rename_output(const Upgrade& upgrade, Element& port) {
  const std::string_view output = port.attribute("output");
  if (output == "outr") upgrade.document.set_attribute(port, "output", "outx");
  if (output == "outa") upgrade.document.set_attribute(port, "output", "outy");
}

bool reads_color2(Element& node) {
  const Element* in = child_named(node, "in");
  return in != nullptr && in->attribute("type") == "color2";
}

/// Before the types change: what reads a channel of a color2 by its letter.
void rename_channels(const Upgrade& upgrade, Element& graph) {
  const Scope scope(upgrade.document, graph);
  for (Element* port : ports_of(graph)) {
    Element* source = scope.find(port->attribute("nodename"));
    if (source == nullptr) continue;
    if (source->attribute("type") == "color2") rename_letters(upgrade, *port, "channels");
    if (source->category() == "separate2" && reads_color2(*source)) rename_output(upgrade, *port);
  }
  for (Element* node : children_of(graph)) {
    if (node->category() != "swizzle" || !reads_color2(*node)) continue;
    if (Element* channels = child_named(*node, "channels")) {
      rename_letters(upgrade, *channels, "value");
    }
  }
}

void rename_type(const Upgrade& upgrade, Element& element) {
  if (element.attribute("type") == "color2") {
    upgrade.document.set_attribute(element, "type", "vector2");
  }
  if (element.attribute("type") == "color2array") {
    upgrade.document.set_attribute(element, "type", "vector2array");
  }
  // Nodedefs of the standard are called by their types: ND_mix_color2.
  std::string nodedef(element.attribute("nodedef"));
  const std::size_t at = nodedef.find("_color2");
  if (at == std::string::npos || has_own_nodedef(upgrade, element)) return;
  set_kept(upgrade.document, element, "nodedef", nodedef.replace(at, 7, "_vector2"));
}

}  // namespace

void replace_color2(const Upgrade& upgrade) {
  for (Element* graph : graphs_of(upgrade.root)) rename_channels(upgrade, *graph);
  for (Element* element : elements_of(upgrade.root)) rename_type(upgrade, *element);
}

}  // namespace nacre::upgrading
