#include "examples/tool/scene/gltf_pbr_nodes.h"

#include <algorithm>
#include <string_view>

namespace nacre::tool {

namespace {

constexpr std::string_view plain = "gltf_pbr";

/// The child of that name; null if there is none.
Element* child(Element& parent, std::string_view name) {
  Element* each = Document::first_child(parent);
  while (each != nullptr && each->name() != name) each = Document::next_sibling(*each);
  return each;
}

/// The surface of the graph has no inside.
bool make_wall(NewDocument& document, Element& graph) {
  Element* surface = child(graph, "shader_constructor");
  if (surface == nullptr) return false;
  document.set(document.add_input(*surface, "thin_walled", "boolean"), "value", "true");
  return true;
}

/// The medium comes below what transmits.
bool make_volume(NewDocument& document, Element& graph) {
  constexpr std::string_view medium = "isotropic_volume", clear = "transmission_bsdf";
  Element* mix = child(graph, "transmission_mix");
  Element* foreground = mix == nullptr ? nullptr : child(*mix, "fg");
  const bool is_known = foreground != nullptr && foreground->attribute("nodename") == clear &&
                        child(graph, medium) != nullptr;
  if (!is_known) return false;
  Element& layer = document.make("layer", "transmission_above_volume", "BSDF");
  document.set(document.add_input(layer, "top", "BSDF"), "nodename", clear);
  document.set(document.add_input(layer, "base", "VDF"), "nodename", medium);
  document.append(graph, layer);
  document.set(*foreground, "nodename", layer.name());
  return true;
}

}  // namespace

std::string GltfPbrNodes::category(Kind kind) {
  const auto [place, is_new] = made_.try_emplace(kind, plain);
  if (is_new && kind != Kind::plain) place->second = make(kind);
  return place->second;
}

std::string GltfPbrNodes::make(Kind kind) {
  const auto children = library_.root().children();
  const auto def = std::ranges::find_if(children, [](const Element& each) {
    return each.category() == "nodedef" && each.attribute("node") == plain;
  });
  const auto graph = std::ranges::find_if(children, [&](const Element& each) {
    return def != children.end() && each.category() == "nodegraph" &&
           each.attribute("nodedef") == (*def).name();
  });
  if (graph == children.end()) return std::string(plain);
  Element& body = document_.copy_of(*graph);
  const bool is_made =
      kind == Kind::wall ? make_wall(document_, body) : make_volume(document_, body);
  if (!is_made) return std::string(plain);
  const std::string category = std::string(plain) + (kind == Kind::wall ? "_wall" : "_volume");
  const std::string def_name = document_.free_name("ND_" + category);
  Element& declared = document_.copy_of(*def);
  document_.set(declared, "name", def_name);
  document_.set(declared, "node", category);
  document_.set(body, "name", document_.free_name("NG_" + category));
  document_.set(body, "nodedef", def_name);
  document_.append(document_.root(), declared);
  document_.append(document_.root(), body);
  return category;
}

}  // namespace nacre::tool
