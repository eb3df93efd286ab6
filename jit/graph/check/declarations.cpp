// What a document declares for its nodes to use.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>
#include <vector>

#include "jit/document/circles.h"
#include "jit/document/inheritance.h"
#include "jit/document/read.h"
#include "jit/document/value_text.h"
#include "jit/graph/check/parts.h"

namespace nacre {

namespace {

class DeclarationCheck : ElementCheck {
 public:
  DeclarationCheck(const Document& document, const Definitions& definitions, bool lenient,
                   Diagnostics& diagnostics)
      : ElementCheck(diagnostics, lenient), document_(document), definitions_(definitions) {}

  void run() {
    find_type_circles();
    for (const Element& child : document_.root().children()) {
      const std::string_view category = child.category();
      if (category == "nodedef") check_nodedef(child);
      if (category == "implementation") check_implementation(child);
      if (category == "nodegraph" && child.has_attribute("nodedef")) check_only_one(child);
      if (category == "typedef") check_typedef(child);
      if (category == "unitdef") check_unitdef(child);
      if (category == "geompropdef") check_geompropdef(child);
      if (category == "attributedef") check_attributedef(child);
      if (category == "targetdef") check_targetdef(child);
    }
  }

 private:
  // -- Nodedefs --

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
            "the name of a <geompropdef>", in_quotes(input.defaultgeomprop));
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
            in_quotes(input.unit));
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
            "the name of an input", in_quotes(output.defaultinput));
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

  // -- Implementations --

  void check_implementation(const Element& element) {
    const std::string_view name = element.attribute("nodedef");
    if (name.empty()) {
      // With a target alone it is a remark (as the data library has them).
      if (!element.has_attribute("nodegraph")) return;
      error("missing-nodedef", element, "the implementation does not say of what",
            "nodedef=\"NAME\"");
    }
    const NodeDef* def = named_nodedef(element);
    if (!name.empty() && def == nullptr) {
      tolerable("unknown-nodedef", element, "the nodedef to implement does not exist",
                "nothing can use it", "the name of a nodedef", in_quotes(name));
    }
    if (def != nullptr) check_renamed_ports(element, *def);
    const std::string_view graph = element.attribute("nodegraph");
    if (graph.empty()) return;
    const Element* found = definitions_.resolve(graph, element);
    if (found == nullptr || found->category() != "nodegraph") {
      error("unknown-nodegraph", element, "there is no node graph of this name",
            "the name of a node graph", in_quotes(graph));
      return;
    }
    check_only_one(element);
  }

  void check_renamed_ports(const Element& element, const NodeDef& def) {
    for (const Element& child : element.children()) {
      if (child.category() != "input" || !def.input_type(child.name()).empty()) continue;
      error("unknown-input", child, fmt::format("'{}' has no input of this name", def.name),
            "the name of an input", in_quotes(child.name()));
    }
  }

  // Of several graphs for one nodedef the first counts, those of libraries before all.
  void check_only_one(const Element& element) {
    const NodeDef* def = named_nodedef(element);
    if (def == nullptr || !is_for_us(element.attribute("target"))) return;
    const Element* own = element.category() == "nodegraph"
                             ? &element
                             : definitions_.resolve(element.attribute("nodegraph"), element);
    const Element* used = definitions_.graph_of(*def);
    if (used == nullptr || used == own) return;
    warning("ambiguous-implementation", element,
            fmt::format("'{}' has another implementation, which is used instead", def->name),
            "one for each nodedef", in_quotes(used->name()));
  }

  const NodeDef* named_nodedef(const Element& element) const {
    const std::string_view name = element.attribute("nodedef");
    const NodeDef* def = definitions_.nodedef(qualified_name(element, name));
    return def != nullptr ? def : definitions_.nodedef(name);
  }

  // -- Types, units, properties, targets --

  void check_typedef(const Element& element) {
    const std::size_t errors = diagnostics_.error_count();
    const auto base_of = [&](const Element& heir) -> const Element* {
      const std::string_view name = heir.attribute("inherit");
      if (!heir.has_attribute("inherit") || parse_type(name)) return nullptr;
      const Element* base = definitions_.resolve(name, element);
      if (base != nullptr && base->category() == "typedef") return base;
      error("unknown-type", heir, "the type to inherit from does not exist", "the name of a type",
            in_quotes(name));
      return nullptr;
    };
    inheritance_chain(element, "type", base_of, diagnostics_);
    if (diagnostics_.error_count() != errors) return;
    for (const Element& member : element.children()) {
      if (member.category() == "member") check_member(element, member);
    }
  }

  void check_member(const Element& owner, const Element& member) {
    if (!check_type_name(member, definitions_, diagnostics_)) return;
    const Element* held = named_typedef(member.attribute("type"), owner);
    if (held != nullptr && circles_.at(held) == circles_.at(&owner)) {
      error("type-cycle", member, "the type contains itself, directly or not", "",
            in_quotes(member.attribute("type")));
      return;
    }
    const auto type = parse_type(member.attribute("type"));
    if (!type || !member.has_attribute("value")) return;
    if (parse_value(*type, member.attribute("value"))) return;
    error("bad-value", member, fmt::format("the value does not fit the type {}", type_name(*type)),
          expected_text(*type), in_quotes(member.attribute("value")));
  }

  const Element* named_typedef(std::string_view name, const Element& user) const {
    const Element* found = definitions_.resolve(name, user);
    return found != nullptr && found->category() == "typedef" ? found : nullptr;
  }

  std::vector<const Element*> held_by(const Element& type) const {
    std::vector<const Element*> types;
    for (const Element& member : type.children()) {
      const Element* found = named_typedef(member.attribute("type"), type);
      if (found != nullptr) types.push_back(found);
    }
    return types;
  }

  void find_type_circles() {
    std::vector<const Element*> types;
    for (const Element& child : document_.root().children()) {
      if (child.category() == "typedef") types.push_back(&child);
    }
    circles_ = find_circles(types, [this](const Element& one) { return held_by(one); });
  }

  void check_unitdef(const Element& element) {
    const std::string_view kind = element.attribute("unittype");
    if (kind.empty()) {
      error("missing-unittype", element, "the units have no type", "unittype=\"NAME\"");
    } else {
      const Element* found = definitions_.resolve(kind, element);
      if (found == nullptr || found->category() != "unittypedef") {
        error("unknown-unittype", element, "there is no unit type of this name",
              "the name of a <unittypedef>", in_quotes(kind));
      }
    }
    for (const Element& unit : element.children()) {
      if (unit.category() == "unit") check_unit(unit);
    }
  }

  void check_unit(const Element& unit) {
    const std::string_view text = unit.attribute("scale");
    const auto scale = parse_value(Type::float_, text);
    if (!scale || !(scale->floats[0] > 0)) {
      error("bad-scale", unit, "the scale of a unit is a number above 0", "scale=\"NUMBER\"",
            in_quotes(text));
    }
  }

  void check_geompropdef(const Element& element) {
    if (!check_type_name(element, definitions_, diagnostics_)) return;
    constexpr std::array<std::string_view, 3> spaces{"model", "object", "world"};
    const std::string_view space = element.attribute("space");
    if (!space.empty() && std::find(spaces.begin(), spaces.end(), space) == spaces.end()) {
      error("unknown-space", element, "there is no such space", "model, object or world",
            in_quotes(space));
    }
    const std::string_view index = element.attribute("index");
    if (!element.has_attribute("index")) return;
    const auto number = parse_value(Type::integer, index);
    if (!number || number->ints[0] < 0) {
      error("bad-value", element, "the index does not fit the type integer",
            "a whole number from 0", in_quotes(index));
    }
  }

  void check_attributedef(const Element& element) {
    if (element.attribute("attrname").empty()) {
      error("missing-attrname", element, "the attributedef does not name an attribute",
            "attrname=\"NAME\"");
    }
    check_type_name(element, definitions_, diagnostics_);
  }

  void check_targetdef(const Element& element) {
    const auto base_of = [&](const Element& heir) -> const Element* {
      const Element* base = document_.root().child(heir.attribute("inherit"));
      // Of a library, perhaps.
      return base == nullptr || base->category() != "targetdef" ? nullptr : base;
    };
    inheritance_chain(element, "target", base_of, diagnostics_);
  }

  const Document& document_;
  const Definitions& definitions_;
  std::unordered_map<std::string, const NodeDef*> signatures_;
  std::unordered_map<const Element*, std::size_t> circles_;  ///< Of types that hold types.
};

}  // namespace

void check_declarations(const Document& document, const Definitions& definitions, bool lenient,
                        Diagnostics& diagnostics) {
  DeclarationCheck(document, definitions, lenient, diagnostics).run();
}

bool is_declared_type(std::string_view name, const Element& user, const Definitions& definitions) {
  const Element* found = definitions.resolve(name, user);
  return found != nullptr && found->category() == "typedef";
}

bool check_type_name(const Element& port, const Definitions& definitions,
                     Diagnostics& diagnostics) {
  const std::string_view text = port.attribute("type");
  if (parse_type(text) || (!text.empty() && is_declared_type(text, port, definitions))) return true;
  if (text.empty()) {
    diagnostics.error("missing-type", location(port),
                      fmt::format("the {} has no type", port.category()), "type=\"TYPE\"");
  } else {
    diagnostics.error("unknown-type", location(port), "there is no type of this name",
                      "a standard type or the name of a <typedef>", in_quotes(text));
  }
  return false;
}

}  // namespace nacre
