#include "jit/document/upgrade/scope.h"

#include <charconv>

#include "jit/document/upgrade/rewrite.h"

namespace nacre::upgrading {

namespace {

// "swizzle12" is "swizzle" and 12; a name without digits at its end counts as 1.
std::pair<std::string, int> split_number(std::string_view name) {
  std::size_t digits = name.size();
  while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9') --digits;
  int number = 1;
  const auto [end, error] =
      std::from_chars(name.data() + digits, name.data() + name.size(), number);
  if (error != std::errc{} || number > 100'000'000) return {std::string(name), 1};
  return {std::string(name.substr(0, digits)), number};
}

}  // namespace

Scope::Scope(Document& document, Element& graph) : document_(document), graph_(graph) {
  for (Element* child : children_of(graph)) {
    if (!child->name().empty()) names_.emplace(child->name(), child);
  }
}

std::vector<Element*> Scope::children() const {
  std::vector<Element*> children = children_of(graph_);
  std::erase_if(children, [&](const Element* child) { return removed_.contains(child); });
  return children;
}

Element* Scope::find(std::string_view name) const {
  const auto found = names_.find(name);
  return found == names_.end() ? nullptr : found->second;
}

std::string Scope::free_name(std::string_view wanted) const {
  if (!names_.contains(wanted)) return std::string(wanted);
  const auto [stem, first] = split_number(wanted);
  int& number = numbers_.try_emplace(stem, first).first->second;
  std::string name;
  do {
    name = stem + std::to_string(++number);
  } while (names_.contains(name));
  return name;
}

Element& Scope::add_node(std::string_view category, std::string_view wanted, std::string_view type,
                         const Element& user) {
  Element& node = document_.create_at(document_.intern(category), user);
  upgrading::rename(document_, node, free_name(wanted));
  set_kept(document_, node, "type", type);
  adopt(node, user);
  return node;
}

Element& Scope::add_node_after(std::string_view category, std::string_view wanted,
                               std::string_view type, const Element& source) {
  Element& node = document_.create_at(document_.intern(category), source);
  upgrading::rename(document_, node, free_name(wanted));
  set_kept(document_, node, "type", type);
  names_.emplace(node.name(), &node);
  behind_[&source].push_back(&node);
  return node;
}

void Scope::adopt(Element& element, const Element& user) {
  names_.emplace(element.name(), &element);
  const auto anchor = anchors_.find(&user);
  const Element* before = anchor == anchors_.end() ? &user : anchor->second;
  anchors_.emplace(&element, before);
  added_[before].push_back(&element);
}

void Scope::remove(Element& child) {
  if (removed_.insert(&child).second) names_.erase(child.name());
}

void Scope::rename(Element& child, std::string_view name) {
  names_.erase(child.name());
  upgrading::rename(document_, child, name);
  names_.emplace(child.name(), &child);
}

void Scope::finish() {
  const auto append_those = [&](const auto& table, const Element* child) {
    const auto found = table.find(child);
    if (found == table.end()) return;
    for (Element* node : found->second) document_.append(graph_, *node);
  };
  Element* child = document_.take_children(graph_);
  while (child != nullptr) {
    Element* next = Document::next_sibling(*child);
    const auto added = added_.find(child);
    if (added != added_.end()) document_.move_notes(*child, added->second.front(), graph_);
    append_those(added_, child);
    if (removed_.contains(child)) {
      document_.move_notes(*child, next, graph_);
    } else {
      document_.append(graph_, *child);
    }
    append_those(behind_, child);
    child = next;
  }
}

}  // namespace nacre::upgrading
