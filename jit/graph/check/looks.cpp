// Looks: what is assigned to which geometry (MaterialX Geometry Extensions).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <vector>

#include "jit/document/circles.h"
#include "jit/document/select.h"
#include "jit/document/value_text.h"
#include "jit/graph/check/parts.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

class LookCheck : ElementCheck {
 public:
  LookCheck(const Document& document, const Definitions& definitions, Diagnostics& diagnostics)
      : ElementCheck(diagnostics), document_(document), definitions_(definitions) {}

  void run() {
    find_collection_circles();
    for (const Element& child : document_.root().children()) {
      const std::string_view category = child.category();
      if (category == "look") check_look(child);
      if (category == "lookgroup") check_group(child);
      if (category == "collection") check_collection(child);
      if (category == "geominfo") check_geominfo(child);
      if (category == "propertyset") check_properties(child, "property");
      if (category == "variantset") check_variantset(child);
    }
  }

 private:
  void check_look(const Element& look) {
    for (const Element& child : look.children()) {
      const std::string_view category = child.category();
      if (category == "materialassign") check_materialassign(child);
      if (category == "propertyassign") check_propertyassign(child);
      if (category == "propertysetassign") {
        check_reference(child, "propertyset", "propertyset");
        check_target(child);
      }
      if (category == "variantassign") check_variantassign(child);
      if (category == "visibility") check_visibility(child);
    }
  }

  void check_materialassign(const Element& element) {
    check_target(element);
    const std::string_view name = element.attribute("material");
    if (name.empty()) {
      error("missing-material", element, "no material is assigned", "material=\"NAME\"");
      return;
    }
    const Element* found = definitions_.resolve(name, element);
    if (found == nullptr) {
      error("unknown-material", element, "there is no material of this name",
            "the name of a material", in_quotes(name),
            near_hint(diagnostics_, name, document_.root().children(), [](const Element& each) {
              return each.attribute("type") == "material" ? each.name() : std::string_view();
            }));
      return;
    }
    const bool is_material = found->attribute("type") == "material" &&
                             (is_node(*found) || found->category() == "output");
    if (is_material || found->category() == "nodegraph") return;
    error("not-a-material", element, "what is assigned is no material", "a node of type material",
          fmt::format("<{}> {}", found->category(), in_quotes(name)));
  }

  // What an assignment is for: geometry by expression or by collection.
  void check_target(const Element& element) {
    const std::string_view collection = element.attribute("collection");
    if (!collection.empty()) check_reference(element, "collection", "collection");
    if (collection.empty() && element.attribute("geom").empty()) {
      warning("assigns-nothing", element, "the assignment names no geometry",
              "geom=\"EXPRESSION\" or collection=\"NAME\"", "");
    }
    check_expression(element, "geom");
  }

  // "*", "?", "[abc]", "{ab,cd}" must be closed (Geometry Name Expressions).
  void check_expression(const Element& element, std::string_view attribute) {
    const std::string_view text = element.attribute(attribute);
    std::vector<char> open;
    for (char c : text) {
      if (c == '[' || c == '{') open.push_back(c == '[' ? ']' : '}');
      if (c != ']' && c != '}') continue;
      if (open.empty() || open.back() != c) {
        open.push_back(c);
        break;
      }
      open.pop_back();
    }
    if (open.empty()) return;
    error("bad-expression", element, "brackets in the geometry expression do not match",
          fmt::format("a '{}' for each '{}'", open.back(), open.back() == ']' ? '[' : '{'),
          in_quotes(text));
  }

  // The element that an attribute names, which must be there and be of a category.
  const Element* check_reference(const Element& element, std::string_view attribute,
                                 std::string_view category) {
    const std::string_view name = element.attribute(attribute);
    if (name.empty()) {
      error(fmt::format("missing-{}", category), element, fmt::format("no {} is named", category),
            fmt::format("{}=\"NAME\"", attribute));
      return nullptr;
    }
    return find(element, name, category);
  }

  const Element* find(const Element& element, std::string_view name, std::string_view category) {
    const Element* found = definitions_.resolve(name, element);
    if (found != nullptr && found->category() == category) return found;
    error(fmt::format("unknown-{}", category), element,
          fmt::format("there is no {} of this name", category),
          fmt::format("the name of a <{}>", category), in_quotes(name),
          near_named(name, document_.root(), category));
    return nullptr;
  }

  std::string near_named(std::string_view name, const Element& scope,
                         std::string_view category) const {
    return near_hint(diagnostics_, name, scope.children(), [&](const Element& each) {
      return each.category() == category ? each.name() : std::string_view();
    });
  }

