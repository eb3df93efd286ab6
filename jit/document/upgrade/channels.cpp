#include <string>
#include <unordered_map>

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

/// Types of ports as far as the file says them. Looks every element through once.
class PortTypes {
 public:
  explicit PortTypes(const Upgrade& upgrade) : upgrade_(upgrade) {}

  /// Of what a port is bound to; "" if the file does not say.
  std::string_view source_of(const Element& port, Scope& scope) {
    const std::string_view output = port.attribute("output");
    if (port.has_attribute("nodename")) {
      Element* node = scope.find(port.attribute("nodename"));
      return node != nullptr ? of_node(*node, output) : std::string_view();
    }
    if (port.has_attribute("nodegraph")) {
      Element* graph = scope.find(port.attribute("nodegraph"));
      return graph != nullptr ? of_output(*graph, output) : std::string_view();
    }
    if (port.has_attribute("interfacename")) {
      return of_interface(scope, port.attribute("interfacename"));
    }
    return {};
  }

 private:
  struct Ports {
    std::unordered_map<std::string_view, std::string_view> inputs, outputs;  // name to type
    std::string_view last_output;
  };

  const Ports& ports_in(Element& element) {
    const auto [place, is_new] = ports_.try_emplace(&element);
    if (!is_new) return place->second;
    for (const Element* child : children_of(element)) {
      const std::string_view type = child->attribute("type");
      if (child->category() == "input") place->second.inputs.emplace(child->name(), type);
      if (child->category() != "output") continue;
      place->second.outputs.emplace(child->name(), type);
      place->second.last_output = type;
    }
    return place->second;
  }

  std::string_view of_output(Element& element, std::string_view name) {
    const Ports& ports = ports_in(element);
    if (name.empty()) return ports.last_output;
    const auto found = ports.outputs.find(name);
    return found != ports.outputs.end() ? found->second : std::string_view();
  }

  std::string_view of_node(Element& node, std::string_view output) {
    const std::string_view type = node.attribute("type");
    if (type != "multioutput") return type;
    if (node.category().starts_with("separate")) return "float";
    return node.category() == "artistic_ior" ? "color3" : of_output(node, output);
  }

  /// Of an interface of a graph: its own input's, or its nodedef's.
  std::string_view of_interface(Scope& scope, std::string_view name) {
    const Element* own = scope.find(name);
    if (own != nullptr && own->category() == "input") return own->attribute("type");
    const auto nodedef = upgrade_.nodedefs.find(scope.graph().attribute("nodedef"));
    if (nodedef == upgrade_.nodedefs.end()) return {};
    const Ports& ports = ports_in(*nodedef->second);
    const auto found = ports.inputs.find(name);
    return found != ports.inputs.end() ? found->second : std::string_view();
  }

  const Upgrade& upgrade_;
  std::unordered_map<const Element*, Ports> ports_;
};

void replace_port_channels(const Upgrade& upgrade, Scope& scope, PortTypes& types, Element& port,
                           const Element& user) {
  Document& document = upgrade.document;
  const std::string_view channels = port.attribute("channels");
  const std::string_view type = port.attribute("type");
  std::string_view source = types.source_of(port, scope);
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
  PortTypes types(upgrade);
  for (Element* graph : graphs_of(upgrade.root)) {
    Scope scope(upgrade.document, *graph);
    for (Element* port : ports_of(*graph)) {
      if (port->attribute("channels").empty()) continue;
      // What is in front of an output stands before it, else before its node.
      const Element& user = port->category() == "output" ? *port : *port->parent();
      replace_port_channels(upgrade, scope, types, *port, user);
    }
    scope.finish();
  }
}

}  // namespace nacre::upgrading
