#include "jit/graph/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "jit/document/select.h"
#include "jit/document/value_text.h"
#include "jit/graph/connection.h"
#include "jit/graph/find.h"

namespace nacre {

namespace {

class Checker {
 public:
  Checker(const Document& document, const Definitions& definitions, Diagnostics& diagnostics)
      : document_(document), definitions_(definitions), diagnostics_(diagnostics) {}

  void check_all() {
    check_scope(document_.root());
    for (const Element& child : document_.root().children()) {
      if (child.category() == "nodegraph") check_graph(child);
      if (child.category() == "implementation") check_implementation(child);
      if (child.category() == "nodedef") check_nodedef(child);
      if (child.category() == "look") check_look(child);
    }
    find_looks(document_, diagnostics_);
  }

 private:
  // Nodes, inputs and outputs of a graph or the root; graphs within graphs too.
  void check_scope(const Element& top) {
    std::vector<const Element*> scopes{&top};
    while (!scopes.empty()) {
      const Element& scope = *scopes.back();
      scopes.pop_back();
      for (const Element& child : scope.children()) {
        if (child.category() == "input" || child.category() == "output") {
          check_port(child);
        } else if (is_node(child)) {
          check_node(child);
        } else if (child.category() == "nodegraph" && scope.parent() != nullptr) {
          scopes.push_back(&child);
        }
      }
    }
  }

  void check_node(const Element& node) {
    if (node.name().empty()) {
      error("missing-name", node, "the node has no name", "a name");
    }
    const NodeDef* def = find_nodedef(node, definitions_, diagnostics_);
    if (def != nullptr && def->category != node.category() &&
        def->category != qualified_name(node, node.category())) {
      diagnostics_.warning("nodedef-mismatch", location(node),
                           fmt::format("the nodedef '{}' is of another node", def->name),
                           fmt::format("<{}>", def->category),
                           fmt::format("<{}>", node.category()));
    }
    for (const Element& child : node.children()) {
      if (child.category() != "input") continue;
      check_port(child);
      const NodeDefInput* input = def == nullptr ? nullptr : def->input(child.name());
      if (input != nullptr) check_enum(child, *input);
    }
    check_instance_inheritance(node);
  }

  void check_instance_inheritance(const Element& node) {
    std::vector<const Element*> chain{&node};
    while (chain.back()->has_attribute("inherit")) {
      const std::string_view name = chain.back()->attribute("inherit");
      const Element* base = node.parent()->child(name);
      if (base == nullptr || base->category() != node.category()) {
        error("unknown-nodename", *chain.back(), "there is no such node to inherit from",
              fmt::format("the name of a <{}>", node.category()), fmt::format("'{}'", name));
        return;
      }
      if (std::find(chain.begin(), chain.end(), base) != chain.end()) {
        error("inherit-cycle", node, "the node inherits from itself, directly or not");
        return;
      }
      chain.push_back(base);
    }
  }

  void check_enum(const Element& port, const NodeDefInput& input) {
    if (input.type != Type::string || input.enums.empty() || !port.has_attribute("value")) return;
    const std::string_view text = port.attribute("value");
    const std::vector<std::string_view> values = split_list(input.enum_values);
    for (const auto* list : {&input.enums, &values}) {
      if (std::find(list->begin(), list->end(), text) != list->end()) return;
    }
    error("bad-enum", port, fmt::format("'{}' does not take this value", input.name),
          fmt::format("{}", fmt::join(input.enums, ", ")), fmt::format("'{}'", text));
  }

  void check_port(const Element& port) {
    const std::string_view type_text = port.attribute("type");
    const auto type = parse_type(type_text);
    if (!type) {
      if (type_text.empty()) {
        error("missing-type", port, "the port has no type", "type=\"TYPE\"");
      } else if (!is_declared_type(type_text)) {
        error("unknown-type", port, "there is no type of this name", "a standard type",
              fmt::format("'{}'", type_text));
      }
      return;
    }
    const Connection connection = find_connection(port, diagnostics_);
    switch (connection.kind) {
      case Connection::Kind::value: check_value(port, *type); break;
      case Connection::Kind::interface: check_interface(port, connection.output, *type); break;
      case Connection::Kind::node: check_node_output(port, connection, *type); break;
      case Connection::Kind::output: {
        const auto found = parse_type(connection.target->attribute("type"));
        if (found) check_type(port, *type, *found);
        break;
      }
      case Connection::Kind::none:
        if (port.category() == "output") {
          error("unconnected-output", port, "the output is not connected to anything",
                "nodename or nodegraph");
        }
        break;
      case Connection::Kind::invalid: break;
    }
  }