  void check_propertyassign(const Element& element) {
    if (element.attribute("property").empty()) {
      error("missing-property", element, "no property is named", "property=\"NAME\"");
    }
    check_target(element);
    check_value(element);
  }

  void check_properties(const Element& set, std::string_view category) {
    for (const Element& child : set.children()) {
      if (child.category() == category) check_value(child);
    }
  }

  void check_value(const Element& element) {
    if (!check_type_name(element, definitions_, diagnostics_)) return;
    const auto type = parse_type(element.attribute("type"));
    if (!type || parse_value(*type, element.attribute("value"))) return;
    error("bad-value", element, fmt::format("the value does not fit the type {}", type_name(*type)),
          expected_text(*type), in_quotes(element.attribute("value")));
  }

  void check_variantset(const Element& set) {
    for (const Element& variant : set.children()) {
      if (variant.category() != "variant") continue;
      for (const Element& port : variant.children()) {
        const bool holds_value = port.category() == "input" || port.category() == "token";
        if (holds_value) check_value(port);
      }
    }
  }

  void check_variantassign(const Element& element) {
    const Element* set = check_reference(element, "variantset", "variantset");
    if (set == nullptr) return;
    const std::string_view name = element.attribute("variant");
    const Element* found = set->child(name);
    if (found != nullptr && found->category() == "variant") return;
    error("unknown-variant", element, fmt::format("'{}' has no such variant", set->name()),
          "the name of a <variant>", in_quotes(name), near_named(name, *set, "variant"));
  }

  void check_visibility(const Element& element) {
    check_target(element);
    constexpr std::array<std::string_view, 4> kinds{"camera", "illumination", "shadow",
                                                    "secondary"};
    const std::string_view kind = element.attribute("vistype");
    if (!kind.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
      warning("unknown-vistype", element, "the kind of visibility is none of the standard's",
              fmt::format("{}", fmt::join(kinds, ", ")), in_quotes(kind),
              near_hint(diagnostics_, kind, kinds));
    }
    if (!element.attribute("viewercollection").empty()) {
      check_reference(element, "viewercollection", "collection");
    }
  }

  void check_group(const Element& group) {
    const std::vector<std::string_view> names = split_list(group.attribute("looks"));
    if (names.empty()) {
      warning("empty-lookgroup", group, "the group holds no looks", "looks=\"NAME, ...\"", "");
    }
    for (std::string_view name : names) find(group, name, "look");
    const std::string_view chosen = group.attribute("default");
    if (chosen.empty() || std::find(names.begin(), names.end(), chosen) != names.end()) return;
    error("unknown-look", group, "the default is none of the looks of the group",
          fmt::format("{}", fmt::join(names, ", ")), in_quotes(chosen),
          near_hint(diagnostics_, chosen, names));
  }

  void check_collection(const Element& collection) {
    check_expression(collection, "includegeom");
    check_expression(collection, "excludegeom");
    const std::vector<std::string_view> parts =
        split_list(collection.attribute("includecollection"));
    for (std::string_view name : parts) {
      const Element* part = find(collection, name, "collection");
      if (part != nullptr && circles_.at(part) == circles_.at(&collection)) {
        error("collection-cycle", collection, "the collection includes itself, directly or not", "",
              in_quotes(name));
      }
    }
    const bool holds_nothing = parts.empty() && collection.attribute("includegeom").empty();
    if (holds_nothing) {
      warning("empty-collection", collection, "the collection holds nothing",
              "includegeom or includecollection", "");
    }
  }

  std::vector<const Element*> included_by(const Element& collection) const {
    std::vector<const Element*> parts;
    for (std::string_view name : split_list(collection.attribute("includecollection"))) {
      const Element* found = definitions_.resolve(name, collection);
      if (found != nullptr && found->category() == "collection") parts.push_back(found);
    }
    return parts;
  }

  void find_collection_circles() {
    std::vector<const Element*> collections;
    for (const Element& child : document_.root().children()) {
      if (child.category() == "collection") collections.push_back(&child);
    }
    circles_ = find_circles(collections, [this](const Element& one) { return included_by(one); });
  }

  void check_geominfo(const Element& element) {
    check_target(element);
    check_properties(element, "geomprop");
    check_properties(element, "token");
  }

  const Document& document_;
  const Definitions& definitions_;
  std::unordered_map<const Element*, std::size_t> circles_;  ///< Of collections.
};

}  // namespace

void check_looks(const Document& document, const Definitions& definitions,
                 Diagnostics& diagnostics) {
  LookCheck(document, definitions, diagnostics).run();
}

}  // namespace nacre
