#include "jit/graph/resolve/feed.h"

#include <fmt/format.h>

#include <unordered_set>

#include "jit/document/document.h"
#include "jit/document/select.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

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
  const std::string hint =
      near_hint(complaints.diagnostics(), port.attribute("interfacename"),
                enclosing_graph(port).children(), [](const Element& child) {
                  return child.category() == "input" ? child.name() : std::string_view();
                });
  if (!has_default) {
    complaints.error("unknown-interface", port, message, expected, found, hint);
    return {Kind::invalid, nullptr, {}};
  }
  const bool has_value = takes_value && port.has_attribute("value");
  if (!complaints.tolerates("unknown-interface", port, message,
                            has_value ? "its value is used" : "the default is used", expected,
                            found, hint)) {
    return {Kind::invalid, nullptr, {}};
  }
  return {has_value ? Kind::value : Kind::none, nullptr, {}};
}

}  // namespace nacre