  bool is_declared_type(std::string_view name) const {
    const Element* found = definitions_.resolve(name, document_.root());
    return found != nullptr && found->category() == "typedef";
  }

  void check_value(const Element& port, Type type) {
    const std::string_view text = port.attribute("value");
    bool leftover = false;  // building warns of it
    if (!parse_value(type, text, &leftover)) {
      error("bad-value", port, fmt::format("the value does not fit the type {}", type_name(type)),
            expected_text(type), fmt::format("'{}'", text.substr(0, 200)));
    }
    const std::string_view unit = port.attribute("unit");
    if (!unit.empty() && !definitions_.unit(unit)) {
      error("unknown-unit", port, "there is no unit of this name", "the name of a <unit>",
            fmt::format("'{}'", unit));
    }
  }

  void check_interface(const Element& port, std::string_view name, Type type) {
    const Element& graph = enclosing_graph(port.category() == "output" ? port : *port.parent());
    Type found = Type::none;
    if (const NodeDef* def = implemented_by(graph)) {
      const NodeDefInput* input = def->input(name);
      if (input != nullptr) return check_type(port, type, input->type);
    } else if (const Element* input = graph.child(name)) {
      found = parse_type(input->attribute("type")).value_or(Type::none);
      if (input->category() == "input") return check_type(port, type, found);
    }
    error("unknown-interface", port, "the graph around it has no such input",
          "the name of an input of the graph", fmt::format("'{}'", name));
  }

  // The nodedef whose inputs the insides of a graph name.
  const NodeDef* implemented_by(const Element& graph) {
    const std::string_view name = graph.attribute("nodedef");
    if (!name.empty()) {
      const NodeDef* def = definitions_.nodedef(qualified_name(graph, name));
      return def != nullptr ? def : definitions_.nodedef(name);
    }
    for (const Element& child : document_.root().children()) {
      if (child.category() != "implementation" || graph.name().empty()) continue;
      if (child.attribute("nodegraph") != graph.name()) continue;
      return definitions_.nodedef(child.attribute("nodedef"));
    }
    return nullptr;
  }

  void check_node_output(const Element& port, const Connection& connection, Type type) {
    Diagnostics elsewhere;  // the node's own check reports these
    const NodeDef* def = find_nodedef(*connection.target, definitions_, elsewhere);
    if (def == nullptr) return;
    if (connection.output.empty() && def->outputs.size() != 1) {
      error("output-required", port,
            fmt::format("'{}' has several outputs and none is named", def->category),
            "output=\"NAME\"");
      return;
    }
    const NodeDefOutput* output =
        connection.output.empty() ? &def->outputs.front() : def->output(connection.output);
    if (output != nullptr) return check_type(port, type, output->type);
    std::string names;
    for (const NodeDefOutput& known : def->outputs) {
      names += (names.empty() ? "" : ", ") + std::string(known.name);
    }
    error("unknown-output", port, fmt::format("'{}' has no such output", def->category), names,
          fmt::format("'{}'", connection.output));
  }

  void check_type(const Element& port, Type wanted, Type found) {
    if (found == wanted || found == Type::none) return;
    if (wanted == Type::filename && found == Type::string) return;
    error("type-mismatch", port, "what is connected here has another type",
          std::string(type_name(wanted)), std::string(type_name(found)));
  }

  void check_graph(const Element& graph) {
    check_scope(graph);
    const std::string_view name = graph.attribute("nodedef");
    if (name.empty()) return;
    const NodeDef* def = implemented_by(graph);
    if (def == nullptr) {
      error("unknown-nodedef", graph, "the nodedef to implement does not exist",
            "the name of a nodedef", fmt::format("'{}'", name));
    } else {
      check_outputs(graph, *def);
    }
  }

  void check_outputs(const Element& graph, const NodeDef& def) {
    for (const NodeDefOutput& output : def.outputs) {
      const Element* port = graph.child(output.member.port);
      if (port == nullptr || port->category() != "output") {
        error("missing-output", graph,
              fmt::format("the graph lacks an output of the nodedef '{}' that it implements",
                          def.name),
              fmt::format("output '{}'", output.name));
      } else if (output.member.leaf == 0 && port->attribute("type") != output.type_text) {
        error("type-mismatch", *port, "the output has another type than in the nodedef",
              std::string(output.type_text), std::string(port->attribute("type")));
      }
    }
  }

