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
#include "jit/graph/build/try_all_graphs.h"
#include "jit/graph/check/parts.h"
#include "jit/graph/find.h"
#include "jit/graph/resolve/connection.h"
#include "jit/graph/resolve/lenient.h"
#include "runtime/float_environment.h"
#include "runtime/near_names.h"

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
          check_port(child, definitions_, lenient_, diagnostics_);
        } else if (child.category() == "token") {
          check_token(child, definitions_, diagnostics_);
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
      if (child.category() == "token") check_token(child, definitions_, diagnostics_);
      if (child.category() != "input") continue;
      // What is left out may say anything.
      const bool is_left_out = lenient_ && def != nullptr && !child.name().empty() &&
                               def->input_type(child.name()).empty() && child.name() != "disable";
      if (is_left_out) continue;
      check_port(child, definitions_, lenient_, diagnostics_);
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
                "nothing can use it", "the name of a nodedef", in_quotes(name),
                near_hint(diagnostics_, name, definitions_.all(),
                          [](const NodeDef* each) { return each->name; }));
    }
  }

  // Nothing can read them: instances have the outputs of the nodedef.
  void check_extra_outputs(const Element& graph, const NodeDef& def) {
    for (const Element& child : graph.children()) {
      if (child.category() != "output" || child.name().empty()) continue;
      if (def.output(child.name()) != nullptr) continue;
      diagnostics_.warning("extra-output", location(child),
                           fmt::format("'{}' has no such output, so nothing can read it", def.name),
                           "the name of an output of the nodedef", in_quotes(child.name()),
                           near_hint(diagnostics_, child.name(), def.outputs,
                                     [](const NodeDefOutput& each) { return each.name; }));
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
