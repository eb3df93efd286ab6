#include <string>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

/// What the letters alone say, where the type of the source is not known.
std::string_view guess_type(std::string_view channels, std::string_view port_type) {
  if (channels == "xx" || channels == "xxx" || channels == "xxxx") return "float";
  if (channels == "xyz" || channels == "x" || channels == "y" || channels == "z") return "vector3";
  if (channels == "rgba" || channels == "a") return "color4";
  return port_type == "color3" ? "color4" : "color3";
}

std::string_view type_of_output(Element& element, std::string_view output) {
  const Element* only = nullptr;
  for (const Element* child : children_of(element)) {
    if (child->category() != "output") continue;
    if (child->name() == output) return child->attribute("type");
    if (output.empty()) only = child;
  }
  return only != nullptr ? only->attribute("type") : std::string_view();
}

std::string_view node_type(Element& node, std::string_view output) {
  const std::string_view type = node.attribute("type");
  if (type != "multioutput") return type;
  if (node.category().starts_with("separate")) return "float";
  if (node.category() == "artistic_ior") return "color3";
  return type_of_output(node, output);
}

/// The type of what a port is bound to, as far as the file says it; else "".
std::string_view source_type(const Scope& scope, const Element& port) {
  const std::string_view output = port.attribute("output");
  if (port.has_attribute("nodename")) {
    Element* node = scope.find(port.attribute("nodename"));
    return node != nullptr ? node_type(*node, output) : std::string_view();
  }
  if (port.has_attribute("nodegraph")) {
    Element* graph = scope.find(port.attribute("nodegraph"));
    return graph != nullptr ? type_of_output(*graph, output) : std::string_view();
  }
  return {};
}

/// The type of an interface of a graph: its own input's, or its nodedef's.
std::string_view interface_type(const Upgrade& upgrade, Element& graph, std::string_view name) {
  if (const Element* input = input_of(graph, name)) return input->attribute("type");
  const auto nodedef = upgrade.nodedefs.find(graph.attribute("nodedef"));
  if (nodedef == upgrade.nodedefs.end()) return {};
  const Element* input = input_of(*nodedef->second, name);
  return input != nullptr ? input->attribute("type") : std::string_view();
}

void replace_port_channels(const Upgrade& upgrade, Scope& scope, Element& port,
                           const Element& user) {
  Document& document = upgrade.document;
  const std::string_view channels = port.attribute("channels");
  const std::string_view type = port.attribute("type");
  std::string_view source = source_type(scope, port);
  if (source.empty() && port.has_attribute("interfacename")) {
    source = interface_type(upgrade, scope.graph(), port.attribute("interfacename"));
  }
  if (source.empty()) source = guess_type(channels, type);
  if (source == "float" && type == "float") {
    document.remove_attribute(port, "channels");
    return;
  }
  Element& swizzle = scope.add_node("swizzle", "swizzle", type, user);
  Element& in = add_input(document, swizzle, "in", source, port);
  copy_binding(document, port, in);
  document.remove_attribute(in, "channels");
  Element& letters = add_input(document, swizzle, "channels", "string", port);
  document.set_attribute(letters, "value", channels);
  connect(document, port, swizzle);
}

}  // namespace

void replace_channels(const Upgrade& upgrade) {
  for (Element* graph : graphs_of(upgrade.root)) {
    Scope scope(upgrade.document, *graph);
    for (Element* port : ports_of(*graph)) {
      if (port->attribute("channels").empty()) continue;
      // What is in front of an output stands before it, else before its node.
      const Element& user = port->category() == "output" ? *port : *port->parent();
      replace_port_channels(upgrade, scope, *port, user);
    }
    scope.finish();
  }
}

}  // namespace nacre::upgrading
