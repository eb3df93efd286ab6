// What nodedefs declare.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <vector>

#include "jit/document/names.h"
#include "jit/graph/check/parts.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

class NodeDefCheck : ElementCheck {
 public:
  NodeDefCheck(const Document& document, const Definitions& definitions, bool lenient,
               Diagnostics& diagnostics)
      : ElementCheck(diagnostics, lenient), document_(document), definitions_(definitions) {}

  void run() {
    for (const Element& child : document_.root().children()) {
      if (child.category() == "nodedef") check_nodedef(child);
    }
  }

 private:
  void check_nodedef(const Element& element) {
    if (element.attribute("node").empty()) {
      tolerable("missing-node", element, "the nodedef does not say which node it defines",
                "nothing can use it", "node=\"CATEGORY\"");
      return;
    }
    if (!is_valid_name(element.attribute("node"))) {
      error("invalid-name", element, "this is not a valid name of a node",
            "letters, digits and '_', not starting with a digit",
            in_quotes(element.attribute("node")));
    }
    const NodeDef* def = definitions_.nodedef(element.name());
    // Of a library's name the definitions have complained.
    if (def == nullptr || def->element != &element) return;
    if (def->outputs.empty()) {
      error("missing-output", element, "the nodedef has no output", "an <output>");
    }
    for (const NodeDefInput& input : def->inputs) {
      if (input.element->parent() == &element) check_input(input);
    }
    for (const NodeDefOutput& output : def->outputs) {
      if (output.element->parent() == &element) check_output(*def, output);
    }
    check_inherited(*def);
    check_overload(*def);
  }

  // An heir's instances stand for its base's: what has the same name is the same.
  void check_inherited(const NodeDef& def) {
    const std::string_view name = def.element->attribute("inherit");
    const NodeDef* base = definitions_.nodedef(qualified_name(*def.element, name));
    if (base == nullptr) base = definitions_.nodedef(name);
    if (base == nullptr) return;
    for (const NodeDefInput& input : def.inputs) {
      const NodeDefInput* inherited = base->input(input.name);
      if (inherited == nullptr || inherited->type_text == input.type_text) continue;
      warning("inherited-type", *input.element,
              fmt::format("the input has another type than in '{}'", base->name),
              std::string(inherited->type_text), std::string(input.type_text));
    }
  }

  void check_input(const NodeDefInput& input) {
    const Element& element = *input.element;
    if (!check_type_name(element, definitions_, diagnostics_)) return;
    for (std::string_view way : {"nodename", "nodegraph", "interfacename"}) {
      if (!element.has_attribute(way)) continue;
      error("connected-declaration", element, "an input of a nodedef cannot be connected",
            "value or defaultgeomprop",
            fmt::format("{}={}", way, in_quotes(element.attribute(way))));
    }
    check_geomprop(input);
    check_enums(input);
    check_unit(input);
  }

  void check_geomprop(const NodeDefInput& input) {
    if (input.defaultgeomprop.empty()) return;
    const Element* geomprop = definitions_.geompropdef(input.defaultgeomprop);
    if (geomprop == nullptr) {
      error("unknown-geomprop", *input.element, "there is no geometric property of this name",
            "the name of a <geompropdef>", in_quotes(input.defaultgeomprop),
            near_hint(diagnostics_, input.defaultgeomprop, definitions_.geompropdef_names()));
    } else if (geomprop->attribute("type") != input.type_text) {
      error("type-mismatch", *input.element, "the geometric property has another type",
            std::string(input.type_text), std::string(geomprop->attribute("type")));
    }
  }

  void check_enums(const NodeDefInput& input) {
    if (input.enum_values.empty() && input.enums.empty()) return;
    const std::size_t each = is_numeric(input.type) ? component_count(input.type) : 1;
    const std::size_t values = split_list(input.enum_values).size();
    if (!input.enum_values.empty() && values != input.enums.size() * each) {
      error("bad-enum", *input.element, "enum and enumvalues do not belong together",
            fmt::format("{} values", input.enums.size() * each), fmt::format("{}", values));
      return;
    }
    if (input.type != Type::string || !input.has_default) return;
    const std::string& text = input.default_value.texts[0];
    const auto labels = input.enums;
    const auto stored = split_list(input.enum_values);
    for (const auto* list : {&labels, &stored}) {
      if (std::find(list->begin(), list->end(), text) != list->end()) return;
    }
    error("bad-enum", *input.element, "the default is none of the values the input takes",
          fmt::format("{}", fmt::join(input.enums, ", ")), in_quotes(text));
  }

  void check_unit(const NodeDefInput& input) {
    if (input.unit.empty()) return;
    const auto unit = definitions_.unit(input.unit);
    if (!unit) {
      error("unknown-unit", *input.element, "there is no unit of this name", "the name of a <unit>",
            in_quotes(input.unit), near_hint(diagnostics_, input.unit, definitions_.unit_names()));
    } else if (!input.unit_type.empty() && unit->type != input.unit_type) {
      error("unit-type", *input.element, "the unit is not of the type that unittype says",
            fmt::format("a unit of type {}", input.unit_type),
            fmt::format("'{}', of type {}", input.unit, unit->type));
    }
  }

  void check_output(const NodeDef& def, const NodeDefOutput& output) {
    const Element& element = *output.element;
    if (!check_type_name(element, definitions_, diagnostics_)) return;
    if (is_array(output.type)) {
      error("array-output", element, "an output cannot be an array", "a single value",
            std::string(output.type_text));
    }
    if (output.defaultinput.empty()) return;
    const NodeDefInput* input = def.input(output.defaultinput);
    if (input == nullptr) {
      error("unknown-input", element, "the nodedef has no input of this name to pass through",
            "the name of an input", in_quotes(output.defaultinput),
            near_hint(diagnostics_, output.defaultinput, def.inputs,
                      [](const NodeDefInput& each) { return each.name; }));
    } else if (input->type_text != output.type_text) {
      error("type-mismatch", element, "the input to pass through has another type",
            std::string(output.type_text), std::string(input->type_text));
    }
  }

  // Instances cannot tell two nodedefs apart that differ in nothing they say.
  void check_overload(const NodeDef& def) {
    std::string signature =
        fmt::format("{}|{}|{}|{}", def.category, def.instance_type(),
                    def.is_default_version ? "default" : def.version, def.target);
    std::vector<std::string> ports;
    for (const NodeDefInput& input : def.inputs) {
      ports.push_back(fmt::format("|{}:{}", input.name, input.type_text));
    }
    std::sort(ports.begin(), ports.end());
    for (const std::string& port : ports) signature += port;
    const auto [place, is_new] = signatures_.emplace(std::move(signature), &def);
    if (is_new) return;
    warning("ambiguous-nodedef", *def.element,
            "no instance can mean this nodedef without naming it",
            fmt::format("other inputs than those of '{}'", place->second->name));
  }

  const Document& document_;
  const Definitions& definitions_;
  std::unordered_map<std::string, const NodeDef*> signatures_;
};

}  // namespace

void check_nodedefs(const Document& document, const Definitions& definitions, bool lenient,
                    Diagnostics& diagnostics) {
  NodeDefCheck(document, definitions, lenient, diagnostics).run();
}

}  // namespace nacre
