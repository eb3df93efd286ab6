// Colour spaces, units and types: nodes put between a value and who reads it.
#include <fmt/format.h>

#include "jit/document/value_text.h"
#include "jit/graph/color/colorspace.h"
#include "jit/graph/resolve/lenient.h"
#include "jit/graph/resolve/resolver.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

std::string conversion_path(const std::string& path, std::string_view from, std::string_view to) {
  return fmt::format("{}:{}_to_{}", path, canonical_colorspace(from), canonical_colorspace(to));
}

}  // namespace

// The nearest `colorspace` up the tree says what the numbers mean.
std::optional<Resolver::Key> Resolver::convert_colour(const Source& source, Type type,
                                                      std::string_view space,
                                                      const std::string& path,
                                                      const Element& user) {
  if (source.kind == Source::Kind::unconnected) return std::nullopt;
  const std::string& to = colors_.working_space();
  const NodeDef* transform = colors_.find(type, space, to, user).nodedef;
  if (transform == nullptr) return std::nullopt;
  return transformed(source, *transform, conversion_path(path, space, to), user);
}

Resolved Resolver::in_output_space(const Resolved& result, const std::string& name,
                                   const Element& user) {
  if (result.failed || result.source.kind == Source::Kind::unconnected) return result;
  const std::string& from = colors_.working_space();
  const std::string& to = options_.output_space;
  const ColorTransforms::Conversion conversion = colors_.find(result.type, from, to, user);
  if (conversion.failed) return failure();
  if (conversion.nodedef == nullptr) return result;
  return run(
      transformed(result.source, *conversion.nodedef, conversion_path(name, from, to), user));
}

Resolver::Key Resolver::transformed(const Source& source, const NodeDef& transform,
                                    std::string path, const Element& user) {
  Instance& instance = instances_.add(transform, std::move(path), &user);
  instance.inputs.emplace_back(transform.inputs[0].name, source);
  return output_of(instance);
}

// From the unit a value is given in to the one its reader wants. A literal is
// converted on the spot; a file name keeps its unit for the texels read.
std::optional<Resolver::Key> Resolver::convert_unit(Resolved& result, const NodeDefInput& input,
                                                    const std::string& path, const Element& user) {
  if (result.unit.empty() || result.failed || input.type == Type::filename) return std::nullopt;
  const std::string_view from = result.unit;
  result.unit = {};
  const bool scales = input.type == Type::float_ || input.type == Type::vector2 ||
                      input.type == Type::vector3 || input.type == Type::vector4;
  if (!scales) return std::nullopt;
  const std::optional<double> factor = unit_factor(from, &input, user);
  result.failed = !factor;
  if (!factor || *factor == 1) return std::nullopt;
  if (result.source.kind == Source::Kind::literal) {
    for (float& number : result.source.value.floats) {
      number = static_cast<float>(number * *factor);
    }
    return std::nullopt;
  }
  return scale(result.source, input.type, *factor, path, user);
}

std::optional<double> Resolver::unit_factor(std::string_view from, const NodeDefInput* input,
                                            const Element& user) {
  const auto source = definitions_.unit(from);
  if (!source) {
    complaints_.error("unknown-unit", user, "there is no unit of this name", "the name of a <unit>",
                      fmt::format("'{}'", from),
                      near_hint(complaints_.diagnostics(), from, definitions_.unit_names()));
    return std::nullopt;
  }
  std::string_view wanted = from;
  if (input != nullptr && !input->unit.empty()) {
    wanted = input->unit;
  } else if (source->type == "distance") {
    wanted = options_.distance_unit;
  } else if (source->type == "angle") {
    wanted = "degree";
  }
  const auto target = definitions_.unit(wanted);
  if (!target || target->type != source->type) {
    complaints_.error("unit-type", user, "the unit measures something else",
                      fmt::format("a unit like {}", wanted), fmt::format("'{}'", from));
    return std::nullopt;
  }
  return source->scale / target->scale;
}

std::optional<Resolver::Key> Resolver::scale(const Source& source, Type type, double factor,
                                             const std::string& path, const Element& user) {
  const std::string name =
      type == Type::float_ ? "ND_multiply_float" : fmt::format("ND_multiply_{}FA", type_name(type));
  const NodeDef* def = definitions_.nodedef(name);
  if (def == nullptr) {
    complaints_.error("unknown-nodedef", user,
                      "units cannot be converted without the standard library", name);
    return std::nullopt;
  }
  Source second;
  second.kind = Source::Kind::literal;
  second.value = zero_value(Type::float_);
  second.value.floats[0] = static_cast<float>(factor);
  Instance& instance = instances_.add(*def, path + ":unit", &user);
  instance.inputs.emplace_back("in1", source);
  instance.inputs.emplace_back("in2", second);
  return output_of(instance);
}

std::optional<Resolver::Key> Resolver::retype(Resolved& result, Type type, const std::string& path,
                                              const Element& user) {
  const Type from = result.type;
  result.type = type;
  if (result.source.kind == Source::Kind::literal) {
    result.source.value = as_type(result.source.value, type);
    return std::nullopt;
  }
  if (result.source.kind == Source::Kind::unconnected) {
    result.source.kind = Source::Kind::literal;
    result.source.value = as_type(zero_value(from), type);
    return std::nullopt;
  }
  const auto find = [&](const std::string& name) {
    const NodeDef* def = definitions_.nodedef(name);
    if (def == nullptr) {
      complaints_.error("unknown-nodedef", user,
                        "types cannot be converted without the standard library", name);
      result.failed = true;
    }
    return def;
  };
  Source source = result.source;
  const bool is_number = from == Type::float_ || from == Type::integer;
  if (!is_number || type == Type::float_) {
    const NodeDef* def = find(fmt::format("ND_convert_{}_{}", type_name(from), type_name(type)));
    if (def == nullptr) return std::nullopt;
    Instance& instance = instances_.add(*def, path + ":type", &user);
    instance.inputs.emplace_back("in", source);
    return output_of(instance);
  }
  const int count = component_count(type);
  const NodeDef* def = find(fmt::format("ND_combine{}_{}", count, type_name(type)));
  if (def == nullptr) return std::nullopt;
  if (from == Type::integer) {
    const NodeDef* convert = find("ND_convert_integer_float");
    if (convert == nullptr) return std::nullopt;
    Instance& instance = instances_.add(*convert, path + ":number", &user);
    instance.inputs.emplace_back("in", source);
    const Resolved number = run(output_of(instance));
    result.failed = number.failed;
    if (number.failed) return std::nullopt;
    source = number.source;
  }
  Instance& instance = instances_.add(*def, path + ":type", &user);
  for (const NodeDefInput& input : def->inputs) instance.inputs.emplace_back(input.name, source);
  return output_of(instance);
}

}  // namespace nacre
