#include <optional>
#include <string>
#include <unordered_set>

#include "jit/document/upgrade/scope.h"
#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

std::string_view output_type(Element& nodedef) {
  for (const Element* child : children_of(nodedef)) {
    if (child->category() == "output") return child->attribute("type");
  }
  return nodedef.attribute("type");
}

bool is_shader_type(std::string_view type) {
  return type == "surfaceshader" || type == "displacementshader" || type == "volumeshader" ||
         type == "lightshader";
}

struct ShaderNode {
  std::string category;
  std::string type;
};

/// "ND_disney_brdf_surfaceshader" is of category disney_brdf: how the nodedefs of
/// the standard are called.
std::optional<ShaderNode> by_convention(std::string_view nodedef) {
  if (!nodedef.starts_with("ND_")) return std::nullopt;
  nodedef.remove_prefix(3);
  for (std::string_view type : {"surfaceshader", "displacementshader", "volumeshader"}) {
    const std::size_t at = nodedef.rfind(type);
    if (at == std::string_view::npos || at < 2 || nodedef[at - 1] != '_') continue;
    return ShaderNode{std::string(nodedef.substr(0, at - 1)), std::string(type)};
  }
  return std::nullopt;
}

std::optional<ShaderNode> shader_of(const Upgrade& upgrade, const Element& reference) {
  if (Element* nodedef = nodedef_of_shaderref(upgrade, reference)) {
    return ShaderNode{std::string(nodedef->attribute("node")), std::string(output_type(*nodedef))};
  }
  const std::string_view node = reference.attribute("node");
  const auto named = by_convention(reference.attribute("nodedef"));
  if (node.empty()) return named;
  ShaderNode shader{std::string(node), named ? named->type : "surfaceshader"};
  // The standard's own nodes of these names make no surface.
  if (node == "displacement") shader.type = "displacementshader";
  if (node == "volume") shader.type = "volumeshader";
  if (is_shader_type(reference.attribute("type"))) shader.type = reference.attribute("type");
  return shader;
}

void make_bindings_inputs(Element& shader) {
  for (Element* child : children_of(shader)) {
    if (child->category() == "bindinput" || child->category() == "bindparam") {
      Document::set_category(*child, "input");
    } else if (child->category() == "bindtoken") {
      Document::set_category(*child, "token");
    }
  }
}

/// Makes the reference the shader node itself, called by a name that is free.
void make_shader(const Upgrade& upgrade, Element& reference, const ShaderNode& shader,
                 std::string_view name) {
  Document& document = upgrade.document;
  Document::set_category(reference, document.intern(shader.category));
  rename(document, reference, name);
  set_kept(document, reference, "type", shader.type);
  document.remove_attribute(reference, "node");
  make_bindings_inputs(reference);
}

void connect_shader(const Upgrade& upgrade, Element& material, const Element& shader,
                    std::unordered_set<std::string_view>& connected) {
  const std::string_view type = shader.attribute("type");
  if (type == "volumeshader") Document::set_category(material, "volumematerial");
  if (!connected.insert(type).second) return;  // The first one stays.
  Element& input = add_input(upgrade.document, material, type, type, shader);
  upgrade.document.set_attribute(input, "nodename", shader.name());
}

void replace_material(const Upgrade& upgrade, Scope& scope, Element& material) {
  Document& document = upgrade.document;
  Document::set_category(material, "surfacematerial");
  document.set_attribute(material, "type", "material");
  const std::vector<Element*> children = children_of(material);
  remove_children(document, material,
                  [](const Element& child) { return child.category() == "shaderref"; });
  std::unordered_set<std::string_view> connected;
  for (Element* reference : children) {
    if (reference->category() != "shaderref") continue;
    const std::optional<ShaderNode> shader = shader_of(upgrade, *reference);
    if (!shader || shader->category.empty()) {
      cannot_upgrade(upgrade, *reference, "the node that this shader reference means is not known",
                     "node=\"CATEGORY\", or a nodedef of this file");
      continue;
    }
    const std::string name = scope.free_name(reference->name());
    make_shader(upgrade, *reference, *shader, name);
    scope.adopt(*reference, material);
    connect_shader(upgrade, material, *reference, connected);
  }
}

}  // namespace

Element* nodedef_of_shaderref(const Upgrade& upgrade, const Element& reference) {
  if (reference.has_attribute("nodedef")) {
    const auto found = upgrade.nodedefs.find(reference.attribute("nodedef"));
    return found == upgrade.nodedefs.end() ? nullptr : found->second;
  }
  const std::string_view node = reference.attribute("node");
  const std::string_view type = reference.attribute("type");
  if (node.empty()) return nullptr;
  const auto candidates = upgrade.nodedefs_of.find(node);
  if (candidates == upgrade.nodedefs_of.end()) return nullptr;
  for (Element* child : candidates->second) {
    if (child->attribute("version") != reference.attribute("version") &&
        (reference.has_attribute("version") || child->attribute("isdefaultversion") != "true")) {
      continue;
    }
    if (type.empty() || output_type(*child) == type) return child;
  }
  return nullptr;
}

void visit_unbound_inputs(const Upgrade& upgrade, Element& material, const UnboundInput& visit) {
  for (Element* reference : children_of(material)) {
    if (reference->category() != "shaderref") continue;
    Element* nodedef = nodedef_of_shaderref(upgrade, *reference);
    if (nodedef == nullptr) continue;
    if (!upgrade.spend(nodedef->child_count(), *reference)) return;
    const std::unordered_set<std::string_view> bound = names_of(*reference);
    for (const Element* input : children_of(*nodedef)) {
      if (!bound.contains(input->name())) visit(*reference, *input);
    }
  }
}

void replace_materials(const Upgrade& upgrade) {
  Scope scope(upgrade.document, upgrade.root);
  for (Element* material : scope.children()) {
    if (material->category() == "material") replace_material(upgrade, scope, *material);
  }
  scope.finish();
}

}  // namespace nacre::upgrading
