#include "jit/document/names.h"

#include <fmt/format.h>

#include <unordered_map>
#include <vector>

namespace nacre {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

void check_namespace(const Element& element, Diagnostics& diagnostics) {
  const std::string_view space = element.attribute("namespace");
  if (space.empty() || is_valid_name(space)) return;
  diagnostics.error("invalid-name", location(element), "this is not a valid namespace",
                    "letters, digits and '_', not starting with a digit",
                    fmt::format("'{}'", space.substr(0, 100)));
}

void check_unique(const Document& document, const Element& scope, Diagnostics& diagnostics) {
  constexpr std::size_t small_scope = 16;
  std::unordered_map<std::string_view, const Element*> names;
  for (const Element& child : scope.children()) {
    if (child.name().empty()) continue;
    const bool is_small = scope.child_count() <= small_scope;
    const Element* first =
        is_small ? scope.child(child.name()) : names.emplace(child.name(), &child).first->second;
    if (first == &child) continue;
    diagnostics.error(
        "duplicate-name", location(child),
        fmt::format("the name '{}' is used twice in one scope", child.name().substr(0, 100)),
        "a name of its own", fmt::format("the first in line {}", document.line_of(*first)));
  }
}

}  // namespace

bool is_valid_name(std::string_view name) {
  bool at_start = true;
  for (char c : name) {
    if (c == ':' && !at_start) {
      at_start = true;
    } else if (is_letter(c) || (is_digit(c) && !at_start)) {
      at_start = false;
    } else {
      return false;
    }
  }
  return !at_start;
}

void check_names(const Document& document, const Element& root, Diagnostics& diagnostics) {
  std::vector<const Element*> pending{&root};
  check_namespace(root, diagnostics);
  while (!pending.empty()) {
    const Element& scope = *pending.back();
    pending.pop_back();
    for (const Element& child : scope.children()) {
      if (child.child_count() > 0) pending.push_back(&child);
      check_namespace(child, diagnostics);
      if (!child.has_attribute("name") || is_valid_name(child.name())) continue;
      diagnostics.error("invalid-name", location(child), "this is not a valid name",
                        "letters, digits and '_', not starting with a digit",
                        fmt::format("'{}'", child.name().substr(0, 100)));
    }
    check_unique(document, scope, diagnostics);
  }
}

}  // namespace nacre
