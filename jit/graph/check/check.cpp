#include "jit/graph/check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "jit/document/inheritance.h"
#include "jit/document/read.h"
#include "jit/document/select.h"
#include "jit/document/value_text.h"
#include "jit/graph/check/parts.h"
#include "jit/graph/find.h"
#include "jit/graph/resolve/connection.h"
#include "jit/graph/resolve/lenient.h"
#include "runtime/float_environment.h"

namespace nacre {

namespace {

class Checker : ElementCheck {
 public:
  Checker(const Document& document, const Definitions& definitions, bool lenient,
          Diagnostics& diagnostics)
      : ElementCheck(diagnostics, lenient), document_(document), definitions_(definitions) {}

  void check_all() {
    check_structure(document_, definitions_, lenient_, diagnostics_);
    check_declarations(document_, definitions_, lenient_, diagnostics_);
    check_scope(document_.root());
    for (const Element& child : document_.root().children()) {
      if (child.category() == "nodegraph") check_graph(child);
    }
    check_looks(document_, definitions_, diagnostics_);
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
        } else if (child.category() == "token") {
          check_token(child);
        } else if (is_node(child)) {
          check_node(child);
        } else if (child.category() == "nodegraph" && scope.parent() != nullptr) {
          scopes.push_back(&child);
        }
      }
    }
  }

  void check_node(const Element& node) {
    const NodeDef* def = nodedef_of(node);
    if (node.name().empty() && def != nullptr) {
      error("missing-name", node, "the node has no name", "a name");
    }
    if (def != nullptr && def->category != node.category() &&
        def->category != qualified_name(node, node.category())) {
      diagnostics_.warning("nodedef-mismatch", location(node),
                           fmt::format("the nodedef '{}' is of another node", def->name),
                           fmt::format("<{}>", def->category),
                           fmt::format("<{}>", node.category()));
    }
    for (const Element& child : node.children()) {
      if (child.category() == "token") check_token(child);
      if (child.category() != "input") continue;
      // What is left out may say anything.
      const bool is_left_out = lenient_ && def != nullptr && !child.name().empty() &&
                               def->input_type(child.name()).empty() && child.name() != "disable";
      if (is_left_out) continue;
      check_port(child);
      const NodeDefInput* input = def == nullptr ? nullptr : def->input(child.name());
      if (input != nullptr) check_enum(child, *input);
    }
    node_inheritance(node, diagnostics_);
    if (node.attribute("type") == "material" && node.category() == "surfacematerial" &&
        node.child_count() == 0 && !node.has_attribute("inherit")) {
      diagnostics_.warning("empty-material", location(node), "the material has no shader",
                           "an <input> connected to a surface or displacement shader");
    }
  }

  // An input whose type is the name of none is reported as such, once.
  const NodeDef* nodedef_of(const Element& node) {
    Diagnostics found;
    const NodeDef* def = find_nodedef(node, definitions_, found, lenient_ ? stands_for : nullptr);
    for (const Diagnostic& one : found.all()) {
      const auto has_bad_type = [&](const Element& child) {
        const std::string_view type = child.attribute("type");
        return child.category() == "input" && location(child).path == one.where.path &&
               !parse_type(type) && !is_declared_type(type, child, definitions_);
      };
      const ElementRange children = node.children();
      const bool is_doubled =
          one.code == "input-type" && std::any_of(children.begin(), children.end(), has_bad_type);
      if (!is_doubled) diagnostics_.add(one);
    }
    return def;
  }

  void check_enum(const Element& port, const NodeDefInput& input) {
    if (input.type != Type::string || input.enums.empty() || !port.has_attribute("value")) return;
    const std::string_view text = port.attribute("value");
    const std::vector<std::string_view> values = split_list(input.enum_values);
    for (const auto* list : {&input.enums, &values}) {
      if (std::find(list->begin(), list->end(), text) != list->end()) return;
    }
    const std::string message = fmt::format("'{}' does not take this value", input.name);
    const std::string expected = fmt::format("{}", fmt::join(input.enums, ", "));
    if (text.empty() && input.has_default) {
      tolerable("bad-enum", port, message, "the default is used", expected, "''");
    } else {
      error("bad-enum", port, message, expected, fmt::format("'{}'", text));
    }
  }

  void check_port(const Element& port) {
    if (!check_type_name(port, definitions_, diagnostics_)) return;
    const auto type = parse_type(port.attribute("type"));
    if (!type) return;  // a type of the document's own
    const Connection connection = find_connection(port, diagnostics_, lenient_);
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
          const std::string message = "the output is not connected to anything";
          if (is_numeric(*type)) {
            tolerable("unconnected-output", port, message, "it is zero", "nodename or nodegraph");
          } else {
            error("unconnected-output", port, message, "nodename or nodegraph");
          }
        }
        break;
      case Connection::Kind::invalid: break;
    }
  }

  void check_value(const Element& port, Type type) {
    const std::string_view text = port.attribute("value");
    bool leftover = false;
    if (!parse_value(type, text, &leftover)) {
      const bool is_connection = !is_numeric(type) && !is_text(type) && !is_array(type);
      const auto guess = parse_lenient(type, text);
      const std::string message =
          fmt::format("the value does not fit the type {}", type_name(type));
      if (is_connection || guess) {
        tolerable("bad-value", port, message,
                  is_connection ? "it is not used" : lenient_reading(*guess), expected_text(type),
                  in_quotes(text));
      } else {
        error("bad-value", port, message, expected_text(type), in_quotes(text));
      }
    } else if (leftover) {
      diagnostics_.warning("number-leftover", location(port),
                           "what follows a number in the value is not used", expected_text(type),
                           in_quotes(text));
    }
    check_unit(port, type);
    if (type == Type::filename) check_tokens(port, text);
  }

  void check_token(const Element& token) {
    if (!check_type_name(token, definitions_, diagnostics_)) return;
    const auto type = parse_type(token.attribute("type"));
    if (!type || !token.has_attribute("value")) return;
    if (parse_value(*type, token.attribute("value"))) return;
    error("bad-value", token, fmt::format("the value does not fit the type {}", type_name(*type)),
          expected_text(*type), in_quotes(token.attribute("value")));
  }

  void check_unit(const Element& port, Type type) {
    const std::string_view name = port.attribute("unit");
    if (name.empty()) return;
    const auto unit = definitions_.unit(name);
    const std::string_view wanted = port.attribute("unittype");
    if (!unit) {
      error("unknown-unit", port, "there is no unit of this name", "the name of a <unit>",
            in_quotes(name));
    } else if (!wanted.empty() && unit->type != wanted) {
      error("unit-type", port, "the unit is not of the type that unittype says",
            fmt::format("a unit of type {}", wanted),
            fmt::format("'{}', of type {}", name, unit->type));
    } else if (type != Type::float_ && type != Type::vector2 && type != Type::vector3 &&
               type != Type::vector4 && type != Type::filename) {
      diagnostics_.warning("unit-unused", location(port),
                           fmt::format("values of type {} have no unit", type_name(type)),
                           "float, vector2, vector3, vector4 or filename", in_quotes(name));
    }
  }

  // "[name]" in a file name is a token of an element around it, or of the nodedef
  // that the graph around it implements (Specification, "Filename Substitutions").
  void check_tokens(const Element& port, std::string_view text) {
    for (std::size_t at = text.find('['); at != std::string_view::npos; at = text.find('[', at)) {
      const std::size_t end = text.find(']', ++at);
      if (end == std::string_view::npos) return;
      const std::string_view name = text.substr(at, end - at);
      if (!is_valid_name(name) || has_token(port, name)) continue;
      diagnostics_.warning("unknown-token", location(port),
                           "there is no token of this name, so the file name keeps it as it is",
                           "the name of a <token> around it", in_quotes(name));
    }
  }

  bool has_token(const Element& port, std::string_view name) {
    const auto is_token = [&](const Element* scope) {
      const Element* found = scope == nullptr ? nullptr : scope->child(name);
      return found != nullptr && found->category() == "token";
    };
    for (const Element* at = &port; at != nullptr; at = at->parent()) {
      if (is_token(at)) return true;
      const NodeDef* def =
          at->category() == "nodegraph" ? definitions_.implemented_by(*at) : nullptr;
      if (def != nullptr && is_token(def->element)) return true;
    }
    return false;
  }

  void check_interface(const Element& port, std::string_view name, Type type) {
    const Element& graph = enclosing_graph(port.category() == "output" ? port : *port.parent());
    Type found = Type::none;
    if (const NodeDef* def = definitions_.implemented_by(graph)) {
      const NodeDefInput* input = def->input(name);
      if (input != nullptr) return check_type(port, type, input->type);
    } else if (const Element* input = graph.child(name)) {
      found = parse_type(input->attribute("type")).value_or(Type::none);
      if (input->category() == "input") return check_type(port, type, found);
    }
    const std::string message = "the graph around it has no such input";
    const std::string expected = "the name of an input of the graph";
    if (port.category() == "input" && is_node(*port.parent())) {
      tolerable("unknown-interface", port, message,
                port.has_attribute("value") ? "its value is used" : "the default is used", expected,
                fmt::format("'{}'", name));
    } else {
      error("unknown-interface", port, message, expected, fmt::format("'{}'", name));
    }
  }

  void check_node_output(const Element& port, const Connection& connection, Type type) {
    Diagnostics elsewhere;  // the node's own check reports these
    const NodeDef* def =
        find_nodedef(*connection.target, definitions_, elsewhere, lenient_ ? stands_for : nullptr);
    if (def == nullptr) return;
    if (connection.output.empty() && def->outputs.size() != 1) {
      const bool takes_first = lenient_ && !def->outputs.empty();
      tolerable("output-required", port,
                fmt::format("'{}' has several outputs and none is named", def->category),
                "the first is taken", "output=\"NAME\"",
                takes_first ? fmt::format("taken: '{}'", def->outputs[0].name) : "");
      if (!takes_first) return;
    }
    const NodeDefOutput* output =
        connection.output.empty() ? &def->outputs.front() : def->output(connection.output);
    if (output != nullptr) return check_type(port, type, output->type);
    std::string names;
    for (const NodeDefOutput& known : def->outputs) {
      names += (names.empty() ? "" : ", ") + std::string(known.name);
    }
    const std::string message = fmt::format("'{}' has no such output", def->category);
    const std::string found = fmt::format("'{}'", connection.output);
    if (def->outputs.size() == 1) {
      tolerable("unknown-output", port, message, "its only one is taken", names, found);
      if (lenient_) check_type(port, type, def->outputs[0].type);
    } else {
      error("unknown-output", port, message, names, found);
    }
  }

  void check_type(const Element& port, Type wanted, Type found) {
    if (found == wanted || found == Type::none) return;
    if (wanted == Type::filename && found == Type::string) return;
    const std::string message = "what is connected here has another type";
    if (stands_for(found, wanted)) {
      tolerable("type-mismatch", port, message, "it is converted", std::string(type_name(wanted)),
                std::string(type_name(found)));
    } else {
      error("type-mismatch", port, message, std::string(type_name(wanted)),
            std::string(type_name(found)));
    }
  }

  void check_graph(const Element& graph) {
    check_scope(graph);
    const std::string_view name = graph.attribute("nodedef");
    const NodeDef* def = definitions_.implemented_by(graph);
    if (def != nullptr) {
      check_outputs(graph, *def);
      check_inputs(graph, *def);
      check_extra_outputs(graph, *def);
    } else if (!name.empty()) {
      tolerable("unknown-nodedef", graph, "the nodedef to implement does not exist",
                "nothing can use it", "the name of a nodedef", in_quotes(name));
    }
  }

  // Nothing can read them: instances have the outputs of the nodedef.
  void check_extra_outputs(const Element& graph, const NodeDef& def) {
    for (const Element& child : graph.children()) {
      if (child.category() != "output" || child.name().empty()) continue;
      if (def.output(child.name()) != nullptr) continue;
      diagnostics_.warning("extra-output", location(child),
                           fmt::format("'{}' has no such output, so nothing can read it", def.name),
                           "the name of an output of the nodedef", in_quotes(child.name()));
    }
  }

  // Instances never see them (Specification, "Functional Nodegraphs").
  void check_inputs(const Element& graph, const NodeDef& def) {
    for (const Element& child : graph.children()) {
      if (child.category() != "input") continue;
      diagnostics_.warning(
          "interface-of-nodedef", location(child),
          fmt::format("the inputs of this graph are those of '{}', and this one is not used",
                      def.name),
          "an <input> of the nodedef");
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

  const Document& document_;
  const Definitions& definitions_;
};

}  // namespace

bool check_document(const Document& document, const Library& library, const GraphOptions& options,
                    Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  Diagnostics found;
  const Definitions definitions(document, &library.definitions(), found);
  Checker(document, definitions, options.lenient, found).check_all();
  // Building meets the same faults again wherever something depends on them;
  // what it alone can find is worth looking for only in a sound document.
  if (!found.has_errors()) try_all_graphs(document, definitions, options, found);
  std::set<std::tuple<std::string, std::string, int, std::string, std::string>> seen;
  for (const Diagnostic& one : found.all()) {
    const SourceLocation& at = one.where;
    if (seen.emplace(one.code, at.file, at.line, at.path, one.message).second) diagnostics.add(one);
  }
  return !found.has_errors();
}

}  // namespace nacre
