// What a document declares for its nodes to use.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "jit/document/inheritance.h"
#include "jit/document/value_text.h"
#include "jit/graph/check/parts.h"

namespace nacre {

namespace {

class DeclarationCheck : ElementCheck {
 public:
  DeclarationCheck(const Document& document, const Definitions& definitions,
                   Diagnostics& diagnostics)
      : ElementCheck(diagnostics), document_(document), definitions_(definitions) {}

  void run() {
    for (const Element& child : document_.root().children()) {
      const std::string_view category = child.category();
      if (category == "unitdef") check_unitdef(child);
      if (category == "geompropdef") check_geompropdef(child);
      if (category == "attributedef") check_attributedef(child);
      if (category == "targetdef") check_targetdef(child);
    }
  }

 private:
  void check_unitdef(const Element& element) {
    const std::string_view kind = element.attribute("unittype");
    if (kind.empty()) {
      error("missing-unittype", element, "the units have no type", "unittype=\"NAME\"");
    } else {
      const Element* found = definitions_.resolve(kind, element);
      if (found == nullptr || found->category() != "unittypedef") {
        error("unknown-unittype", element, "there is no unit type of this name",
              "the name of a <unittypedef>", in_quotes(kind));
      }
    }
    for (const Element& unit : element.children()) {
      if (unit.category() == "unit") check_unit(unit);
    }
  }

  void check_unit(const Element& unit) {
    const std::string_view text = unit.attribute("scale");
    const auto scale = parse_value(Type::float_, text);
    if (!scale || !(scale->floats[0] > 0)) {
      error("bad-scale", unit, "the scale of a unit is a number above 0", "scale=\"NUMBER\"",
            in_quotes(text));
    }
  }

  void check_geompropdef(const Element& element) {
    if (!check_type_name(element, definitions_, diagnostics_)) return;
    constexpr std::array<std::string_view, 3> spaces{"model", "object", "world"};
    const std::string_view space = element.attribute("space");
    if (!space.empty() && std::find(spaces.begin(), spaces.end(), space) == spaces.end()) {
      error("unknown-space", element, "there is no such space", "model, object or world",
            in_quotes(space));
    }
    const std::string_view index = element.attribute("index");
    if (!element.has_attribute("index")) return;
    const auto number = parse_value(Type::integer, index);
    if (!number || number->ints[0] < 0) {
      error("bad-value", element, "the index does not fit the type integer",
            "a whole number from 0", in_quotes(index));
    }
  }

  void check_attributedef(const Element& element) {
    if (element.attribute("attrname").empty()) {
      error("missing-attrname", element, "the attributedef does not name an attribute",
            "attrname=\"NAME\"");
    }
    check_type_name(element, definitions_, diagnostics_);
  }

  void check_targetdef(const Element& element) {
    const auto base_of = [&](const Element& heir) -> const Element* {
      const Element* base = document_.root().child(heir.attribute("inherit"));
      // Of a library, perhaps.
      return base == nullptr || base->category() != "targetdef" ? nullptr : base;
    };
    inheritance_chain(element, "target", base_of, diagnostics_);
  }

  const Document& document_;
  const Definitions& definitions_;
};

}  // namespace

void check_declarations(const Document& document, const Definitions& definitions, bool lenient,
                        Diagnostics& diagnostics) {
  check_typedefs(document, definitions, diagnostics);
  check_nodedefs(document, definitions, lenient, diagnostics);
  check_implementations(document, definitions, lenient, diagnostics);
  DeclarationCheck(document, definitions, diagnostics).run();
}

}  // namespace nacre
