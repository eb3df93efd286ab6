#include "jit/graph/resolve/literals.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "jit/document/select.h"
#include "jit/document/value_text.h"
#include "jit/graph/resolve/filename.h"
#include "jit/graph/resolve/lenient.h"

namespace nacre {

namespace {

// A range for a slider; type none if there is none or it makes no sense.
Value ui_bound(const Element* input, const Element* declared, Type type, std::string_view soft,
               std::string_view hard) {
  for (const Element* element : {input, declared}) {
    if (element == nullptr) continue;
    for (std::string_view attribute : {soft, hard}) {
      if (!element->has_attribute(attribute)) continue;
      return parse_value(type, element->attribute(attribute)).value_or(Value{});
    }
  }
  return {};
}

// What people are told of a parameter, by who wrote it or else by the nodedef.
Parameter described(const Element* carrier, const NodeDefInput* input, Type type) {
  const Element* declared = input == nullptr ? nullptr : input->element;
  const auto text = [&](const char* attribute) -> std::string {
    for (const Element* element : {carrier, declared}) {
      if (element != nullptr && element->has_attribute(attribute)) {
        return std::string(element->attribute(attribute));
      }
    }
    return {};
  };
  Parameter parameter;
  parameter.type = type;
  parameter.ui_name = text("uiname");
  parameter.ui_folder = text("uifolder");
  parameter.doc = text("doc");
  parameter.ui_min = ui_bound(carrier, declared, type, "uisoftmin", "uimin");
  parameter.ui_max = ui_bound(carrier, declared, type, "uisoftmax", "uimax");
  return parameter;
}

// Whether an input takes a string; one without an enumeration takes all.
bool takes(const NodeDefInput& input, std::string_view text) {
  if (input.type != Type::string || input.enums.empty()) return true;
  const std::vector<std::string_view> values = split_list(input.enum_values);
  for (const auto* list : {&input.enums, &values}) {
    if (std::find(list->begin(), list->end(), text) != list->end()) return true;
  }
  return false;
}

// Whether the input of a nodedef lists its own default among what it takes.
bool lists(const Element& input, std::string_view text) {
  if (input.category() != "input" || input.parent()->category() != "nodedef") return false;
  const std::vector<std::string_view> listed = split_list(input.attribute("enum"));
  return std::ranges::find(listed, text) != listed.end();
}

std::string default_text(const NodeDefInput& input) {
  return input.default_value.texts.empty() ? "" : input.default_value.texts[0];
}

}  // namespace

void Literals::take(const Element& carrier, Type type, const Context* context, Resolved& result) {
  result.type = type;
  result.carrier = &carrier;
  result.unit = carrier.attribute("unit");
  const std::string_view text = carrier.attribute("value");
  bool leftover = false;
  std::optional<Value> value = parse_value(type, text, &leftover);
  if (leftover) {
    complaints_.warning("number-leftover", carrier,
                        "what follows a number in the value is not used", expected_text(type),
                        fmt::format("'{}'", text.substr(0, 200)));
  }
  if (!value) {
    const bool is_connection = !is_numeric(type) && !is_text(type) && !is_array(type);
    const auto guess = parse_lenient(type, text);
    const std::string message = fmt::format("the value does not fit the type {}", type_name(type));
    const std::string found = fmt::format("'{}'", text.substr(0, 200));
    if (!is_connection && !guess) {
      complaints_.error("bad-value", carrier, message, expected_text(type), found);
      result.failed = true;
      return;
    }
    result.failed = !complaints_.tolerates(
        "bad-value", carrier, message, is_connection ? "it is not used" : lenient_reading(*guess),
        expected_text(type), found);
    if (result.failed || is_connection) return;
    value = guess;
  }
  // "" on a closure or shader means that nothing is connected.
  if (!is_numeric(type) && !is_text(type) && !is_array(type)) return;
  result.source = type == Type::filename
                      ? file_name(carrier, *value, context)
                      : literal_or_parameter(carrier, std::move(*value), result.unit);
}

void Literals::take_leaf(const Element& carrier, std::size_t number, Resolved& result) const {
  const StructType* type =
      implementations_.definitions_of(carrier).struct_type(carrier.attribute("type"));
  const std::string_view text = carrier.attribute("value");
  const auto values = split_struct_value(text);
  const bool fits = type != nullptr && number < type->leaves.size() &&
                    (text.empty() || (values && values->size() == type->leaves.size()));
  std::optional<Value> value;
  if (fits) {
    const StructType::Leaf& leaf = type->leaves[number];
    result.type = leaf.type;
    value = parse_value(leaf.type,
                        text.empty() ? std::string_view(leaf.default_text) : (*values)[number]);
    if (!value && text.empty()) value = zero_value(leaf.type);
  }
  if (!value) {
    complaints_.error("bad-value", carrier,
                      fmt::format("the value does not fit the type {}", carrier.attribute("type")),
                      "a structure's members between braces",
                      fmt::format("'{}'", text.substr(0, 200)));
    result.failed = true;
    return;
  }
  result.source.kind = Source::Kind::literal;
  result.source.value = std::move(*value);
  result.carrier = &carrier;
}

Source Literals::literal_or_parameter(const Element& carrier, Value value, std::string_view unit) {
  Source source;
  const bool is_live = is_numeric(value.type) && &carrier.document() == &document_ &&
                       carrier.category() == "input" && carrier.attribute("uniform") != "true";
  if (!is_live) {
    source.kind = Source::Kind::literal;
    source.value = std::move(value);
    return source;
  }
  source.kind = Source::Kind::parameter;
  const auto next = static_cast<std::uint32_t>(graph_.parameters.size());
  const auto [place, is_new] = parameters_.emplace(&carrier, next);
  source.parameter = place->second;
  if (!is_new) return source;

  const Element& owner = *carrier.parent();
  const NodeDef* def = is_node(owner) ? implementations_.nodedef_of(owner) : nullptr;
  const NodeDefInput* input = def == nullptr ? nullptr : def->input(carrier.name());
  Parameter parameter = described(&carrier, input, value.type);
  parameter.path = element_path(carrier);
  if (value.type == Type::color3 || value.type == Type::color4) {
    parameter.colorspace = carrier.inherited_attribute("colorspace");
  }
  parameter.unit = unit;
  if (def != nullptr) parameter.nodedef = def->name;
  parameter.input = carrier.name();
  parameter.where = location(carrier);
  parameter.value = std::move(value);
  graph_.parameters.push_back(std::move(parameter));
  return source;
}

Source Literals::default_parameter(const Instance& instance, const NodeDefInput& input) {
  Source source;
  source.kind = Source::Kind::parameter;
  source.parameter = static_cast<std::uint32_t>(graph_.parameters.size());
  Parameter parameter = described(nullptr, &input, input.type);
  parameter.path = instance.path + '/' + std::string(input.name);
  parameter.colorspace = input.colorspace;
  parameter.nodedef = instance.def->name;
  parameter.input = input.name;
  parameter.is_default = true;
  parameter.where = location(*instance.element);
  parameter.value = input.default_value;
  graph_.parameters.push_back(std::move(parameter));
  return source;
}

Source Literals::file_name(const Element& carrier, const Value& value,
                           const Context* context) const {
  Source source;
  source.kind = Source::Kind::literal;
  source.value = value;
  source.colorspace = carrier.inherited_attribute("colorspace");
  source.document = carrier.document().file_of(carrier);
  std::string& text = source.value.texts[0];
  if (text.empty()) return source;
  text.insert(0, carrier.inherited_attribute("fileprefix"));
  const auto in = [](const std::map<std::string, std::string, std::less<>>& map) {
    return [&map](std::string_view name) -> std::optional<std::string> {
      const auto found = map.find(name);
      if (found == map.end()) return std::nullopt;
      return found->second;
    };
  };
  text = substitute_filename(
      text, {.token = [&](std::string_view name) { return find_token(name, carrier, context); },
             .attribute = in(options_.host_attributes),
             .geometry = in(options_.geometry_tokens)});
  return source;
}

void Literals::choose_frame(GraphNode& node, const Element& user) const {
  const auto text_of = [&](std::string_view name) -> std::string_view {
    const GraphInput* input = node.input(name);
    return input == nullptr || input->source.value.texts.empty()
               ? std::string_view{}
               : std::string_view(input->source.value.texts[0]);
  };
  for (GraphInput& input : node.inputs) {
    if (input.type != Type::filename || input.source.value.texts.empty()) continue;
    std::string& file = input.source.value.texts[0];
    if (!options_.frame || !has_frame_token(file)) continue;
    const GraphInput* offset = node.input("frameoffset");
    const bool has_offset = offset != nullptr && !offset->source.value.ints.empty();
    // In 64 bits, and back into range at the ends: no sum of two frames overflows.
    const std::int64_t sum =
        std::int64_t{*options_.frame} + (has_offset ? offset->source.value.ints[0] : 0);
    std::optional<int> frame = static_cast<int>(std::clamp<std::int64_t>(
        sum, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
    const std::string_view range_text = text_of("framerange");
    const auto range = parse_frame_range(range_text);
    if (range) {
      frame = frame_in_range(*frame, *range, text_of("frameendaction"));
    } else if (!range_text.empty()) {
      complaints_.warning("bad-frame-range", user,
                          "this is no range of frames, so all frames are taken", "FIRST-LAST",
                          fmt::format("'{}'", range_text.substr(0, 200)));
    }
    // No name: the node's default.
    file = frame ? substitute_frame(file, *frame) : std::string();
  }
}

// From the element outwards; out of a graph that implements a node, to that
// node and its nodedef. The first one found counts.
std::optional<std::string> Literals::find_token(std::string_view name, const Element& user,
                                                const Context* context) const {
  const auto token_of = [&](const Element& scope) -> const Element* {
    const Element* token = scope.child(name);
    return token != nullptr && token->category() == "token" ? token : nullptr;
  };
  if (const Element* token = instances_.of_variant("token", name, nullptr)) {
    return std::string(token->attribute("value"));
  }
  const Element* at = &user;
  while (at != nullptr) {
    if (const Element* token = token_of(*at)) {
      const std::string_view outer = token->attribute("interfacename");
      if (outer.empty()) return std::string(token->attribute("value"));
      name = outer;
    }
    const bool leaves = context != nullptr && at == context->graph;
    const bool is_functional = leaves && context->instance != nullptr;
    if (is_functional) {
      const Element* instance = context->instance->element;
      const Element* token = instance == nullptr ? nullptr : token_of(*instance);
      if (token == nullptr) token = token_of(*context->def->element);
      if (token != nullptr && token->attribute("interfacename").empty()) {
        return std::string(token->attribute("value"));
      }
      at = instance == nullptr ? nullptr : instance->parent();
      if (token != nullptr) name = token->attribute("interfacename");
      context = context->instance->context;
      continue;
    }
    if (leaves) context = context->parent;
    at = at->parent();
  }
  return std::nullopt;
}

bool Literals::check_enum(const NodeDefInput& input, Resolved& result) {
  if (result.source.kind != Source::Kind::literal) return true;
  const std::string text = result.source.value.texts.empty() ? "" : result.source.value.texts[0];
  if (takes(input, text)) return true;
  const Element* carrier = result.carrier;
  if (carrier != nullptr && lists(*carrier, text)) return true;
  if (carrier != nullptr && carrier->category() == "input" && is_node(*carrier->parent())) {
    const NodeDef* def = implementations_.nodedef_of(*carrier->parent());
    const NodeDefInput* declared = def == nullptr ? nullptr : def->input(carrier->name());
    if (declared != nullptr && !declared->enums.empty() && takes(*declared, text)) return true;
  }
  const Element& where = carrier != nullptr ? *carrier : *input.element;
  if (text.empty() && takes(input, default_text(input))) {
    const bool takes_default = complaints_.tolerates(
        "bad-enum", where, fmt::format("'{}' does not take this value", input.name),
        "the default is used", fmt::format("{}", fmt::join(input.enums, ", ")), "''");
    if (takes_default) result.source.value = input.default_value;
    return takes_default;
  }
  complaints_.error("bad-enum", where, fmt::format("'{}' does not take this value", input.name),
                    fmt::format("{}", fmt::join(input.enums, ", ")), fmt::format("'{}'", text));
  return false;
}

void Literals::make_uniform(const NodeDefInput& input, const Element& user,
                            Resolved& result) const {
  Source& source = result.source;
  while (source.kind == Source::Kind::link) {
    const GraphNode& node = graph_.nodes[source.node];
    const GraphInput* from = node.category == "constant" ? node.input("value")
                             : node.category == "dot"    ? node.input("in")
                                                         : nullptr;
    if (from == nullptr) break;
    Source next = from->source;
    source = std::move(next);
  }
  if (source.kind == Source::Kind::parameter) {
    source.value = graph_.parameters[source.parameter].value;
    source.kind = Source::Kind::literal;
    source.parameter = 0;
  }
  if (source.kind != Source::Kind::link) return;
  const GraphNode& node = graph_.nodes[source.node];
  const NodeDef* def = implementations_.nodedef(node.nodedef);
  const Element* output = def == nullptr ? nullptr : def->outputs[source.output].element;
  if (output != nullptr && output->attribute("uniform") == "true") return;
  const std::string message = fmt::format("'{}' must not vary over the surface", input.name);
  const std::string expected = "a value, or constants passed along by dot nodes";
  if (is_numeric(input.type)) {
    complaints_.warning("varying-uniform", user, message, expected,
                        fmt::format("<{}>", node.category));
    return;
  }
  complaints_.error("varying-uniform", user, message, expected, fmt::format("<{}>", node.category));
  result.failed = true;
}

}  // namespace nacre
