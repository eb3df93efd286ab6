#include "examples/tool/closure_source.h"

#include "jit/document/select.h"

namespace nacre::tool {

namespace {

constexpr int most_steps = 64;  // In case names lead in a circle.

const Element* child_called(const Element& scope, const Element& user, std::string_view name) {
  if (const Element* child = scope.child(qualified_name(user, name))) return child;
  return scope.child(name);
}

}  // namespace

const Element& scope_of(const Element& port) {
  const Element& parent = *port.parent();
  if (port.category() == "output" || parent.parent() == nullptr) return parent;
  return *parent.parent();
}

const Element* bound_port(const Element& input) {
  const Element* port = &input;
  for (int step = 0; step < most_steps; ++step) {
    const std::string_view name = port->attribute("interfacename");
    if (name.empty()) return port;
    const Element* outer = scope_of(*port).child(name);
    if (outer == nullptr || outer->category() != "input") return nullptr;
    port = outer;
  }
  return nullptr;
}

bool is_connected(const Element& port) {
  return port.has_attribute("nodename") || port.has_attribute("nodegraph") ||
         port.has_attribute("output");
}

const Element* output_of(const Element& port) {
  const Element& scope = scope_of(port);
  const std::string_view output = port.attribute("output");
  if (port.has_attribute("nodename")) return nullptr;
  const std::string_view graph_name = port.attribute("nodegraph");
  if (graph_name.empty()) return output.empty() ? nullptr : scope.child(output);
  const Element* graph = child_called(scope, port, graph_name);
  if (graph == nullptr) return nullptr;
  const Element* only = nullptr;
  for (const Element& child : graph->children()) {
    if (child.category() != "output") continue;
    if (child.name() == output) return &child;
    if (output.empty()) only = &child;
  }
  return only;
}

const Element* source_node(const Element& port) {
  const Element* at = &port;
  for (int step = 0; at != nullptr && step < most_steps; ++step) {
    if (at->has_attribute("nodename")) {
      return child_called(scope_of(*at), *at, at->attribute("nodename"));
    }
    at = output_of(*at);
  }
  return nullptr;
}

}  // namespace nacre::tool
