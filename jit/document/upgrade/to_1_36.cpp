#include <string>

#include "jit/document/upgrade/steps.h"

namespace nacre::upgrading {

namespace {

std::string replace_all(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

void rename_tokens(const Upgrade& upgrade, Element& element) {
  const std::string_view value = element.attribute("value");
  if (element.attribute("type") == "geomname" && value == "*") {
    upgrade.document.set_attribute(element, "value", "/");
  }
  if (element.attribute("type") == "filename" && value.find('%') != std::string_view::npos) {
    const std::string tiles = replace_all(std::string(value), "%UDIM", "<UDIM>");
    set_kept(upgrade.document, element, "value", replace_all(tiles, "%UVTILE", "<UVTILE>"));
  }
}

/// <override name="P"> sets the inputs whose `publicname` is P, of all shaders of
/// the material.
void apply_overrides(const Upgrade& upgrade, Element& material) {
  Document& document = upgrade.document;
  const auto is_override = [](const Element& child) { return child.category() == "override"; };
  std::unordered_map<std::string_view, const Element*> overrides;
  for (const Element* child : children_of(material)) {
    if (is_override(*child)) overrides.emplace(child->name(), child);
  }
  if (overrides.empty()) return;
  visit_unbound_inputs(upgrade, material, [&](Element& reference, const Element& input) {
    const auto found = overrides.find(input.attribute("publicname"));
    if (found == overrides.end()) return;
    const bool is_parameter = input.category() == "parameter";
    Element& binding = document.create_at(is_parameter ? "bindparam" : "bindinput", *found->second);
    rename(document, binding, input.name());
    document.set_attribute(binding, "type", input.attribute("type"));
    document.set_attribute(binding, "value", found->second->attribute("value"));
    document.append(reference, binding);
  });
  remove_children(document, material, is_override);
}

void replace_inheritance(const Upgrade& upgrade, Element& heir, std::string_view category,
                         std::string_view attribute) {
  for (Element* child : children_of(heir)) {
    if (child->category() != category) continue;
    upgrade.document.set_attribute(heir, "inherit", child->attribute(attribute));
  }
  remove_children(upgrade.document, heir,
                  [&](const Element& child) { return child.category() == category; });
}

}  // namespace

void upgrade_to_1_36(const Upgrade& upgrade) {
  for (Element* element : elements_of(upgrade.root)) {
    rename_tokens(upgrade, *element);
    if (element->category() == "look") {
      replace_inheritance(upgrade, *element, "lookinherit", "look");
    }
    if (element->category() != "material") continue;
    replace_inheritance(upgrade, *element, "materialinherit", "material");
    apply_overrides(upgrade, *element);
  }
}

}  // namespace nacre::upgrading
