#include "jit/graph/resolve/connection.h"

#include <fmt/format.h>

#include <array>

#include "jit/document/document.h"
#include "jit/document/select.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

std::string near_output(const Diagnostics& said, std::string_view wanted, const Element& scope) {
  return near_hint(said, wanted, scope.children(), [](const Element& child) {
    return child.category() == "output" ? child.name() : std::string_view();
  });
}

const Element* find_in(const Element& scope, std::string_view name, const Element& user) {
  const std::string qualified = qualified_name(user, name);
  if (const Element* found = scope.child(qualified)) return found;
  return scope.child(name);
}

Connection invalid() { return {Connection::Kind::invalid, nullptr, {}}; }

Connection connect_to_graph(const Element& port, const Element& graph, Diagnostics& diagnostics,
                            bool lenient) {
  const std::string_view wanted = port.attribute("output");
  const Element* first = nullptr;
  int count = 0;
  for (const Element& child : graph.children()) {
    if (child.category() != "output") continue;
    if (!wanted.empty() && child.name() == wanted) {
      return {Connection::Kind::output, &child, {}};
    }
    if (first == nullptr) first = &child;
    ++count;
  }
  if (wanted.empty() && count == 1) return {Connection::Kind::output, first, {}};
  if (lenient && wanted.empty() && count > 1) {
    diagnostics.warning(
        "output-required", location(port),
        fmt::format("'{}' has several outputs and none is named, so the first is taken",
                    graph.name()),
        "output=\"NAME\"", fmt::format("taken: '{}'", first->name()));
    return {Connection::Kind::output, first, {}};
  }
  if (count == 0) {
    diagnostics.error("unknown-output", location(port),
                      fmt::format("the node graph '{}' has no outputs", graph.name()),
                      "a node graph with an <output>");
  } else if (wanted.empty() && count > 1) {
    diagnostics.error("output-required", location(port),
                      fmt::format("'{}' has several outputs and none is named", graph.name()),
                      "output=\"NAME\"");
  } else {
    diagnostics.error("unknown-output", location(port),
                      fmt::format("the node graph '{}' has no such output", graph.name()),
                      "the name of an output", fmt::format("'{}'", wanted),
                      near_output(diagnostics, wanted, graph));
  }
  return invalid();
}

Connection connect_to_node(const Element& port, Diagnostics& diagnostics, bool lenient) {
  const std::string_view name = port.attribute("nodename");
  const Element* target = find_in(scope_of(port), name, port);
  if (target != nullptr && target->category() == "nodegraph") {
    return connect_to_graph(port, *target, diagnostics, lenient);
  }
  if (target == nullptr || !is_node(*target)) {
    std::string found = fmt::format("'{}'", name);
    if (target != nullptr) found += fmt::format(", which is <{}>", target->category());
    diagnostics.error("unknown-nodename", location(port), "there is no node of this name here",
                      "the name of a node beside this one", std::move(found),
                      near_hint(diagnostics, name, scope_of(port).children(), [](auto& child) {
                        return is_node(child) ? child.name() : std::string_view();
                      }));
    return invalid();
  }
  return {Connection::Kind::node, target, port.attribute("output")};
}

Connection connect_to_nodegraph(const Element& port, Diagnostics& diagnostics, bool lenient) {
  const std::string_view name = port.attribute("nodegraph");
  const Element* target = find_in(scope_of(port), name, port);
  if (target == nullptr) target = find_in(port.document().root(), name, port);
  if (target == nullptr || target->category() != "nodegraph") {
    diagnostics.error(
        "unknown-nodegraph", location(port), "there is no node graph of this name",
        "the name of a node graph", fmt::format("'{}'", name),
        near_hint(diagnostics, name, port.document().root().children(), [](const Element& child) {
          return child.category() == "nodegraph" ? child.name() : std::string_view();
        }));
    return invalid();
  }
  return connect_to_graph(port, *target, diagnostics, lenient);
}

Connection connect_to_document_output(const Element& port, Diagnostics& diagnostics) {
  const std::string_view name = port.attribute("output");
  const Element* target = find_in(port.document().root(), name, port);
  if (target == nullptr || target->category() != "output") {
    diagnostics.error("unknown-output", location(port), "the document has no such output",
                      "the name of an output", fmt::format("'{}'", name),
                      near_output(diagnostics, name, port.document().root()));
    return invalid();
  }
  return {Connection::Kind::output, target, {}};
}

}  // namespace

const Element& enclosing_graph(const Element& element) {
  const Element* at = element.parent() == nullptr ? &element : element.parent();
  while (at->parent() != nullptr && at->category() != "nodegraph") at = at->parent();
  return *at;
}

const Element& scope_of(const Element& port) {
  const Element& owner = *port.parent();
  if (port.category() == "output" || owner.parent() == nullptr) return owner;
  return *owner.parent();
}

Connection find_connection(const Element& port, Diagnostics& diagnostics, bool lenient) {
  constexpr std::array<std::string_view, 3> ways{"nodename", "nodegraph", "interfacename"};
  std::string_view way;
  for (std::string_view candidate : ways) {
    if (port.attribute(candidate).empty()) continue;
    if (!way.empty()) {
      diagnostics.error("several-sources", location(port), "the port is fed from two places",
                        "one of nodename, nodegraph and interfacename",
                        fmt::format("{} and {}", way, candidate));
      return invalid();
    }
    way = candidate;
  }
  const bool only_output = way.empty() && !port.attribute("output").empty();
  if ((!way.empty() || only_output) && port.has_attribute("value")) {
    diagnostics.warning("value-and-connection", location(port),
                        "the port is connected, so its value is not used");
  }
  if (way == "nodename") return connect_to_node(port, diagnostics, lenient);
  if (way == "nodegraph") return connect_to_nodegraph(port, diagnostics, lenient);
  if (way == "interfacename") {
    return {Connection::Kind::interface, nullptr, port.attribute("interfacename")};
  }
  if (only_output) return connect_to_document_output(port, diagnostics);
  if (port.has_attribute("value")) return {Connection::Kind::value, nullptr, {}};
  return {};
}

Connection find_connection(const Element& port, Complaints& complaints) {
  Diagnostics said;
  const Connection connection = find_connection(port, said, complaints.is_lenient());
  complaints.add(said, port);
  return connection;
}

}  // namespace nacre
