#include "jit/graph/look/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <unordered_set>

#include "jit/document/inheritance.h"
#include "jit/document/nodedef.h"
#include "jit/document/value_text.h"
#include "jit/graph/look/geometry_names.h"
#include "runtime/float_environment.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

GeometryTarget target_of(const Element& element, std::string_view geom = "geom",
                         std::string_view collection = "collection") {
  return {geom_list(element, geom), std::string(element.attribute(collection))};
}

VariantChoice variant_of(const Element& element) {
  return {std::string(element.attribute("variantset")), std::string(element.attribute("variant"))};
}

Value value_of(const Element& element) {
  const auto type = parse_type(element.attribute("type"));
  if (!type) return {};
  return parse_value(*type, element.attribute("value")).value_or(Value{});
}

PropertyAssignment property_of(const Element& element, const Element& property,
                               std::string_view name) {
  PropertyAssignment assignment;
  static_cast<GeometryTarget&>(assignment) = target_of(element);
  assignment.property = property.attribute(name);
  assignment.target = property.attribute("target");
  assignment.value = value_of(property);
  assignment.text = fmt::format("{} '{}'", property.attribute("type"), property.attribute("value"));
  assignment.where = location(property);
  return assignment;
}

void add_property_set(const Element& element, Look& look) {
  const Element& root = element.document().root();
  const std::string_view name = element.attribute("propertyset");
  const Element* set = root.child(qualified_name(element, name));
  if (set == nullptr) set = root.child(name);
  if (set == nullptr || set->category() != "propertyset") return;
  for (const Element& property : set->children()) {
    if (property.category() != "property") continue;
    look.properties.push_back(property_of(element, property, "name"));
  }
}

void add_assignment(const Element& element, Look& look) {
  Assignment& assignment = look.assignments.emplace_back();
  static_cast<GeometryTarget&>(assignment) = target_of(element);
  assignment.material = element.attribute("material");
  assignment.exclusive = element.attribute("exclusive") != "false";
  for (const Element& child : element.children()) {
    if (child.category() == "variantassign") assignment.variants.push_back(variant_of(child));
  }
}

void add_visibility(const Element& element, Look& look) {
  VisibilityAssignment& visibility = look.visibilities.emplace_back();
  static_cast<GeometryTarget&>(visibility) = target_of(element);
  visibility.viewer = target_of(element, "viewergeom", "viewercollection");
  visibility.vistype = element.attribute("vistype");
  visibility.visible = element.attribute("visible") != "false";
}

void add_contents(const Element& element, Look& look) {
  for (const Element& child : element.children()) {
    if (child.category() == "materialassign") add_assignment(child, look);
    if (child.category() == "variantassign") look.variants.push_back(variant_of(child));
    if (child.category() == "visibility") add_visibility(child, look);
    if (child.category() == "propertysetassign") add_property_set(child, look);
    if (child.category() == "propertyassign") {
      look.properties.push_back(property_of(child, child, "property"));
    }
  }
}

// The look and those it inherits from, nearest first.
std::vector<const Element*> inheritance(const Element& look, Diagnostics& diagnostics) {
  const Element& root = look.document().root();
  const auto base_of = [&](const Element& heir) -> const Element* {
    if (!heir.has_attribute("inherit")) return nullptr;
    const std::string_view name = heir.attribute("inherit");
    const Element* base = root.child(qualified_name(heir, name));
    if (base == nullptr) base = root.child(name);
    if (base != nullptr && base->category() == "look") return base;
    diagnostics.error("unknown-look", location(heir), "the look to inherit from does not exist",
                      "the name of another look", fmt::format("'{}'", name),
                      near_hint(diagnostics, name, root.children(), [](const Element& each) {
                        return each.category() == "look" ? each.name() : std::string_view();
                      }));
    return nullptr;
  };
  return inheritance_chain(look, "look", base_of, diagnostics);
}

void add_group_looks(const Element& group, std::unordered_set<const Element*>& seen,
                     std::vector<std::string>& looks) {
  if (!seen.insert(&group).second) return;
  const Element& root = group.document().root();
  for (const std::string_view name : split_list(group.attribute("looks"))) {
    const Element* member = root.child(qualified_name(group, name));
    if (member == nullptr) member = root.child(name);
    if (member == nullptr) continue;
    if (member->category() == "lookgroup") add_group_looks(*member, seen, looks);
    if (member->category() != "look") continue;
    std::string look(member->name());
    if (std::find(looks.begin(), looks.end(), look) == looks.end()) looks.push_back(look);
  }
}

}  // namespace

std::vector<Look> find_looks(const Document& document, Diagnostics& diagnostics) {
  const ScopedDefaultFloatEnvironment environment;
  std::vector<Look> looks;
  for (const Element& element : document.root().children()) {
    if (element.category() != "look") continue;
    const std::vector<const Element*> chain = inheritance(element, diagnostics);
    Look& look = looks.emplace_back();
    look.name = element.name();
    for (const Element* at : std::views::reverse(chain)) add_contents(*at, look);
  }
  return looks;
}

std::vector<LookGroup> find_look_groups(const Document& document) {
  std::vector<LookGroup> groups;
  for (const Element& element : document.root().children()) {
    if (element.category() != "lookgroup") continue;
    LookGroup& group = groups.emplace_back();
    group.name = element.name();
    group.default_look = element.attribute("default");
    std::unordered_set<const Element*> seen;
    add_group_looks(element, seen, group.looks);
  }
  return groups;
}

std::vector<VariantSet> find_variant_sets(const Document& document) {
  std::vector<VariantSet> sets;
  for (const Element& element : document.root().children()) {
    if (element.category() != "variantset") continue;
    VariantSet& set = sets.emplace_back();
    set.name = element.name();
    set.node = element.attribute("node");
    set.nodedef = element.attribute("nodedef");
    for (const Element& variant : element.children()) {
      if (variant.category() == "variant") set.variants.emplace_back(variant.name());
    }
  }
  return sets;
}

}  // namespace nacre
