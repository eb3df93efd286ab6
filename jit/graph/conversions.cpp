// Colour spaces and units: nodes put between a value and who reads it.
#include <fmt/format.h>

#include "jit/document/read.h"
#include "jit/document/value_text.h"
#include "jit/graph/colorspace.h"
#include "jit/graph/resolver.h"

namespace nacre {

namespace {

std::string conversion_path(const std::string& path, std::string_view from, std::string_view to) {
  return fmt::format("{}:{}_to_{}", path, canonical_colorspace(from), canonical_colorspace(to));
}

}  // namespace

// From one space to another, by the host's configuration, by the data library, or by
// what the spaces are; null where nothing is to be done.
Resolver::Conversion Resolver::find_conversion(Type type, std::string_view from,
                                               std::string_view to, const Element& user) {
  if (type != Type::color3 && type != Type::color4) return {};
  if (from.empty() || to.empty()) return {};
  auto spaces = config_spaces(from, to);
  if (!spaces) {
    const std::string_view known_from = canonical_colorspace(from);
    const std::string_view known_to = canonical_colorspace(to);
    if (known_from.empty() || known_to.empty() || known_from == known_to) return {};
    if (const NodeDef* def = find_transform(known_from, known_to, type)) return {def, false};
    spaces = bridged_spaces(from, to);
    if (!spaces) {
      const bool is_input = to == working_space_;
      if (options_.lenient && is_input) {
        tolerates("unknown-colorspace", user, "there is no transform from this colour space",
                  "its numbers are taken as they are",
                  fmt::format("a space with a transform to {}", canonical_colorspace(to)),
                  fmt::format("'{}'", from));
        return {};
      }
      report_no_transform(from, to, user);
      return {nullptr, true};
    }
  }
  if (!is_conversion(*spaces)) return {};
  const NodeDef* def = find_config_transform(*spaces, type, user);
  return {def, def == nullptr};
}

// The nearest `colorspace` up the tree says what the numbers mean; the
// library's node "A_to_B" turns them into the working space (Specification,
// "Color Spaces and Color Management Systems").
std::optional<Resolver::Key> Resolver::convert_colour(const Source& source, Type type,
                                                      std::string_view space,
                                                      const std::string& path,
                                                      const Element& user) {
  if (source.kind == Source::Kind::unconnected) return std::nullopt;
  const NodeDef* def = find_conversion(type, space, working_space_, user).transform;
  if (def == nullptr) return std::nullopt;
  return transformed(source, *def, conversion_path(path, space, working_space_), user);
}

Resolver::Result Resolver::in_output_space(const Result& result, const std::string& name,
                                           const Element& user) {
  if (result.failed || result.source.kind == Source::Kind::unconnected) return result;
  const std::string& to = options_.output_space;
  const Conversion conversion = find_conversion(result.type, working_space_, to, user);
  if (conversion.failed) return failure();
  if (conversion.transform == nullptr) return result;
  return run(transformed(result.source, *conversion.transform,
                         conversion_path(name, working_space_, to), user));
}

Resolver::Key Resolver::transformed(const Source& source, const NodeDef& transform,
                                    std::string path, const Element& user) {
  Instance& instance = add_instance(transform, std::move(path), &user);
  instance.inputs.emplace_back(transform.inputs[0].name, source);
  return Key{Kind::output, 0, &instance, nullptr};
}

void Resolver::report_no_transform(std::string_view from, std::string_view to,
                                   const Element& user) {
  const bool is_output = from == working_space_;
  if (options_.colors == nullptr) {
    error("unknown-colorspace", user,
          fmt::format("there is no transform {} this colour space", is_output ? "to" : "from"),
          is_output ? fmt::format("a space with a transform from {}", canonical_colorspace(from))
                    : fmt::format("a space with a transform to {}", canonical_colorspace(to)),
          fmt::format("'{}'", is_output ? to : from));
    return;
  }
  error("unknown-colorspace", user, "there is no transform between these colour spaces",
        fmt::format("two of {}, two built in, or one of each and its role aces_interchange",
                    options_.colors->name()),
        fmt::format("'{}' to '{}'", from, to));
}

// The library's transform, or one made from what the spaces are.
const NodeDef* Resolver::find_transform(std::string_view from, std::string_view to, Type type) {
  const std::string transform = fmt::format("{}_to_{}", from, to);
  const std::string name = fmt::format("ND_{}_{}", transform, type_name(type));
  if (const NodeDef* def = definitions_.nodedef(name)) {
    const bool fits = !def->inputs.empty() && def->inputs[0].type == type &&
                      def->outputs.size() == 1 && def->outputs[0].type == type;
    return fits ? def : nullptr;
  }
  const auto [place, is_new] = transforms_.try_emplace(transform);
  Transform& made = place->second;
  if (is_new) {
    const std::string text = color_transform_text(from, to);
    if (text.empty()) return nullptr;
    Diagnostics none;
    made.document = read_document_text(text, transform, {}, none);
    made.definitions = std::make_unique<Definitions>(*made.document, &definitions_, none);
  }
  return made.definitions == nullptr ? nullptr : made.definitions->nodedef(name);
}

// From the unit a value is given in to the one its reader wants. A literal is
// converted on the spot; a file name keeps its unit for the texels read.
std::optional<Resolver::Key> Resolver::convert_unit(Result& result, const NodeDefInput& input,
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
    error("unknown-unit", user, "there is no unit of this name", "the name of a <unit>",
          fmt::format("'{}'", from));
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
    error("unit-type", user, "the unit measures something else",
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
    error("unknown-nodedef", user, "units cannot be converted without the standard library", name);
    return std::nullopt;
  }
  Source second;
  second.kind = Source::Kind::literal;
  second.value = zero_value(Type::float_);
  second.value.floats[0] = static_cast<float>(factor);
  Instance& instance = add_instance(*def, path + ":unit", &user);
  instance.inputs.emplace_back("in1", source);
  instance.inputs.emplace_back("in2", second);
  return Key{Kind::output, 0, &instance, nullptr};
}

}  // namespace nacre
