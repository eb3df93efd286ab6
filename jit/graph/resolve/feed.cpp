#include "jit/graph/resolve/feed.h"

#include <fmt/format.h>

#include <unordered_set>

#include "jit/document/document.h"
#include "jit/document/inheritance.h"
#include "jit/document/select.h"

namespace nacre {

namespace {

bool says_something(const Element& input) {
  for (const Attribute& attribute : input.attributes()) {
    if (attribute.name == "value") return true;
    const bool connects = attribute.name == "nodename" || attribute.name == "nodegraph" ||
                          attribute.name == "interfacename" || attribute.name == "output";
    if (connects && !attribute.value.empty()) return true;
  }
  return false;
}

/// The ports on the way from one to what feeds it.
using Way = std::unordered_set<const Element*>;

Connection cycle(const Element& port, Complaints& complaints) {
  complaints.error("cycle", port, "the connections form a cycle", "", element_path(port));
  return {Connection::Kind::invalid, nullptr, {}};
}

Feed follow_interfaces(const Element& port, const Definitions& definitions, Complaints& complaints,
                       Way& way) {
  Feed feed{&port, &port, {}};
  while (true) {
    if (!way.insert(feed.port).second) {
      feed.connection = cycle(port, complaints);
      return feed;
    }
    feed.connection = find_connection(*feed.port, complaints);
    if (feed.connection.kind != Connection::Kind::interface) return feed;
    const std::string_view name = feed.connection.output;
    const Element& graph = scope_of(*feed.port);
    const Element* outer = nullptr;
    if (const NodeDef* def = definitions.implemented_by(graph)) {
      if (const NodeDefInput* input = def->input(name)) outer = input->element;
    } else {
      outer = find_interface(graph, name);
    }
    if (outer == nullptr) {
      feed.connection = without_interface(*feed.port, true, complaints);
      return feed;
    }
    feed.reader = feed.port;
    feed.port = outer;
  }
}

}  // namespace

const Element* find_input(const Element& node, std::string_view name) {
  // The chain is bounded in case it is a circle.
  const Element* element = &node;
  const std::size_t most = node.document().max_inheritance();
  for (std::size_t depth = 0; element != nullptr && depth < most; ++depth) {
    const Element* input = element->child(name);
    if (input != nullptr && input->category() == "input" && says_something(*input)) return input;
    const std::string_view base = element->attribute("inherit");
    element = base.empty() ? nullptr : element->parent()->child(base);
  }
  return nullptr;
}

std::vector<const Element*> find_inputs(const Element& node, Diagnostics& diagnostics) {
  std::vector<const Element*> inputs;
  std::unordered_set<std::string_view> names;
  for (const Element* element : node_inheritance(node, diagnostics)) {
    for (const Element& child : element->children()) {
      if (child.category() != "input" || !says_something(child)) continue;
      if (names.insert(child.name()).second) inputs.push_back(&child);
    }
  }
  return inputs;
}

Feed find_feed(const Element& port, const Definitions& definitions, Complaints& complaints) {
  Way way;
  return follow_interfaces(port, definitions, complaints, way);
}

Feed find_source_node(const Element& port, const Definitions& definitions, Complaints& complaints) {
  Way way;
  Feed feed = follow_interfaces(port, definitions, complaints, way);
  while (feed.connection.kind == Connection::Kind::output) {
    feed = follow_interfaces(*feed.connection.target, definitions, complaints, way);
  }
  return feed;
}

const Element* find_interface(const Element& graph, std::string_view name) {
  const Element* input = graph.child(name);
  return input != nullptr && input->category() == "input" ? input : nullptr;
}

Connection without_interface(const Element& port, bool takes_value, Complaints& complaints) {
  using Kind = Connection::Kind;
  const bool has_default = port.category() == "input" && is_node(*port.parent());
  const std::string message = "the graph around it has no such input";
  const std::string expected = "the name of an input of the graph";
  const std::string found = fmt::format("'{}'", port.attribute("interfacename"));
  if (!has_default) {
    complaints.error("unknown-interface", port, message, expected, found);
    return {Kind::invalid, nullptr, {}};
  }
  const bool has_value = takes_value && port.has_attribute("value");
  if (!complaints.tolerates("unknown-interface", port, message,
                            has_value ? "its value is used" : "the default is used", expected,
                            found)) {
    return {Kind::invalid, nullptr, {}};
  }
  return {has_value ? Kind::value : Kind::none, nullptr, {}};
}

}  // namespace nacre
