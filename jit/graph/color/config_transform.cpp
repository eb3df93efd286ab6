// Colour spaces of the host's configuration, and their transforms as nodes whose
// implementation is the text that the configuration gives.
#include <fmt/format.h>

#include "jit/document/read.h"
#include "jit/graph/color/color_transforms.h"
#include "jit/graph/color/colorspace.h"

namespace nacre {

namespace {

// By the name that the built-in spaces have for it.
constexpr std::string_view aces_interchange = "lin_ap0";

}  // namespace

// Nothing where the configuration does not have both spaces.
std::optional<ColorTransforms::ConfigSpaces> ColorTransforms::config_spaces(
    std::string_view from, std::string_view to) const {
  if (config_ == nullptr) return std::nullopt;
  auto source = config_->find(from);
  if (!source) return std::nullopt;
  auto target = config_->find(to);
  if (!target) return std::nullopt;
  return ConfigSpaces{std::move(*source), std::move(*target), "", ""};
}

// One end of the configuration and one built in meet where the configuration says what
// ACES 2065-1 is: its role aces_interchange is there to convert between configurations.
std::optional<ColorTransforms::ConfigSpaces> ColorTransforms::bridged_spaces(
    std::string_view from, std::string_view to) const {
  const auto is_built_in = [](std::string_view name) {
    return color_matrix(canonical_colorspace(name), aces_interchange).has_value();
  };
  if (config_ == nullptr) return std::nullopt;
  const auto bridge = config_->find("aces_interchange");
  if (!bridge) return std::nullopt;
  const auto source = config_->find(from);
  if (source && is_built_in(to)) {
    return ConfigSpaces{*source, *bridge, "", std::string(canonical_colorspace(to))};
  }
  const auto target = config_->find(to);
  if (target && is_built_in(from)) {
    return ConfigSpaces{*bridge, *target, std::string(canonical_colorspace(from)), ""};
  }
  return std::nullopt;
}

bool ColorTransforms::ConfigSpaces::differ() const {
  if (from.is_data || to.is_data) return false;
  return from.name != to.name || !before.empty() || !after.empty();
}

const NodeDef* ColorTransforms::find_in_config(const ConfigSpaces& spaces, Type type,
                                               const Element& user) {
  const std::string& from = spaces.from.name;
  const std::string& to = spaces.to.name;
  const auto [place, is_new] =
      transforms_.try_emplace(fmt::format("{}\n{}\n{}\n{}", spaces.before, from, to, spaces.after));
  Transform& made = place->second;
  if (is_new) {
    made.color = config_->transform(from, to, made.fault);
    made.spaces = spaces;
    made.name = fmt::format("config_transform_{}", transforms_.size());
    made.where = {fmt::format("{}: '{}' to '{}'", config_->name(), from, to), 1, 0, {}};
    Diagnostics none;
    // Named by a number: names of spaces need be no names of XML.
    const std::string text =
        "<materialx version=\"1.39\">\n" + color_transform_nodedefs(made.name) + "</materialx>\n";
    made.document = read_document_text(text, made.name, {}, none);
    made.definitions = std::make_unique<Definitions>(*made.document, &definitions_, none);
  }
  if (made.color == nullptr) {
    complaints_.error(
        "no-color-transform", user,
        fmt::format("{} has no transform from '{}' to '{}'", config_->name(), from, to), "",
        made.fault);
    return nullptr;
  }
  return made.definitions->nodedef(fmt::format("ND_{}_{}", made.name, type_name(type)));
}

// The transform that a nodedef was made for by find_in_config, or null.
const ColorTransforms::Transform* ColorTransforms::transform_of(const NodeDef& def) const {
  for (const auto& [key, transform] : transforms_) {
    if (transform.color != nullptr && transform.document.get() == &def.element->document()) {
      return &transform;
    }
  }
  return nullptr;
}

std::optional<NodeText> ColorTransforms::text_of(const NodeDef& def) const {
  const Transform* transform = transform_of(def);
  if (transform == nullptr) return std::nullopt;
  const ColorTransform& color = *transform->color;
  const ConfigSpaces& spaces = transform->spaces;
  NodeText source;
  source.nodedef = def.name;
  source.text = color.text + '\n';
  source.function = color.function + "_of_" + std::string(type_name(def.outputs[0].type));
  std::string before, after;  // Applied to the colour c.
  if (!spaces.before.empty()) {
    source.text += color_transform_glsl(spaces.before, aces_interchange, "to_aces_interchange");
    before = "c.rgb = to_aces_interchange(c.rgb); ";
  }
  if (!spaces.after.empty()) {
    source.text += color_transform_glsl(aces_interchange, spaces.after, "from_aces_interchange");
    after = "c.rgb = from_aces_interchange(c.rgb); ";
  }
  const bool is_opaque = def.outputs[0].type == Type::color3;
  source.text += fmt::format(
      "{0} {1}({0} given) {{ vec4 c = {2}; {3}c = {4}(c); {5}return c{6}; }}\n",
      is_opaque ? "vec3" : "vec4", source.function, is_opaque ? "vec4(given, 1.0)" : "given",
      before, color.function, after, is_opaque ? ".rgb" : "");
  source.document = config_->name();
  source.tables = color.tables;
  source.where = transform->where;
  return source;
}

}  // namespace nacre
