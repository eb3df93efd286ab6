#include "jit/graph/build/builder.h"

#include <fmt/format.h>

#include <charconv>

#include "jit/document/value_text.h"
#include "runtime/float_environment.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

std::string escape(std::string_view text) {
  std::string result;
  for (char c : text) {
    if (c == ',' || c == ';' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

// As parse_value reads it; floats in the shortest form that comes back equal.
std::string value_text(const Value& value) {
  if (value.type == Type::boolean) return !value.ints.empty() && value.ints[0] ? "true" : "false";
  if (is_text(value.type)) return value.texts.empty() ? "" : value.texts[0];
  if (!value.floats.empty()) return fmt::format("{}", fmt::join(value.floats, ", "));
  if (!value.ints.empty()) return fmt::format("{}", fmt::join(value.ints, ", "));
  std::vector<std::string> texts;
  for (const std::string& text : value.texts) texts.push_back(escape(text));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

GraphBuilder::GraphBuilder(const Library& library)
    : library_(library), document_(std::make_unique<Document>()) {
  const std::uint16_t file = document_->add_file("", std::make_unique<char[]>(1), 0);
  document_->set_root(document_->create("materialx", file, 0));
}

GraphBuilder::~GraphBuilder() = default;

void GraphBuilder::fail(std::string code, std::string path, std::string message,
                        std::string expected, std::string found, std::string hint) {
  faults_.error(std::move(code), {"", 0, 0, std::move(path)}, std::move(message),
                std::move(expected), std::move(found), std::move(hint));
}

void GraphBuilder::set_attribute(Element& element, std::string_view name, std::string_view value) {
  document_->set_attribute(element, document_->intern(name), document_->intern(value));
}

Element& GraphBuilder::add_element(Element& parent, std::string_view category,
                                   const std::string& name, std::string_view type) {
  Element& element = document_->create(document_->intern(category), 0, 0);
  Document::set_name(element, document_->intern(name));
  set_attribute(element, "name", name);
  set_attribute(element, "type", type);
  document_->append(parent, element);
  return element;
}

GraphBuilder::Node GraphBuilder::add_node(std::string_view nodedef, std::string path) {
  const Node node{static_cast<std::uint32_t>(nodes_.size())};
  const NodeDef* def = library_.definitions().nodedef(nodedef);
  if (def == nullptr) {
    fail("unknown-nodedef", path, "there is no nodedef of this name", "the name of a nodedef",
         fmt::format("'{}'", nodedef),
         near_hint(faults_, nodedef, library_.definitions().all(),
                   [](const NodeDef* each) { return each->name; }));
    nodes_.push_back({nullptr, std::move(path), nullptr});
    return node;
  }
  Element& element = add_element(document_->root(), def->category, fmt::format("n{}", node.index),
                                 def->instance_type());
  set_attribute(element, "nodedef", nodedef);
  nodes_.push_back({def, std::move(path), &element});
  return node;
}

// A new input of a node, or null after a fault.
Element* GraphBuilder::input_element(Node node, std::string_view input, Type type) {
  const NodeRow& row = nodes_.at(node.index);
  if (row.def == nullptr) return nullptr;
  const std::string path = row.path + '/' + std::string(input);
  const NodeDefInput* port = row.def->input(input);
  if (port == nullptr && input == "disable" && type == Type::boolean) {
    return &add_element(*row.element, "input", std::string(input), type_name(type));
  }
  if (port == nullptr) {
    fail("unknown-input", path, fmt::format("'{}' has no such input", row.def->name), {}, {},
         near_hint(faults_, input, row.def->inputs,
                   [](const NodeDefInput& each) { return each.name; }));
    return nullptr;
  }
  const bool fits = port->type == type || (port->type == Type::filename && type == Type::string);
  if (!fits) {
    fail("type-mismatch", path, "what is set here has another type",
         std::string(type_name(port->type)), std::string(type_name(type)));
    return nullptr;
  }
  if (row.element->child(input) != nullptr) {
    fail("several-sources", path, "the input is set twice");
    return nullptr;
  }
  return &add_element(*row.element, "input", std::string(input), port->type_text);
}

void GraphBuilder::set_value(Element& element, const Value& value, std::string_view colorspace,
                             std::string_view unit, const std::string& path) {
  const std::string text = value_text(value);
  if (!parse_value(value.type, text)) {
    fail("bad-value", path, "the value does not fit its type", expected_text(value.type),
         fmt::format("'{}'", text.substr(0, 200)));
  }
  set_attribute(element, "value", text);
  if (!colorspace.empty()) set_attribute(element, "colorspace", colorspace);
  if (!unit.empty()) set_attribute(element, "unit", unit);
}

void GraphBuilder::set(Node node, std::string_view input, const Value& value,
                       std::string_view colorspace, std::string_view unit) {
  const ScopedDefaultFloatEnvironment environment;
  Element* element = input_element(node, input, value.type);
  if (element == nullptr) return;
  set_value(*element, value, colorspace, unit, nodes_[node.index].path + '/' + std::string(input));
  set_attribute(*element, "uniform", "true");
}

const NodeDefOutput* GraphBuilder::find_output(Node source, std::string_view output,
                                               const std::string& user) {
  const NodeRow& row = nodes_.at(source.index);
  if (row.def == nullptr) return nullptr;
  const NodeDefOutput* found = row.def->output(output);
  if (output.empty() && row.def->outputs.size() == 1) found = &row.def->outputs[0];
  if (found == nullptr) {
    fail(output.empty() ? "output-required" : "unknown-output", user,
         fmt::format("'{}' has no such output", row.path), "the name of an output",
         fmt::format("'{}'", output),
         near_hint(faults_, output, row.def->outputs,
                   [](const NodeDefOutput& each) { return each.name; }));
  }
  return found;
}

void GraphBuilder::connect(Node node, std::string_view input, Node source,
                           std::string_view output) {
  const std::string path = nodes_.at(node.index).path + '/' + std::string(input);
  const NodeDefOutput* port = find_output(source, output, path);
  if (port == nullptr) return;
  Element* element = input_element(node, input, port->type);
  if (element == nullptr) return;
  set_attribute(*element, "nodename", fmt::format("n{}", source.index));
  set_attribute(*element, "output", port->name);
}

void GraphBuilder::connect(Node node, std::string_view input, ParameterId source) {
  Element* element = input_element(node, input, parameters_.at(source.index).type);
  if (element == nullptr) return;
  set_attribute(*element, "interfacename", fmt::format("p{}", source.index));
}

GraphBuilder::ParameterId GraphBuilder::parameter(std::string path, const Value& value,
                                                  std::string_view colorspace,
                                                  std::string_view unit) {
  const ScopedDefaultFloatEnvironment environment;
  const ParameterId id{static_cast<std::uint32_t>(parameters_.size())};
  if (!is_numeric(value.type)) {
    fail("bad-value", path, "only numbers can be parameters", "a numeric type",
         std::string(type_name(value.type)));
  }
  Element& element =
      add_element(document_->root(), "input", fmt::format("p{}", id.index), type_name(value.type));
  set_value(element, value, colorspace, unit, path);
  parameters_.push_back({std::move(path), value.type});
  return id;
}

void GraphBuilder::output(std::string name, Node source, std::string_view output) {
  const NodeDefOutput* port = find_output(source, output, name);
  if (port == nullptr) return;
  Element& element = add_element(document_->root(), "output", fmt::format("o{}", outputs_.size()),
                                 port->type_text);
  set_attribute(element, "nodename", fmt::format("n{}", source.index));
  set_attribute(element, "output", port->name);
  outputs_.push_back(std::move(name));
}

// "n3/fresnel" with the host's name in the place of "n3".
std::string GraphBuilder::public_path(std::string_view path) const {
  if (path.size() < 2) return std::string(path);
  std::uint32_t index = 0;
  const char* end = path.data() + path.size();
  const auto [rest, error] = std::from_chars(path.data() + 1, end, index);
  const bool whole = error == std::errc{} && (rest == end || *rest == '/' || *rest == ':');
  const std::string tail(rest, end);
  if (whole && path[0] == 'n' && index < nodes_.size()) return nodes_[index].path + tail;
  if (whole && path[0] == 'p' && index < parameters_.size()) return parameters_[index].path + tail;
  if (whole && path[0] == 'o' && index < outputs_.size()) return outputs_[index] + tail;
  return std::string(path);
}

std::optional<Graph> GraphBuilder::finish(const GraphOptions& options, Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  for (const Diagnostic& fault : faults_.all()) diagnostics.add(fault);
  if (faults_.has_errors()) return std::nullopt;
  document_->build_index();
  Diagnostics found;
  const Definitions definitions(*document_, &library_.definitions(), found);
  GraphRequest request;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    request.outputs.push_back(fmt::format("o{}", i));
  std::optional<Graph> graph = build_graph(*document_, definitions, request, options, found);
  const auto name_place = [this](SourceLocation& where) {
    where = {"", 0, 0, public_path(where.path)};
  };
  for (Diagnostic one : found.all()) {
    name_place(one.where);
    diagnostics.add(std::move(one));
  }
  if (!graph) return std::nullopt;
  for (GraphNode& node : graph->nodes) {
    node.path = public_path(node.path);
    name_place(node.where);
  }
  for (Parameter& parameter : graph->parameters) {
    parameter.path = public_path(parameter.path);
    name_place(parameter.where);
  }
  for (GraphOutput& output : graph->outputs) output.name = public_path(output.name);
  return graph;
}

}  // namespace nacre
