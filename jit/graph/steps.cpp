// One step of each kind of thing the resolver resolves. A step either names
// what it has to wait for next or leaves its result in the frame.
#include <fmt/format.h>

#include "jit/document/select.h"
#include "jit/document/value_text.h"
#include "jit/graph/colorspace.h"
#include "jit/graph/connection.h"
#include "jit/graph/lenient.h"
#include "jit/graph/resolver.h"

namespace nacre {

namespace {

// Stages of a frame.
constexpr std::uint32_t start = 0;
constexpr std::uint32_t received = 1;   // the source is known, still to be checked
constexpr std::uint32_t converted = 2;  // what was waited for is the result
constexpr std::uint32_t retyped = 4;    // the source has another type now
constexpr std::uint32_t switched = 3;   // whether the node is disabled is known

const Instance& instance_in(const void* subject) { return *static_cast<const Instance*>(subject); }

const NodeDefInput& disable_input() {
  static const NodeDefInput input = [] {
    NodeDefInput made;
    made.name = "disable";
    made.type = Type::boolean;
    made.uniform = true;
    return made;
  }();
  return input;
}

bool may_be_string(Type wanted, Type found) {
  return wanted == Type::filename && found == Type::string;
}

}  // namespace

std::optional<Resolver::Key> Resolver::step_node(Frame& frame) {
  const Instance& instance = instance_in(frame.key.subject);
  const NodeDef& def = *instance.def;
  if (frame.stage < def.inputs.size()) return Key{Kind::input, frame.stage++, &instance, nullptr};

  GraphNode node;
  node.category = def.category;
  node.nodedef = def.name;
  node.path = instance.path;
  node.where = location(*instance.origin);
  for (std::uint32_t i = 0; i < def.inputs.size(); ++i) {
    const Result& result = slots_.at({Kind::input, i, &instance, nullptr}).result;
    if (result.failed) frame.result.failed = true;
    bytes_ += bytes_of(result.source);
    node.inputs.push_back({std::string(def.inputs[i].name), def.inputs[i].type, result.source});
    // Nobody else asks for it, but for what the file of a texture is said to hold.
    if (def.inputs[i].type != Type::filename) slots_.erase({Kind::input, i, &instance, nullptr});
  }
  bytes_ += 2 * node.path.size();
  for (const NodeDefOutput& output : def.outputs) {
    node.outputs.push_back({std::string(output.name), output.type,
                            output.has_default ? output.default_value : Value{}});
  }
  if (frame.result.failed) return std::nullopt;
  choose_frame(node, *instance.origin);
  frame.result.source.kind = Source::Kind::link;
  frame.result.source.node = static_cast<std::uint32_t>(graph_.nodes.size());
  graph_.nodes.push_back(std::move(node));
  if (runs_source(def)) add_source(def);
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::step_output(Frame& frame) {
  const Instance& instance = instance_in(frame.key.subject);
  switch (frame.stage) {
    case start: return start_output(frame, instance);
    case received: {
      const std::optional<Key> next = finish_native_output(frame, instance);
      if (instance.def->outputs.size() == 1) slots_.erase(frame.waiting_for);
      return next;
    }
    case switched: {
      Result disable = waited(frame);
      if (!disable.failed) make_uniform(disable, disable_input(), *instance.origin);
      frame.result.failed = disable.failed;
      if (disable.failed) return std::nullopt;
      const std::vector<std::int32_t>& value = disable.source.value.ints;
      if (value.empty() || value[0] == 0) return start_enabled_output(frame, instance);
      return pass_through(frame, instance);
    }
    default: {
      const Type type = instance.def->outputs[frame.key.index].type;
      frame.result = waited(frame);
      if (!frame.result.failed && frame.result.type != type) {
        error("type-mismatch", *instance.origin,
              fmt::format("the graph of '{}' gives another type than its nodedef says",
                          instance.def->name),
              std::string(type_name(type)), std::string(type_name(frame.result.type)));
        frame.result.failed = true;
      }
      return std::nullopt;
    }
  }
}

// A node may be disabled by an input that its nodedef need not name (Specification,
// "Standard Node Inputs").
std::optional<Resolver::Key> Resolver::start_output(Frame& frame, const Instance& instance) {
  const Element* disable = input_element(instance, "disable");
  if (disable == nullptr || disable->attribute("type") != "boolean") {
    return start_enabled_output(frame, instance);
  }
  frame.stage = switched;
  return Key{Kind::port, 0, disable, instance.context};
}

std::optional<Resolver::Key> Resolver::start_enabled_output(Frame& frame,
                                                            const Instance& instance) {
  const NodeDef& def = *instance.def;
  const NodeDefOutput& output = def.outputs[frame.key.index];
  const Element* graph = graph_of(def);
  say_unused_replacements(def);
  if (is_native(def)) {
    frame.stage = received;
    return Key{Kind::node, 0, &instance, nullptr};
  }
  frame.stage = converted;
  if (graph != nullptr) {
    const Element* port = graph->child(output.member.port);
    const Context* context = functional_context(instance, *graph);
    if (context != nullptr && port != nullptr && port->category() == "output") {
      return Key{Kind::port, output.member.leaf, port, context};
    }
    if (context != nullptr) {
      error(
          "missing-output", *graph,
          fmt::format("the graph lacks an output of the nodedef '{}' that it implements", def.name),
          fmt::format("output '{}'", output.name));
    }
    frame.result.failed = true;
    return std::nullopt;
  }
  // Passing its input through is all that `dot` does.
  if (def.category != "dot") {
    warning("no-implementation", *instance.origin,
            fmt::format("nothing implements '{}': its default is used", def.name));
  }
  return pass_through(frame, instance);
}

// What stands for an output of a node that is disabled, or that nothing implements.
std::optional<Resolver::Key> Resolver::pass_through(Frame& frame, const Instance& instance) {
  const NodeDef& def = *instance.def;
  const NodeDefOutput& output = def.outputs[frame.key.index];
  frame.stage = converted;
  for (std::uint32_t i = 0; i < def.inputs.size(); ++i) {
    if (!output.defaultinput.empty() && def.inputs[i].name == output.defaultinput) {
      return Key{Kind::input, i, &instance, nullptr};
    }
  }
  if (!output.default_geomprop.empty()) {
    if (const Instance* geomprop = geomprop_instance(output.default_geomprop, *instance.origin)) {
      return Key{Kind::output, 0, geomprop, nullptr};
    }
    frame.result.failed = true;
    return std::nullopt;
  }
  frame.result.type = output.type;
  frame.result.source.value = output.default_value;
  frame.result.source.kind = is_numeric(output.type) || is_text(output.type)
                                 ? Source::Kind::literal
                                 : Source::Kind::unconnected;
  return std::nullopt;
}

// A texture node says in which space and unit its file is; what comes out is
// converted here.
std::optional<Resolver::Key> Resolver::finish_native_output(Frame& frame,
                                                            const Instance& instance) {
  const Result& node = waited(frame);
  if (node.failed) {
    frame.result.failed = true;
    return std::nullopt;
  }
  frame.result.type = instance.def->outputs[frame.key.index].type;
  frame.result.source = node.source;
  frame.result.source.output = frame.key.index;
  for (std::uint32_t i = 0; i < instance.def->inputs.size(); ++i) {
    const NodeDefInput& input = instance.def->inputs[i];
    if (input.type != Type::filename) continue;
    const Result& file = slots_.at({Kind::input, i, &instance, nullptr}).result;
    frame.stage = converted;
    const Type type = frame.result.type;
    // Complaints are about who names the file, unless that is a library.
    const bool is_ours = file.carrier != nullptr && &file.carrier->document() == &document_;
    const Element& user = is_ours ? *file.carrier : *instance.origin;
    if (type == Type::color3 || type == Type::color4) {
      return convert_colour(frame.result.source, type, file.source.colorspace, instance.path, user);
    }
    const bool scales = type == Type::float_ || type == Type::vector2 || type == Type::vector3 ||
                        type == Type::vector4;
    if (!scales || file.unit.empty()) return std::nullopt;
    const auto factor = unit_factor(file.unit, nullptr, *instance.origin);
    frame.result.failed = !factor;
    if (!factor || *factor == 1) return std::nullopt;
    return scale(frame.result.source, type, *factor, instance.path, *instance.origin);
  }
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::step_input(Frame& frame) {
  const Instance& instance = instance_in(frame.key.subject);
  const NodeDefInput& input = instance.def->inputs[frame.key.index];
  if (frame.stage == start) return start_input(frame, instance, input);
  if (frame.stage == received) {
    frame.result = waited(frame);
    const auto* port = static_cast<const Element*>(frame.waiting_for.subject);
    if (port->parent() == instance.element) slots_.erase(frame.waiting_for);
    return check_input(frame, instance, input);
  }
  if (frame.stage == retyped) {
    const std::string_view unit = frame.result.unit;
    const Element* carrier = frame.result.carrier;
    frame.result = waited(frame);
    frame.result.unit = unit;
    frame.result.carrier = carrier;
    return check_input(frame, instance, input);
  }
  frame.result = waited(frame);
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::start_input(Frame& frame, const Instance& instance,
                                                   const NodeDefInput& input) {
  Result& result = frame.result;
  result.type = input.type;
  frame.stage = converted;
  for (const auto& [name, source] : instance.inputs) {
    if (name != input.name) continue;
    result.source = source;
    return std::nullopt;
  }
  if (const Element* element = input_element(instance, input.member.port)) {
    frame.stage = received;
    return Key{Kind::port, input.member.leaf, element, instance.context};
  }
  return default_input(frame, instance, input);
}

std::optional<Resolver::Key> Resolver::default_input(Frame& frame, const Instance& instance,
                                                     const NodeDefInput& input) {
  Result& result = frame.result;
  result = {};
  result.type = input.type;
  frame.stage = converted;
  if (!input.defaultgeomprop.empty()) {
    const Instance* geomprop = geomprop_instance(input.defaultgeomprop, *instance.origin);
    result.failed = geomprop == nullptr;
    if (geomprop == nullptr) return std::nullopt;
    if (geomprop->def->outputs[0].type != input.type) {
      error("type-mismatch", *instance.origin,
            fmt::format("the geometric property '{}', which input '{}' takes, has another type",
                        input.defaultgeomprop, input.name),
            std::string(input.type_text), std::string(geomprop->def->outputs[0].type_text));
      result.failed = true;
      return std::nullopt;
    }
    return Key{Kind::output, 0, geomprop, nullptr};
  }
  if (input.type == Type::none) {
    error("unsupported-type", *instance.origin,
          fmt::format("input '{}' has a type that is not supported", input.name), "",
          std::string(input.type_text));
    result.failed = true;
    return std::nullopt;
  }
  const bool has_literal = is_numeric(input.type) || is_text(input.type) || is_array(input.type);
  if (!has_literal) return std::nullopt;
  result.source.kind = Source::Kind::literal;
  result.source.value = input.default_value;
  result.carrier = input.element;
  if (input.type == Type::filename) {
    result.source = filename_source(*input.element, input.default_value, nullptr);
  }
  return convert_colour(result.source, input.type, input.colorspace,
                        instance.path + '/' + std::string(input.name), *instance.origin);
}

std::optional<Resolver::Key> Resolver::check_input(Frame& frame, const Instance& instance,
                                                   const NodeDefInput& input) {
  Result& result = frame.result;
  if (result.failed) return std::nullopt;
  if (result.is_absent) return default_input(frame, instance, input);
  const Element& element = *input_element(instance, input.member.port);
  if (may_be_string(input.type, result.type)) {
    result.type = input.type;
    result.source.value.type = input.type;
  }
  if (options_.lenient && stands_for(result.type, input.type)) {
    // Finding the nodedef has said so.
    frame.stage = retyped;
    const auto key =
        retype(result, input.type, instance.path + '/' + std::string(input.name), element);
    if (key || result.failed) return key;
  }
  if (result.type != input.type) {
    error("type-mismatch", element, "what is connected here has another type",
          std::string(type_name(input.type)), std::string(type_name(result.type)));
    result.failed = true;
    return std::nullopt;
  }
  result.failed = !check_enum(input, result);
  if (input.uniform) make_uniform(result, input, element);
  frame.stage = converted;
  return convert_unit(result, input, instance.path + '/' + std::string(input.name), element);
}

std::optional<Resolver::Key> Resolver::step_port(Frame& frame) {
  const Element& port = *static_cast<const Element*>(frame.key.subject);
  const Context* context = frame.key.context;
  // Of a port whose type is a structure, one leaf: 1 + its number.
  const std::uint32_t leaf = frame.key.index;
  if (frame.stage == received) {
    frame.result = waited(frame);
    return leaf == 0 ? check_port_type(frame, port) : std::nullopt;
  }
  if (frame.stage == converted) {
    const Element* carrier = frame.result.carrier;
    frame.result = waited(frame);
    frame.result.carrier = carrier;
    return std::nullopt;
  }
  frame.stage = received;
  const Connection connection = connection_of(port);
  switch (connection.kind) {
    case Connection::Kind::invalid: frame.result.failed = true; return std::nullopt;
    case Connection::Kind::none: return port_without_source(frame, port);
    case Connection::Kind::interface:
      return follow_interface(frame, port, connection.output, context);
    case Connection::Kind::node: {
      const Instance* instance = instance_of(*connection.target, context);
      const auto index = instance == nullptr
                             ? std::nullopt
                             : output_index(*instance->def, connection.output, port, leaf);
      frame.result.failed = !index;
      if (!index) return std::nullopt;
      return Key{Kind::output, *index, instance, nullptr};
    }
    case Connection::Kind::output: {
      const Element& owner = *connection.target->parent();
      if (owner.parent() == nullptr) return Key{Kind::port, leaf, connection.target, nullptr};
      const Context* outside = owner.parent()->parent() == nullptr ? nullptr : context;
      return Key{Kind::port, leaf, connection.target, compound_context(owner, outside)};
    }
    case Connection::Kind::value: {
      if (leaf != 0) return take_leaf(frame, port);
      const auto type = parse_type(port.attribute("type"));
      if (!type) {
        error("unsupported-type", port, "the type is not supported", "a standard type",
              fmt::format("'{}'", port.attribute("type")));
        frame.result.failed = true;
        return std::nullopt;
      }
      frame.stage = converted;
      return take_literal(frame, port, *type, context);
    }
  }
  return std::nullopt;
}

// A name inside a graph stands for the input of that graph, or, if the graph
// implements a nodedef, for the input of the node it stands for.
std::optional<Resolver::Key> Resolver::follow_interface(Frame& frame, const Element& port,
                                                        std::string_view name,
                                                        const Context* context) {
  if (context != nullptr && context->instance != nullptr) {
    const std::vector<NodeDefInput>& inputs = context->def->inputs;
    for (std::uint32_t i = 0; i < inputs.size(); ++i) {
      if (inputs[i].member.port == name && inputs[i].member.leaf == frame.key.index) {
        return Key{Kind::input, i, context->instance, nullptr};
      }
    }
  } else {
    const Element& graph = context == nullptr ? port.document().root() : *context->graph;
    const Element* input = graph.child(name);
    if (input != nullptr && input->category() == "input") {
      return Key{Kind::port, frame.key.index, input,
                 context == nullptr ? nullptr : context->parent};
    }
  }
  const bool has_default = port.category() == "input" && is_node(*port.parent());
  const std::string message = "the graph around it has no such input";
  const std::string expected = "the name of an input of the graph";
  const std::string found = fmt::format("'{}'", name);
  if (!has_default) {
    error("unknown-interface", port, message, expected, found);
    frame.result.failed = true;
    return std::nullopt;
  }
  const bool has_value = port.has_attribute("value") && frame.key.index == 0;
  frame.result.failed =
      !tolerates("unknown-interface", port, message,
                 has_value ? "its value is used" : "the default is used", expected, found);
  if (frame.result.failed) return std::nullopt;
  const auto type = parse_type(port.attribute("type"));
  frame.result.is_absent = !has_value || !type;
  if (frame.result.is_absent) return std::nullopt;
  frame.stage = converted;
  return take_literal(frame, port, *type, context);
}

// Only graph interfaces and outputs come here: a node's input without a source
// takes the nodedef's default.
std::optional<Resolver::Key> Resolver::port_without_source(Frame& frame, const Element& port) {
  const auto type = parse_type(port.attribute("type"));
  frame.result.type = type.value_or(Type::none);
  frame.stage = converted;
  if (port.category() == "output") {
    const std::string message = "the output is not connected to anything";
    if (frame.key.index != 0 || !is_numeric(frame.result.type)) {
      error("unconnected-output", port, message, "nodename or nodegraph");
      frame.result.failed = true;
      return std::nullopt;
    }
    frame.result.failed =
        !tolerates("unconnected-output", port, message, "it is zero", "nodename or nodegraph");
    frame.result.source.kind = Source::Kind::literal;
    frame.result.source.value = zero_value(frame.result.type);
    return std::nullopt;
  }
  if (frame.key.index != 0) return take_leaf(frame, port);
  const std::string_view geomprop_name = port.attribute("defaultgeomprop");
  if (!geomprop_name.empty()) {
    const Instance* geomprop = geomprop_instance(geomprop_name, port);
    frame.result.failed = geomprop == nullptr;
    if (geomprop == nullptr) return std::nullopt;
    return Key{Kind::output, 0, geomprop, nullptr};
  }
  if (!is_numeric(frame.result.type) && !is_text(frame.result.type)) return std::nullopt;
  frame.result.source.kind = Source::Kind::literal;
  frame.result.source.value = zero_value(frame.result.type);
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::check_port_type(Frame& frame, const Element& port) {
  Result& result = frame.result;
  if (result.failed || result.is_absent) return std::nullopt;
  const Type type = parse_type(port.attribute("type")).value_or(Type::none);
  if (may_be_string(type, result.type)) {
    result.type = type;
    result.source.value.type = type;
  }
  if (result.type == type) return std::nullopt;
  const std::string message = "what is connected here has another type";
  const std::string expected(port.attribute("type"));
  const std::string found(type_name(result.type));
  if (stands_for(result.type, type)) {
    if (tolerates("type-mismatch", port, message, "it is converted", expected, found)) {
      frame.stage = converted;
      return retype(result, type, element_path(port), port);
    }
  } else {
    error("type-mismatch", port, message, expected, found);
  }
  result.failed = true;
  return std::nullopt;
}

}  // namespace nacre
