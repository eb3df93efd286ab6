// Colour spaces and units: nodes put between a value and who reads it.
#include <fmt/format.h>

#include "jit/document/read.h"
#include "jit/document/value_text.h"
#include "jit/graph/colorspace.h"
#include "jit/graph/resolver.h"

namespace nacre {

namespace {

// Colours are, between spaces that are not the same; "": a space that is not converted.
bool is_transformed(const Source& source, Type type, std::string_view from, std::string_view to) {
  if (type != Type::color3 && type != Type::color4) return false;
  if (source.kind == Source::Kind::unconnected) return false;
  return !from.empty() && !to.empty() && from != to;
}

}  // namespace

// The nearest `colorspace` up the tree says what the numbers mean; the
// library's node "A_to_B" turns them into the working space (Specification,
// "Color Spaces and Color Management Systems").
std::optional<Resolver::Key> Resolver::convert_colour(const Source& source, Type type,
                                                      std::string_view space,
                                                      const std::string& path,
                                                      const Element& user) {
  const std::string_view from = canonical_colorspace(space);
  const std::string_view to = working_space();
  if (!is_transformed(source, type, from, to)) return std::nullopt;
  const NodeDef* def = find_transform(from, to, type);
  if (def == nullptr) {
    error("unknown-colorspace", user, "there is no transform from this colour space",
          fmt::format("a space with a transform to {}", to), fmt::format("'{}'", space));
    return std::nullopt;
  }
  return transformed(source, *def, fmt::format("{}:{}_to_{}", path, from, to), user);
}

Resolver::Result Resolver::in_output_space(const Result& result, const std::string& name,
                                           const Element& user) {
  const std::string_view from = working_space();
  const std::string_view to = canonical_colorspace(options_.output_space);
  if (result.failed || !is_transformed(result.source, result.type, from, to)) return result;
  const NodeDef* def = find_transform(from, to, result.type);
  if (def == nullptr) {
    error("unknown-colorspace", user, "there is no transform to this colour space",
          fmt::format("a space with a transform from {}", from),
          fmt::format("'{}'", options_.output_space));
    return failure();
  }
  return run(transformed(result.source, *def, fmt::format("{}:{}_to_{}", name, from, to), user));
}

Resolver::Key Resolver::transformed(const Source& source, const NodeDef& transform,
                                    std::string path, const Element& user) {
  Instance& instance = add_instance(transform, std::move(path), &user);
  instance.inputs.emplace_back(transform.inputs[0].name, source);
  return Key{Kind::output, 0, &instance, nullptr};
}

// What the host asks for; without, the document's own (Specification, "Color Spaces
// and Color Management Systems"), or else what the library's transforms lead to.
std::string_view Resolver::working_space() const {
  std::string_view name = options_.working_space;
  if (name.empty()) name = document_.root().attribute("colorspace");
  return name.empty() ? "lin_rec709" : canonical_colorspace(name);
}

// The library's transform, or one made from what the spaces are.
const NodeDef* Resolver::find_transform(std::string_view from, std::string_view to, Type type) {
  const std::string transform = fmt::format("{}_to_{}", from, to);
  const std::string name = fmt::format("ND_{}_{}", transform, type_name(type));
  if (const NodeDef* def = definitions_.nodedef(name)) {
    return def->inputs.empty() || def->outputs.size() != 1 ? nullptr : def;
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