  void check_implementation(const Element& element) {
    const std::string_view name = element.attribute("nodedef");
    if (definitions_.nodedef(qualified_name(element, name)) == nullptr &&
        definitions_.nodedef(name) == nullptr) {
      error("unknown-nodedef", element, "the nodedef to implement does not exist",
            "the name of a nodedef", fmt::format("'{}'", name));
    }
    const std::string_view graph = element.attribute("nodegraph");
    if (graph.empty()) return;
    const Element* found = definitions_.resolve(graph, element);
    if (found == nullptr || found->category() != "nodegraph") {
      error("unknown-nodegraph", element, "there is no node graph of this name",
            "the name of a node graph", fmt::format("'{}'", graph));
    }
  }

  void check_nodedef(const Element& element) {
    if (element.attribute("node").empty()) {
      error("missing-node", element, "the nodedef does not say which node it defines",
            "node=\"CATEGORY\"");
      return;
    }
    const NodeDef* def = definitions_.nodedef(element.name());
    if (def == nullptr) return;
    if (def->element != &element) {
      diagnostics_.warning("shadowed-nodedef", location(element),
                           "a library has a nodedef of this name, which is used instead");
      return;
    }
    if (def->outputs.empty()) {
      error("missing-output", element, "the nodedef has no output", "an <output>");
    }
    for (const NodeDefInput& input : def->inputs) {
      if (!input.defaultgeomprop.empty() &&
          definitions_.geompropdef(input.defaultgeomprop) == nullptr) {
        error("unknown-geomprop", *input.element, "there is no geometric property of this name",
              "the name of a <geompropdef>", fmt::format("'{}'", input.defaultgeomprop));
      }
      check_declared_type(*input.element, input.type, input.type_text);
    }
    for (const NodeDefOutput& output : def->outputs) {
      check_declared_type(*output.element, output.type, output.type_text);
    }
  }

  void check_declared_type(const Element& port, Type type, std::string_view text) {
    if (type != Type::none || text == "none" || is_declared_type(text)) return;
    error("unknown-type", port, "there is no type of this name", "a standard type",
          fmt::format("'{}'", text));
  }

  void check_look(const Element& look) {
    for (const Element& child : look.children()) {
      if (child.category() != "materialassign") continue;
      const std::string_view name = child.attribute("material");
      if (definitions_.resolve(name, child) != nullptr) continue;
      error("unknown-material", child, "there is no material of this name",
            "the name of a material", fmt::format("'{}'", name));
    }
  }

  void error(std::string code, const Element& element, std::string message,
             std::string expected = {}, std::string found = {}) {
    diagnostics_.error(std::move(code), location(element), std::move(message), std::move(expected),
                       std::move(found));
  }

  const Document& document_;
  const Definitions& definitions_;
  Diagnostics& diagnostics_;
};

void build_everything(const Document& document, const Definitions& definitions,
                      const GraphOptions& options, Diagnostics& diagnostics) {
  for (const FoundOutput& output : find_outputs(document)) {
    build_graph(document, definitions, {{output.name}, ""}, options, diagnostics);
  }
  for (const FoundMaterial& material : find_materials(document)) {
    build_graph(document, definitions, {{}, material.name}, options, diagnostics);
  }
  for (const FoundOutput& shader : find_loose_shaders(document, definitions)) {
    build_graph(document, definitions, {{shader.name}, ""}, options, diagnostics);
  }
}

}  // namespace

bool check_document(const Document& document, const Library& library, const GraphOptions& options,
                    Diagnostics& diagnostics) {
  Diagnostics found;
  const Definitions definitions(document, &library.definitions(), found);
  Checker(document, definitions, found).check_all();
  // Building meets the same faults again wherever something depends on them;
  // what it alone can find is worth looking for only in a sound document.
  if (!found.has_errors()) build_everything(document, definitions, options, found);
  std::set<std::tuple<std::string, std::string, int, std::string, std::string>> seen;
  for (const Diagnostic& one : found.all()) {
    const SourceLocation& at = one.where;
    if (seen.emplace(one.code, at.file, at.line, at.path, one.message).second) diagnostics.add(one);
  }
  return !found.has_errors();
}

}  // namespace nacre
