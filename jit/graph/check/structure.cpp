// Faults of form that the reader passes, because a document may hold elements and
// attributes of others (Specification, "Custom Attributes").
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "jit/document/select.h"
#include "jit/document/value_text.h"
#include "jit/graph/check/parts.h"

namespace nacre {

namespace {

constexpr std::array named = std::to_array<std::string_view>(
    {"collection", "geominfo",    "geomprop",  "geompropdef", "implementation", "input",
     "look",       "lookgroup",   "member",    "nodedef",     "nodegraph",      "output",
     "property",   "propertyset", "targetdef", "token",       "typedef",        "unit",
     "unitdef",    "unittypedef", "variant",   "variantset"});

constexpr std::array only_at_root = std::to_array<std::string_view>(
    {"attributedef", "collection", "geominfo", "geompropdef", "implementation", "look", "lookgroup",
     "materialx", "nodedef", "propertyset", "targetdef", "typedef", "unitdef", "unittypedef",
     "variantset", "xi:include"});

struct Place {
  std::string_view element;
  std::string_view parent;
};
constexpr std::array places = std::to_array<Place>({{"geomprop", "geominfo"},
                                                    {"materialassign", "look"},
                                                    {"member", "typedef"},
                                                    {"property", "propertyset"},
                                                    {"propertyassign", "look"},
                                                    {"propertysetassign", "look"},
                                                    {"unit", "unitdef"},
                                                    {"variant", "variantset"},
                                                    {"visibility", "look"}});

struct Successor {
  std::string_view element;
  std::string_view now;
};
constexpr std::array obsolete =
    std::to_array<Successor>({{"bindinput", "<input>"},
                              {"bindparam", "<input>"},
                              {"bindtoken", "<token>"},
                              {"material", "<surfacematerial>"},
                              {"parameter", "<input>"},
                              {"shaderref", "<surfacematerial> with a connected shader node"}});

constexpr std::array attributes = std::to_array<std::string_view>({"name",
                                                                   "type",
                                                                   "value",
                                                                   "nodename",
                                                                   "nodegraph",
                                                                   "output",
                                                                   "interfacename",
                                                                   "nodedef",
                                                                   "node",
                                                                   "nodegroup",
                                                                   "version",
                                                                   "isdefaultversion",
                                                                   "inherit",
                                                                   "target",
                                                                   "colorspace",
                                                                   "unit",
                                                                   "unittype",
                                                                   "fileprefix",
                                                                   "geomprefix",
                                                                   "namespace",
                                                                   "uniform",
                                                                   "default",
                                                                   "defaultgeomprop",
                                                                   "defaultinput",
                                                                   "enum",
                                                                   "enumvalues",
                                                                   "uimin",
                                                                   "uimax",
                                                                   "uisoftmin",
                                                                   "uisoftmax",
                                                                   "uistep",
                                                                   "uiname",
                                                                   "uifolder",
                                                                   "uiadvanced",
                                                                   "doc",
                                                                   "href",
                                                                   "material",
                                                                   "collection",
                                                                   "geom",
                                                                   "exclusive",
                                                                   "includegeom",
                                                                   "excludegeom",
                                                                   "includecollection",
                                                                   "geomprop",
                                                                   "space",
                                                                   "index",
                                                                   "implname",
                                                                   "impltype",
                                                                   "looks",
                                                                   "variantset",
                                                                   "variant",
                                                                   "vistype",
                                                                   "visible",
                                                                   "property",
                                                                   "propertyset",
                                                                   "scale"});

constexpr std::array booleans = std::to_array<std::string_view>(
    {"exclusive", "exportable", "isdefaultversion", "uiadvanced", "uniform", "visible"});

constexpr std::array bounds =
    std::to_array<std::string_view>({"uimin", "uimax", "uisoftmin", "uisoftmax", "uistep"});

template <class List>
bool holds(const List& list, std::string_view wanted) {
  return std::find(list.begin(), list.end(), wanted) != list.end();
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

class StructureCheck : ElementCheck {
 public:
  StructureCheck(const Document& document, const Definitions& definitions, bool lenient,
                 Diagnostics& diagnostics)
      : ElementCheck(diagnostics, lenient), document_(document), definitions_(definitions) {}

  void run() {
    std::vector<const Element*> pending{&document_.root()};
    while (!pending.empty()) {
      const Element& element = *pending.back();
      pending.pop_back();
      check_attributes(element);
      if (element.parent() != nullptr) check_element(element);
      const std::size_t first = pending.size();
      for (const Element& child : element.children()) pending.push_back(&child);
      std::reverse(pending.begin() + static_cast<std::ptrdiff_t>(first), pending.end());
    }
  }

 private:
  void check_element(const Element& element) {
    const std::string_view category = element.category();
    if (holds(named, category) && element.name().empty() && !element.has_attribute("name")) {
      error("missing-name", element, fmt::format("the {} has no name", category), "name=\"NAME\"");
    }
    for (const Successor& one : obsolete) {
      if (one.element != category) continue;
      tolerable("obsolete-element", element,
                fmt::format("<{}> is of older versions of the format", category),
                "it is left out of account", std::string(one.now));
      return;
    }
    check_place(element);
    check_spelling(element);
    check_stray_node(element);
  }

  void check_place(const Element& element) {
    const std::string_view category = element.category();
    const Element& parent = *element.parent();
    if (category == "materialx") {
      error("misplaced-element", element, "the document has another document inside",
            "one <materialx>");
      return;
    }
    std::string_view wanted;
    if (holds(only_at_root, category) && parent.parent() != nullptr) wanted = "materialx";
    for (const Place& place : places) {
      if (place.element == category && place.parent != parent.category()) wanted = place.parent;
    }
    const bool is_port = category == "input" || category == "output";
    if (is_port &&
        holds(std::array<std::string_view, 3>{"input", "output", "look"}, parent.category())) {
      wanted = "a node or node graph";
    }
    if (category == "nodegraph" && parent.parent() != nullptr && parent.category() != "nodegraph") {
      wanted = "materialx";
    }
    if (wanted.empty()) return;
    tolerable("misplaced-element", element, fmt::format("<{}> means nothing here", category),
              "it is left out of account",
              is_port ? std::string(wanted) : fmt::format("a place in <{}>", wanted),
              fmt::format("in <{}>", quoted_name(parent.category())));
  }

  // A custom element may have any name; one that differs in capitals is a slip.
  void check_spelling(const Element& element) {
    const std::string_view category = element.category();
    const std::string small = lower(category);
    if (small == category) return;
    const bool is_known = holds(named, small) || holds(only_at_root, small) ||
                          std::any_of(places.begin(), places.end(),
                                      [&](const Place& place) { return place.element == small; });
    // In a graph it would be a node, and selection finds none of that category.
    if (!is_known || is_node(element)) return;
    warning("misspelt-element", element, "the element is not known, and left out of account",
            fmt::format("<{}>", small), fmt::format("<{}>", category));
  }

  // What would be a node elsewhere; other unknown elements may be somebody's own.
  void check_stray_node(const Element& element) {
    const Element& parent = *element.parent();
    if (parent.category() == "materialx" || parent.category() == "nodegraph") return;
    if (!is_node_category(element.category())) return;
    if (definitions_.of_category(element.category()).empty()) return;
    warning("stray-element", element, "a node here is left out of account",
            "a place in <materialx> or <nodegraph>",
            fmt::format("in <{}>", quoted_name(parent.category())));
  }

  void check_attributes(const Element& element) {
    for (const Attribute& attribute : element.attributes()) {
      if (holds(booleans, attribute.name)) check_boolean(element, attribute);
      if (holds(bounds, attribute.name)) check_bound(element, attribute);
      if (holds(attributes, attribute.name)) continue;
      const std::string small = lower(attribute.name);
      if (small == attribute.name || !holds(attributes, small)) continue;
      warning("misspelt-attribute", element, "the attribute is not known, and left out of account",
              small, in_quotes(attribute.name));
    }
    check_range(element, "uimin", "uimax");
    check_range(element, "uisoftmin", "uisoftmax");
  }

  void check_boolean(const Element& element, const Attribute& attribute) {
    if (attribute.value == "true" || attribute.value == "false") return;
    warning("bad-attribute", element,
            fmt::format("attribute '{}' is neither true nor false", attribute.name),
            "true or false", in_quotes(attribute.value));
  }

  // A step is one number for all components.
  void check_bound(const Element& element, const Attribute& attribute) {
    const auto type = parse_type(element.attribute("type"));
    if (!type || !is_numeric(*type) || parse_value(*type, attribute.value)) return;
    if (attribute.name == "uistep" && parse_value(Type::float_, attribute.value)) return;
    warning(
        "bad-attribute", element,
        fmt::format("attribute '{}' does not fit the type {}", attribute.name, type_name(*type)),
        expected_text(*type), in_quotes(attribute.value));
  }

  void check_range(const Element& element, std::string_view low, std::string_view high) {
    if (!element.has_attribute(low) || !element.has_attribute(high)) return;
    const auto type = parse_type(element.attribute("type"));
    if (!type || !is_numeric(*type)) return;
    const auto least = parse_value(*type, element.attribute(low));
    const auto most = parse_value(*type, element.attribute(high));
    if (!least || !most) return;
    bool is_empty = false;
    for (std::size_t i = 0; i < least->floats.size(); ++i) {
      is_empty = is_empty || least->floats[i] > most->floats[i];
    }
    for (std::size_t i = 0; i < least->ints.size(); ++i) {
      is_empty = is_empty || least->ints[i] > most->ints[i];
    }
    if (!is_empty) return;
    warning("empty-range", element, fmt::format("{} is greater than {}", low, high),
            fmt::format("at most {}", element.attribute(high)),
            std::string(element.attribute(low)));
  }

  static std::string quoted_name(std::string_view name) { return std::string(name.substr(0, 100)); }

  const Document& document_;
  const Definitions& definitions_;
};

}  // namespace

void check_structure(const Document& document, const Definitions& definitions, bool lenient,
                     Diagnostics& diagnostics) {
  StructureCheck(document, definitions, lenient, diagnostics).run();
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 200;
  if (text.size() <= longest) return fmt::format("'{}'", text);
  return fmt::format("'{}...'", text.substr(0, longest));
}

}  // namespace nacre
