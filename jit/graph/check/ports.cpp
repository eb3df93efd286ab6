// What <input>, <output> and <token> elements are connected to, or say.
#include <fmt/format.h>

#include "jit/document/names.h"
#include "jit/document/select.h"
#include "jit/document/value_text.h"
#include "jit/graph/check/parts.h"
#include "jit/graph/resolve/feed.h"
#include "jit/graph/resolve/lenient.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

class PortCheck : ElementCheck {
 public:
  PortCheck(const Definitions& definitions, bool lenient, Diagnostics& diagnostics)
      : ElementCheck(diagnostics, lenient), definitions_(definitions) {}

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

 private:
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

  void check_unit(const Element& port, Type type) {
    const std::string_view name = port.attribute("unit");
    if (name.empty()) return;
    const auto unit = definitions_.unit(name);
    const std::string_view wanted = port.attribute("unittype");
    if (!unit) {
      error("unknown-unit", port, "there is no unit of this name", "the name of a <unit>",
            in_quotes(name), near_hint(diagnostics_, name, definitions_.unit_names()));
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
    Complaints complaints(diagnostics_, lenient_);
    without_interface(port, true, complaints);
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
    const std::string hint = near_hint(diagnostics_, connection.output, def->outputs,
                                       [](const NodeDefOutput& known) { return known.name; });
    if (def->outputs.size() == 1) {
      tolerable("unknown-output", port, message, "its only one is taken", names, found, hint);
      if (lenient_) check_type(port, type, def->outputs[0].type);
    } else {
      error("unknown-output", port, message, names, found, hint);
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

  const Definitions& definitions_;
};

}  // namespace

void check_port(const Element& port, const Definitions& definitions, bool lenient,
                Diagnostics& diagnostics) {
  PortCheck(definitions, lenient, diagnostics).check_port(port);
}

void check_token(const Element& token, const Definitions& definitions, Diagnostics& diagnostics) {
  if (!check_type_name(token, definitions, diagnostics)) return;
  const auto type = parse_type(token.attribute("type"));
  if (!type || !token.has_attribute("value")) return;
  if (parse_value(*type, token.attribute("value"))) return;
  diagnostics.error("bad-value", location(token),
                    fmt::format("the value does not fit the type {}", type_name(*type)),
                    expected_text(*type), in_quotes(token.attribute("value")));
}

}  // namespace nacre
