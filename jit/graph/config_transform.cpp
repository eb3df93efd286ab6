// Colour spaces of the host's configuration, and their transforms as nodes whose
// implementation is the text that the configuration gives.
#include <fmt/format.h>

#include "jit/document/read.h"
#include "jit/graph/colorspace.h"
#include "jit/graph/resolver.h"

namespace nacre {

namespace {

// Named by a number: names of spaces need be no names of XML.
std::string transform_nodedefs(const std::string& name) {
  std::string text = "<materialx version=\"1.39\">\n";
  for (const int channels : {3, 4}) {
    text += fmt::format(
        "<nodedef name=\"ND_{0}_color{1}\" node=\"{0}\" nodegroup=\"colortransform\">"
        "<input name=\"in\" type=\"color{1}\" value=\"{2}\"/>"
        "<output name=\"out\" type=\"color{1}\" defaultinput=\"in\"/></nodedef>\n",
        name, channels, channels == 3 ? "0, 0, 0" : "0, 0, 0, 1");
  }
  return text + "</materialx>\n";
}

}  // namespace

std::string find_working_space(const GraphOptions& options, const Document& document) {
  std::string name = options.working_space.value_or("");
  if (name.empty() && options.working_space) name = document.root().attribute("colorspace");
  if (!name.empty()) return name;
  const auto has = [&](const char* space) {
    return options.colors != nullptr && options.colors->find(space).has_value();
  };
  return !has("lin_rec709") && has("scene_linear") ? "scene_linear" : "lin_rec709";
}

// Nothing where the configuration does not have both spaces.
std::optional<Resolver::ConfigSpaces> Resolver::config_spaces(std::string_view from,
                                                              std::string_view to) const {
  if (options_.colors == nullptr) return std::nullopt;
  auto source = options_.colors->find(from);
  if (!source) return std::nullopt;
  auto target = options_.colors->find(to);
  if (!target) return std::nullopt;
  return ConfigSpaces{std::move(*source), std::move(*target)};
}

const NodeDef* Resolver::find_config_transform(const ConfigSpaces& spaces, Type type,
                                               const Element& user) {
  const std::string& from = spaces.from.name;
  const std::string& to = spaces.to.name;
  const auto [place, is_new] = transforms_.try_emplace(fmt::format("{}\n{}", from, to));
  Transform& made = place->second;
  if (is_new) {
    made.color = options_.colors->transform(from, to, made.fault);
    made.name = fmt::format("config_transform_{}", transforms_.size());
    made.where = {fmt::format("{}: '{}' to '{}'", options_.colors->name(), from, to), 1, 0, {}};
    Diagnostics none;
    made.document = read_document_text(transform_nodedefs(made.name), made.name, {}, none);
    made.definitions = std::make_unique<Definitions>(*made.document, &definitions_, none);
  }
  if (made.color == nullptr) {
    error("no-color-transform", user,
          fmt::format("{} has no transform from '{}' to '{}'", options_.colors->name(), from, to),
          "", made.fault);
    return nullptr;
  }
  return made.definitions->nodedef(fmt::format("ND_{}_{}", made.name, type_name(type)));
}

// The transform that a nodedef was made for by find_config_transform, or null.
const Resolver::Transform* Resolver::config_transform_of(const NodeDef& def) const {
  for (const auto& [key, transform] : transforms_) {
    if (transform.color != nullptr && transform.document.get() == &def.element->document()) {
      return &transform;
    }
  }
  return nullptr;
}

NodeSource Resolver::config_source(const NodeDef& def, const Transform& transform) const {
  const ColorTransform& color = *transform.color;
  NodeSource source;
  source.nodedef = def.name;
  source.function = color.function;
  source.text = color.text;
  if (def.outputs[0].type == Type::color3) {
    source.function += "_of_color3";
    source.text += fmt::format("\nvec3 {}(vec3 rgb) {{ return {}(vec4(rgb, 1.0)).rgb; }}\n",
                               source.function, color.function);
  }
  source.document = options_.colors->name();
  source.tables = color.tables;
  source.where = transform.where;
  return source;
}

}  // namespace nacre
