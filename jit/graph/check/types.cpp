// Types that a document declares, and the names of types.
#include <fmt/format.h>

#include <unordered_map>
#include <vector>

#include "jit/document/circles.h"
#include "jit/document/inheritance.h"
#include "jit/document/value_text.h"
#include "jit/graph/check/parts.h"

namespace nacre {

namespace {

class TypeCheck : ElementCheck {
 public:
  TypeCheck(const Document& document, const Definitions& definitions, Diagnostics& diagnostics)
      : ElementCheck(diagnostics), document_(document), definitions_(definitions) {}

  void run() {
    find_type_circles();
    for (const Element& child : document_.root().children()) {
      if (child.category() == "typedef") check_typedef(child);
    }
  }

 private:
  void check_typedef(const Element& element) {
    const std::size_t errors = diagnostics_.error_count();
    const auto base_of = [&](const Element& heir) -> const Element* {
      const std::string_view name = heir.attribute("inherit");
      if (!heir.has_attribute("inherit") || parse_type(name)) return nullptr;
      const Element* base = definitions_.resolve(name, element);
      if (base != nullptr && base->category() == "typedef") return base;
      error("unknown-type", heir, "the type to inherit from does not exist", "the name of a type",
            in_quotes(name));
      return nullptr;
    };
    inheritance_chain(element, "type", base_of, diagnostics_);
    if (diagnostics_.error_count() != errors) return;
    for (const Element& member : element.children()) {
      if (member.category() == "member") check_member(element, member);
    }
  }

  void check_member(const Element& owner, const Element& member) {
    if (!check_type_name(member, definitions_, diagnostics_)) return;
    const Element* held = named_typedef(member.attribute("type"), owner);
    if (held != nullptr && circles_.at(held) == circles_.at(&owner)) {
      error("type-cycle", member, "the type contains itself, directly or not", "",
            in_quotes(member.attribute("type")));
      return;
    }
    const auto type = parse_type(member.attribute("type"));
    if (!type || !member.has_attribute("value")) return;
    if (parse_value(*type, member.attribute("value"))) return;
    error("bad-value", member, fmt::format("the value does not fit the type {}", type_name(*type)),
          expected_text(*type), in_quotes(member.attribute("value")));
  }

  const Element* named_typedef(std::string_view name, const Element& user) const {
    const Element* found = definitions_.resolve(name, user);
    return found != nullptr && found->category() == "typedef" ? found : nullptr;
  }

  std::vector<const Element*> held_by(const Element& type) const {
    std::vector<const Element*> types;
    for (const Element& member : type.children()) {
      const Element* found = named_typedef(member.attribute("type"), type);
      if (found != nullptr) types.push_back(found);
    }
    return types;
  }

  void find_type_circles() {
    std::vector<const Element*> types;
    for (const Element& child : document_.root().children()) {
      if (child.category() == "typedef") types.push_back(&child);
    }
    circles_ = find_circles(types, [this](const Element& one) { return held_by(one); });
  }

  const Document& document_;
  const Definitions& definitions_;
  std::unordered_map<const Element*, std::size_t> circles_;  ///< Of types that hold types.
};

}  // namespace

void check_typedefs(const Document& document, const Definitions& definitions,
                    Diagnostics& diagnostics) {
  TypeCheck(document, definitions, diagnostics).run();
}

bool is_declared_type(std::string_view name, const Element& user, const Definitions& definitions) {
  const Element* found = definitions.resolve(name, user);
  return found != nullptr && found->category() == "typedef";
}

bool check_type_name(const Element& port, const Definitions& definitions,
                     Diagnostics& diagnostics) {
  const std::string_view text = port.attribute("type");
  if (parse_type(text) || (!text.empty() && is_declared_type(text, port, definitions))) return true;
  if (text.empty()) {
    diagnostics.error("missing-type", location(port),
                      fmt::format("the {} has no type", port.category()), "type=\"TYPE\"");
  } else {
    diagnostics.error("unknown-type", location(port), "there is no type of this name",
                      "a standard type or the name of a <typedef>", in_quotes(text));
  }
  return false;
}

}  // namespace nacre
