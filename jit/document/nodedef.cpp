#include "jit/document/nodedef.h"

#include <fmt/format.h>

#include <algorithm>

#include "jit/document/names.h"
#include "jit/document/value_text.h"

namespace nacre {

namespace {

// The default of a port, from attribute `attribute` of its element.
template <typename Port>
void read_default(Port& port, std::string_view attribute, Diagnostics& diagnostics) {
  if (port.element->has_attribute(attribute)) {
    const std::string_view text = port.element->attribute(attribute);
    if (auto value = parse_value(port.type, text)) {
      port.default_value = std::move(*value);
      port.has_default = true;
      return;
    }
    if (port.type != Type::none) {
      diagnostics.error("bad-value", location(*port.element),
                        fmt::format("the {} does not fit the type {}", attribute, port.type_text),
                        expected_text(port.type), fmt::format("'{}'", text));
    }
  }
  port.default_value = zero_value(port.type);
}

NodeDefInput read_input(const Element& element, Diagnostics& diagnostics) {
  NodeDefInput input;
  input.element = &element;
  input.name = element.name();
  input.member.port = input.name;
  for (const Attribute& attribute : element.attributes()) {
    if (attribute.name == "type")
      input.type_text = attribute.value;
    else if (attribute.name == "defaultgeomprop")
      input.defaultgeomprop = attribute.value;
    else if (attribute.name == "uniform")
      input.uniform = attribute.value == "true";
    else if (attribute.name == "enum")
      input.enums = split_list(attribute.value);
    else if (attribute.name == "enumvalues")
      input.enum_values = attribute.value;
    else if (attribute.name == "unit")
      input.unit = attribute.value;
    else if (attribute.name == "unittype")
      input.unit_type = attribute.value;
  }
  input.colorspace = element.inherited_attribute("colorspace");
  input.type = parse_type(input.type_text).value_or(Type::none);
  // Text and arrays never vary over a surface (Specification, "Inputs").
  input.uniform = input.uniform || is_text(input.type) || is_array(input.type);
  read_default(input, "value", diagnostics);
  return input;
}

NodeDefOutput read_output(const Element& element, Diagnostics& diagnostics) {
  NodeDefOutput output;
  output.element = &element;
  output.name = element.name();
  output.member.port = output.name;
  output.type_text = element.attribute("type");
  output.defaultinput = element.attribute("defaultinput");
  output.type = parse_type(output.type_text).value_or(Type::none);
  // "default" in the specification, "value" in what people write.
  const char* attribute = element.has_attribute("default") ? "default" : "value";
  const std::string_view text = element.attribute(attribute);
  if (is_numeric(output.type) && output.type != Type::boolean && is_valid_name(text)) {
    output.default_geomprop = text;
    output.default_value = zero_value(output.type);
  } else {
    read_default(output, attribute, diagnostics);
  }
  return output;
}

}  // namespace

InputUi ui_of(const NodeDefInput& input) {
  InputUi ui;
  if (input.element == nullptr) return ui;
  const auto value = [&](std::string_view attribute) {
    if (!input.element->has_attribute(attribute)) return Value{};
    return parse_value(input.type, input.element->attribute(attribute)).value_or(Value{});
  };
  ui.label = input.element->attribute("uiname");
  ui.folder = input.element->attribute("uifolder");
  ui.doc = input.element->attribute("doc");
  ui.min = value("uimin");
  ui.max = value("uimax");
  ui.soft_min = value("uisoftmin");
  ui.soft_max = value("uisoftmax");
  ui.step = value("uistep");
  ui.advanced = input.element->attribute("uiadvanced") == "true";
  return ui;
}

std::vector<EnumChoice> enum_choices(const NodeDefInput& input) {
  // Values of several components stand one after another, separated by commas too.
  const std::vector<std::string_view> numbers = split_list(input.enum_values);
  const auto count = static_cast<std::size_t>(std::max(1, component_count(input.type)));
  std::vector<EnumChoice> choices;
  for (std::size_t i = 0; i < input.enums.size(); ++i) {
    EnumChoice& choice = choices.emplace_back();
    choice.label = input.enums[i];
    std::string text;
    for (std::size_t k = i * count; k < (i + 1) * count && k < numbers.size(); ++k) {
      text += (text.empty() ? "" : ", ") + std::string(numbers[k]);
    }
    if (numbers.empty()) text = choice.label;
    choice.value = parse_value(input.type, text).value_or(Value{});
  }
  return choices;
}

const NodeDefInput* NodeDef::input(std::string_view wanted) const {
  for (const NodeDefInput& candidate : inputs) {
    if (candidate.name == wanted) return &candidate;
  }
  return nullptr;
}

const NodeDefOutput* NodeDef::output(std::string_view wanted) const {
  for (const NodeDefOutput& candidate : outputs) {
    if (candidate.name == wanted) return &candidate;
  }
  return nullptr;
}

std::string_view NodeDef::input_type(std::string_view port) const {
  for (const NodeDefInput& input : inputs) {
    if (input.member.port == port) {
      return input.member.leaf == 0 ? input.type_text : input.member.struct_type;
    }
  }
  return {};
}

std::string_view NodeDef::instance_type() const {
  // The leaves of one structure are one output.
  const bool is_one = !outputs.empty() && outputs.front().member.leaf != 0 &&
                      std::all_of(outputs.begin(), outputs.end(), [&](const NodeDefOutput& each) {
                        return each.member.port == outputs.front().member.port;
                      });
  if (is_one) return outputs.front().member.struct_type;
  return outputs.size() == 1 ? outputs.front().type_text : "multioutput";
}

NodeDef read_nodedef(const Element& element, Diagnostics& diagnostics) {
  NodeDef def;
  def.element = &element;
  def.name = element.name();
  def.category = qualified_name(element, element.attribute("node"));
  def.nodegroup = element.attribute("nodegroup");
  def.version = element.attribute("version");
  def.is_default_version = element.attribute("isdefaultversion") == "true";
  def.target = element.attribute("target");
  def.inputs.reserve(element.child_count());
  for (const Element& child : element.children()) {
    if (child.category() == "input") def.inputs.push_back(read_input(child, diagnostics));
    if (child.category() == "output") def.outputs.push_back(read_output(child, diagnostics));
  }
  return def;
}

void inherit_ports(NodeDef& derived, const NodeDef& base) {
  for (const NodeDefInput& input : base.inputs) {
    if (derived.input(input.name) == nullptr) derived.inputs.push_back(input);
  }
  for (const NodeDefOutput& output : base.outputs) {
    if (derived.output(output.name) == nullptr) derived.outputs.push_back(output);
  }
}

std::vector<std::string_view> split_list(std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view part = trim(text.substr(0, comma));
    if (!part.empty()) parts.push_back(part);
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
  }
  return parts;
}

}  // namespace nacre
