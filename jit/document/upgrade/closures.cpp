#include <array>
#include <string>
#include <unordered_map>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

struct Renamed {
  std::string_view before;
  std::string_view after;
  bool was_nested;  ///< Had a `base` closure below it.
};

constexpr auto closures = std::to_array<Renamed>({
    {"burley_diffuse_brdf", "burley_diffuse_bsdf", false},
    {"conductor_brdf", "conductor_bsdf", false},
    {"dielectric_brdf", "dielectric_bsdf", true},
    {"dielectric_btdf", "dielectric_bsdf", false},
    {"diffuse_brdf", "oren_nayar_diffuse_bsdf", false},
    {"diffuse_btdf", "translucent_bsdf", false},
    {"generalized_schlick_brdf", "generalized_schlick_bsdf", true},
    {"sheen_brdf", "sheen_bsdf", true},
    {"subsurface_brdf", "subsurface_bsdf", false},
    {"thin_film_brdf", "thin_film_bsdf", true},
});

const Renamed* renamed_of(std::string_view category) {
  for (const Renamed& closure : closures) {
    if (closure.before == category) return &closure;
  }
  return nullptr;
}

/// A closure with a `base` is the top of a layer, which takes its name so that
/// what reads it reads the whole.
void unnest(const Upgrade& upgrade, Scope& scope, Element& node) {
  Document& document = upgrade.document;
  Element* base = input_of(node, "base");
  if (base == nullptr) return;
  if (is_connected(*base)) {
    const std::string name(node.name());
    scope.rename(node, scope.free_name(name + "__layer_top"));
    Element& layer = scope.add_node_after("layer", name, "BSDF", node);
    document.set_attribute(add_input(document, layer, "top", "BSDF", node), "nodename",
                           node.name());
    copy_binding(document, *base, add_input(document, layer, "base", "BSDF", *base));
  }
  remove_child(document, node, *base);
}

void transmit_only(const Upgrade& upgrade, Element& node) {
  if (const Element* interior = input_of(node, "interior")) {
    remove_child(upgrade.document, node, *interior);
  }
  Element& mode = add_input(upgrade.document, node, "scatter_mode", "string", node);
  upgrade.document.set_attribute(mode, "value", "T");
}

/// Reflectivity and edge colour go through the node that makes indices of them.
void insert_artistic_ior(const Upgrade& upgrade, Scope& scope, Element& node) {
  Document& document = upgrade.document;
  Element& artistic = scope.add_node("artistic_ior", std::string(node.name()) + "__artistic_ior",
                                     "multioutput", node);
  for (std::string_view name : {"reflectivity", "edge_color"}) {
    Element* input = input_of(node, name);
    if (input == nullptr) continue;
    remove_child(document, node, *input);
    document.append(artistic, *input);
  }
  for (std::string_view name : {"ior", "extinction"}) {
    Element& input = add_input(document, node, name, "color3", node);
    document.set_attribute(input, "nodename", artistic.name());
    document.set_attribute(input, "output", name);
  }
}

void rename_closure(const Upgrade& upgrade, Scope& scope, Element& node, const Renamed& closure) {
  Document::set_category(node, closure.after);
  rename_nodedef(upgrade, node, std::string("ND_") + std::string(closure.after));
  if (closure.was_nested) unnest(upgrade, scope, node);
  if (closure.before == "dielectric_btdf") transmit_only(upgrade, node);
  if (closure.before == "conductor_brdf") insert_artistic_ior(upgrade, scope, node);
}

/// The outputs of artistic_ior were vectors and are colours.
void convert_indices(const Upgrade& upgrade, Scope& scope, Element& node) {
  Document& document = upgrade.document;
  for (Element* input : children_of(node)) {
    const std::string_view output = input->attribute("output");
    if (input->category() != "input" || input->attribute("type") != "vector3") continue;
    if (output != "ior" && output != "extinction") continue;
    const Element* source = scope.find(input->attribute("nodename"));
    if (source == nullptr || source->category() != "artistic_ior") continue;
    Element& convert = scope.add_node(
        "convert", std::string(node.name()) + "__convert_" + std::string(output), "vector3", node);
    copy_binding(document, *input, add_input(document, convert, "in", "color3", *input));
    connect(document, *input, convert);
  }
  if (node.category() != "artistic_ior") return;
  for (Element* output : children_of(node)) {
    if (output->category() == "output") document.set_attribute(*output, "type", "color3");
  }
}

}  // namespace

void rename_closures(const Upgrade& upgrade) {
  for (Element* graph : graphs_of(upgrade.root)) {
    Scope scope(upgrade.document, *graph);
    for (Element* node : scope.children()) {
      const bool is_own = has_own_nodedef(upgrade, *node);
      const Renamed* closure = is_own ? nullptr : renamed_of(node->category());
      if (closure != nullptr) rename_closure(upgrade, scope, *node, *closure);
      convert_indices(upgrade, scope, *node);
    }
    scope.finish();
  }
}

}  // namespace nacre::upgrading
