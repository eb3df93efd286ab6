// What inputs of nodes come to.
#include <fmt/format.h>

#include "jit/document/value_text.h"
#include "jit/graph/resolve/lenient.h"
#include "jit/graph/resolve/resolver.h"

namespace nacre {

std::optional<Resolver::Key> Resolver::step_input(Task& task) {
  const Instance& instance = *static_cast<const Instance*>(task.key.subject);
  const NodeDefInput& input = instance.def->inputs[task.key.index];
  if (task.stage == Stage::start) return start_input(task, instance, input);
  if (task.stage == Stage::received) {
    task.result = waited(task);
    const auto* port = static_cast<const Element*>(task.waiting_for->first.subject);
    if (port->parent() == instance.element) forget_waited(task);
    return check_input(task, instance, input);
  }
  if (task.stage == Stage::retyped) {
    const std::string_view unit = task.result.unit;
    const Element* carrier = task.result.carrier;
    task.result = waited(task);
    task.result.unit = unit;
    task.result.carrier = carrier;
    return check_input(task, instance, input);
  }
  task.result = waited(task);
  return std::nullopt;
}

std::optional<Resolver::Key> Resolver::start_input(Task& task, const Instance& instance,
                                                   const NodeDefInput& input) {
  Resolved& result = task.result;
  result.type = input.type;
  task.stage = Stage::converted;
  for (const auto& [name, source] : instance.inputs) {
    if (name != input.name) continue;
    result.source = source;
    return std::nullopt;
  }
  if (const Element* element = instances_.input(instance, input.member.port)) {
    task.stage = Stage::received;
    return Key{Kind::port, input.member.leaf, element, instance.context};
  }
  return default_input(task, instance, input);
}

std::optional<Resolver::Key> Resolver::default_input(Task& task, const Instance& instance,
                                                     const NodeDefInput& input) {
  Resolved& result = task.result;
  result = {};
  result.type = input.type;
  task.stage = Stage::converted;
  if (!input.defaultgeomprop.empty()) {
    const Instance* geomprop = instances_.of_geomprop(input.defaultgeomprop, *instance.origin);
    result.failed = geomprop == nullptr;
    if (geomprop == nullptr) return std::nullopt;
    if (geomprop->def->outputs[0].type != input.type) {
      complaints_.error(
          "type-mismatch", *instance.origin,
          fmt::format("the geometric property '{}', which input '{}' takes, has another type",
                      input.defaultgeomprop, input.name),
          std::string(input.type_text), std::string(geomprop->def->outputs[0].type_text));
      result.failed = true;
      return std::nullopt;
    }
    return output_of(*geomprop);
  }
  if (input.type == Type::none) {
    complaints_.error("unsupported-type", *instance.origin,
                      fmt::format("input '{}' has a type that is not supported", input.name), "",
                      std::string(input.type_text));
    result.failed = true;
    return std::nullopt;
  }
  const bool has_literal = is_numeric(input.type) || is_text(input.type) || is_array(input.type);
  if (!has_literal) return std::nullopt;
  const bool is_parameter = options_.default_parameters && instance.element != nullptr &&
                            &instance.element->document() == &document_ && !input.uniform &&
                            is_numeric(input.type);
  if (is_parameter) {
    result.source = literals_.default_parameter(instance, input);
  } else {
    result.source.kind = Source::Kind::literal;
    result.source.value = input.default_value;
  }
  result.carrier = input.element;
  if (input.type == Type::filename) {
    result.source = literals_.file_name(*input.element, input.default_value, nullptr);
  }
  return convert_colour(result.source, input.type, input.colorspace,
                        instance.path + '/' + std::string(input.name), *instance.origin);
}

std::optional<Resolver::Key> Resolver::check_input(Task& task, const Instance& instance,
                                                   const NodeDefInput& input) {
  Resolved& result = task.result;
  if (result.failed) return std::nullopt;
  if (result.is_absent) return default_input(task, instance, input);
  const Element& element = *instances_.input(instance, input.member.port);
  take_string(input.type, result);
  if (complaints_.is_lenient() && stands_for(result.type, input.type)) {
    // Finding the nodedef has said so.
    task.stage = Stage::retyped;
    const auto key =
        retype(result, input.type, instance.path + '/' + std::string(input.name), element);
    if (key || result.failed) return key;
  }
  if (result.type != input.type) {
    complaints_.error("type-mismatch", element, "what is connected here has another type",
                      std::string(type_name(input.type)), std::string(type_name(result.type)));
    result.failed = true;
    return std::nullopt;
  }
  result.failed = !literals_.check_enum(input, result);
  if (input.uniform) literals_.make_uniform(input, element, result);
  task.stage = Stage::converted;
  return convert_unit(result, input, instance.path + '/' + std::string(input.name), element);
}

}  // namespace nacre
