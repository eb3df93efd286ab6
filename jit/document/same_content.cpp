#include "jit/document/same_content.h"

#include <utility>
#include <vector>

namespace nacre {

namespace {

bool same_head(const Element& a, const Element& b) {
  if (a.category() != b.category() || a.name() != b.name() || a.child_count() != b.child_count() ||
      a.attributes().size() != b.attributes().size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.attributes().size(); ++i) {
    const Attribute& one = a.attributes()[i];
    const Attribute& other = b.attributes()[i];
    // In the same order as a rule; then nothing is looked for.
    const bool is_same = one.name == other.name
                             ? one.value == other.value
                             : b.has_attribute(one.name) && b.attribute(one.name) == one.value;
    if (!is_same) return false;
  }
  return true;
}

}  // namespace

bool same_content(const Element& a, const Element& b) {
  std::vector<std::pair<const Element*, const Element*>> pairs{{&a, &b}};
  while (!pairs.empty()) {
    const auto [one, other] = pairs.back();
    pairs.pop_back();
    if (!same_head(*one, *other)) return false;
    auto next = other->children().begin();
    for (const Element& child : one->children()) pairs.emplace_back(&child, &*next++);
  }
  return true;
}

}  // namespace nacre
