// What <input> and <output> elements come to: what they are connected to, or their value.
#include <fmt/format.h>

#include "jit/document/value_text.h"
#include "jit/graph/resolve/feed.h"
#include "jit/graph/resolve/lenient.h"
#include "jit/graph/resolve/resolver.h"

namespace nacre {

std::optional<Resolver::Key> Resolver::step_port(Task& task) {
  const Element& port = *static_cast<const Element*>(task.key.subject);
  if (task.stage == Stage::start) return start_port(task, port);
  if (task.stage == Stage::received) {
    task.result = waited(task);
    return is_leaf(task) ? std::nullopt : check_port_type(task, port);
  }
  const Element* carrier = task.result.carrier;
  task.result = waited(task);
  task.result.carrier = carrier;
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::start_port(Task& task, const Element& port) {
  const Context* context = task.key.context;
  const std::uint32_t leaf = task.key.index;
  task.stage = Stage::received;
  // Inlined graphs meet the same port in many contexts.
  const Connection connection = find_connection(port, complaints_);
  switch (connection.kind) {
    case Connection::Kind::invalid: task.result.failed = true; return std::nullopt;
    case Connection::Kind::none: return port_without_source(task, port);
    case Connection::Kind::interface: return follow_interface(task, port, connection.output);
    case Connection::Kind::node: {
      const Instance* instance = instances_.of(*connection.target, context);
      const auto index = instance == nullptr ? std::nullopt
                                             : instances_.output_index(
                                                   *instance->def, connection.output, port, leaf);
      task.result.failed = !index;
      if (!index) return std::nullopt;
      return Key{Kind::output, *index, instance, nullptr};
    }
    case Connection::Kind::output: {
      const Element& owner = *connection.target->parent();
      if (owner.parent() == nullptr) return Key{Kind::port, leaf, connection.target, nullptr};
      const Context* outside = owner.parent()->parent() == nullptr ? nullptr : context;
      return Key{Kind::port, leaf, connection.target, instances_.compound(owner, outside)};
    }
    case Connection::Kind::value: {
      const auto type = parse_type(port.attribute("type"));
      if (type || is_leaf(task)) return take_value(task, port, type.value_or(Type::none));
      complaints_.error("unsupported-type", port, "the type is not supported", "a standard type",
                        fmt::format("'{}'", port.attribute("type")));
      task.result.failed = true;
      return std::nullopt;
    }
  }
  return std::nullopt;
}

// What a port says itself, or of a structure the default of a leaf.
std::optional<Resolver::Key> Resolver::take_value(Task& task, const Element& port, Type type) {
  Resolved& result = task.result;
  if (is_leaf(task)) {
    literals_.take_leaf(port, task.key.index - 1, result);
    return std::nullopt;
  }
  task.stage = Stage::converted;
  literals_.take(port, type, task.key.context, result);
  if (result.failed) return std::nullopt;
  return convert_colour(result.source, type, port.inherited_attribute("colorspace"),
                        element_path(port), port);
}

// A name inside a graph stands for the input of that graph, or, if the graph
// implements a nodedef, for the input of the node it stands for.
std::optional<Resolver::Key> Resolver::follow_interface(Task& task, const Element& port,
                                                        std::string_view name) {
  const Context* context = task.key.context;
  if (context != nullptr && context->instance != nullptr) {
    const std::vector<NodeDefInput>& inputs = context->def->inputs;
    for (std::uint32_t i = 0; i < inputs.size(); ++i) {
      if (inputs[i].member.port == name && inputs[i].member.leaf == task.key.index) {
        return Key{Kind::input, i, context->instance, nullptr};
      }
    }
    return miss_interface(task, port);
  }
  const Element* input =
      find_interface(context == nullptr ? port.document().root() : *context->graph, name);
  if (input == nullptr) return miss_interface(task, port);
  return Key{Kind::port, task.key.index, input, context == nullptr ? nullptr : context->parent};
}

// A name that no input has: with GraphOptions::lenient a node does without.
std::optional<Resolver::Key> Resolver::miss_interface(Task& task, const Element& port) {
  Resolved& result = task.result;
  const Connection instead = without_interface(port, !is_leaf(task), complaints_);
  result.failed = instead.kind == Connection::Kind::invalid;
  if (result.failed) return std::nullopt;
  const auto type = parse_type(port.attribute("type"));
  result.is_absent = instead.kind != Connection::Kind::value || !type;
  if (result.is_absent) return std::nullopt;
  return take_value(task, port, *type);
}

// Only graph interfaces and outputs come here: a node's input without a source
// takes the nodedef's default.
std::optional<Resolver::Key> Resolver::port_without_source(Task& task, const Element& port) {
  const auto type = parse_type(port.attribute("type"));
  task.result.type = type.value_or(Type::none);
  task.stage = Stage::converted;
  if (port.category() == "output") {
    const std::string message = "the output is not connected to anything";
    if (is_leaf(task) || !is_numeric(task.result.type)) {
      complaints_.error("unconnected-output", port, message, "nodename or nodegraph");
      task.result.failed = true;
      return std::nullopt;
    }
    task.result.failed = !complaints_.tolerates("unconnected-output", port, message, "it is zero",
                                                "nodename or nodegraph");
    task.result.source.kind = Source::Kind::literal;
    task.result.source.value = zero_value(task.result.type);
    return std::nullopt;
  }
  if (is_leaf(task)) return take_value(task, port, task.result.type);
  const std::string_view geomprop_name = port.attribute("defaultgeomprop");
  if (!geomprop_name.empty()) {
    const Instance* geomprop = instances_.of_geomprop(geomprop_name, port);
    task.result.failed = geomprop == nullptr;
    if (geomprop == nullptr) return std::nullopt;
    return output_of(*geomprop);
  }
  if (!is_numeric(task.result.type) && !is_text(task.result.type)) return std::nullopt;
  task.result.source.kind = Source::Kind::literal;
  task.result.source.value = zero_value(task.result.type);
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::check_port_type(Task& task, const Element& port) {
  Resolved& result = task.result;
  if (result.failed || result.is_absent) return std::nullopt;
  const Type type = parse_type(port.attribute("type")).value_or(Type::none);
  take_string(type, result);
  if (result.type == type) return std::nullopt;
  const std::string message = "what is connected here has another type";
  const std::string expected(port.attribute("type"));
  const std::string found(type_name(result.type));
  if (stands_for(result.type, type)) {
    if (complaints_.tolerates("type-mismatch", port, message, "it is converted", expected, found)) {
      task.stage = Stage::converted;
      return retype(result, type, element_path(port), port);
    }
  } else {
    complaints_.error("type-mismatch", port, message, expected, found);
  }
  result.failed = true;
  return std::nullopt;
}

}  // namespace nacre
