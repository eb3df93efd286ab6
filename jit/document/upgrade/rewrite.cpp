#include "jit/document/upgrade/rewrite.h"

#include <algorithm>
#include <array>

namespace nacre::upgrading {

namespace {

constexpr auto connections =
    std::to_array<std::string_view>({"nodename", "nodegraph", "output", "interfacename"});
constexpr auto meanings =
    std::to_array<std::string_view>({"colorspace", "unit", "unittype", "channels"});

}  // namespace

void Upgrade::find_nodedefs() {
  nodedefs.clear();
  nodedefs_of.clear();
  for (Element* child : children_of(root)) {
    if (child->category() != "nodedef") continue;
    nodedefs.emplace(child->name(), child);
    nodedefs_of[child->attribute("node")].push_back(child);
  }
}

bool Upgrade::spend(std::size_t steps, const Element& where) const {
  constexpr std::size_t most = 10'000'000;
  if (spent_ > most) return false;
  spent_ += steps;
  if (spent_ <= most) return true;
  cannot_upgrade(*this, where, "the upgrade takes too many steps");
  return false;
}

std::vector<Element*> elements_of(Element& root) {
  std::vector<Element*> all{&root};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (Element* child : children_of(*all[i])) all.push_back(child);
  }
  return all;
}

std::vector<Element*> graphs_of(Element& root) {
  std::vector<Element*> graphs{&root};
  for (std::size_t i = 0; i < graphs.size(); ++i) {
    for (Element* child : children_of(*graphs[i])) {
      if (child->category() == "nodegraph") graphs.push_back(child);
    }
  }
  return graphs;
}

std::vector<Element*> children_of(Element& parent) {
  std::vector<Element*> children;
  children.reserve(parent.child_count());
  for (Element* child = Document::first_child(parent); child != nullptr;
       child = Document::next_sibling(*child)) {
    children.push_back(child);
  }
  return children;
}

std::unordered_set<std::string_view> names_of(Element& parent) {
  std::unordered_set<std::string_view> names;
  for (const Element* child : children_of(parent)) names.insert(child->name());
  return names;
}

Element* child_of(Element& parent, std::string_view category, std::string_view name) {
  for (Element* child = Document::first_child(parent); child != nullptr;
       child = Document::next_sibling(*child)) {
    if (child->category() == category && child->name() == name) return child;
  }
  return nullptr;
}

Element* child_named(Element& parent, std::string_view name) {
  for (Element* child = Document::first_child(parent); child != nullptr;
       child = Document::next_sibling(*child)) {
    if (child->name() == name) return child;
  }
  return nullptr;
}

Element* input_of(Element& node, std::string_view name) { return child_of(node, "input", name); }

std::vector<Element*> ports_of(Element& graph) {
  std::vector<Element*> ports;
  for (Element* child : children_of(graph)) {
    if (child->category() == "output") ports.push_back(child);
    if (child->category() == "input") continue;  // Looks outwards.
    for (Element* port : children_of(*child)) {
      if (port->category() == "input") ports.push_back(port);
    }
  }
  return ports;
}

void remove_children(Document& document, Element& parent,
                     const std::function<bool(const Element&)>& is_gone) {
  Element* child = document.take_children(parent);
  while (child != nullptr) {
    Element* next = Document::next_sibling(*child);
    if (is_gone(*child)) {
      document.move_notes(*child, next, parent);
    } else {
      document.append(parent, *child);
    }
    child = next;
  }
}

void remove_child(Document& document, Element& parent, const Element& child) {
  remove_children(document, parent, [&](const Element& one) { return &one == &child; });
}

void move_attribute(Document& document, Element& element, std::string_view from,
                    std::string_view to) {
  if (!element.has_attribute(from)) return;
  const std::string_view value = element.attribute(from);
  document.remove_attribute(element, from);
  document.set_attribute(element, to, value);
}

void rename(Document& document, Element& element, std::string_view name) {
  const std::string_view kept = document.intern(name);
  Document::set_name(element, kept);
  document.set_attribute(element, "name", kept);
}

void set_kept(Document& document, Element& element, std::string_view attribute,
              std::string_view value) {
  document.set_attribute(element, attribute, document.intern(value));
}

Element& add_input(Document& document, Element& node, std::string_view name, std::string_view type,
                   const Element& place) {
  Element& input = document.create_at("input", place);
  rename(document, input, name);
  set_kept(document, input, "type", type);
  document.append(node, input);
  return input;
}

void copy_binding(Document& document, const Element& from, Element& to) {
  document.remove_attribute(to, "value");
  for (std::string_view name : connections) document.remove_attribute(to, name);
  for (const Attribute& attribute : from.attributes()) {
    const auto is = [&](std::string_view name) { return name == attribute.name; };
    if (attribute.name == "value" || std::any_of(connections.begin(), connections.end(), is) ||
        std::any_of(meanings.begin(), meanings.end(), is)) {
      document.set_attribute(to, attribute.name, attribute.value);
    }
  }
}

bool is_connected(const Element& port) {
  return std::any_of(connections.begin(), connections.end(),
                     [&](std::string_view name) { return port.has_attribute(name); });
}

void connect(Document& document, Element& port, const Element& node) {
  document.remove_attribute(port, "value");
  for (std::string_view name : meanings) document.remove_attribute(port, name);
  for (std::string_view name : connections) document.remove_attribute(port, name);
  document.set_attribute(port, "nodename", node.name());
}

void rename_nodedef(const Upgrade& upgrade, Element& node, std::string_view standard) {
  if (node.has_attribute("nodedef") && !has_own_nodedef(upgrade, node)) {
    set_kept(upgrade.document, node, "nodedef", standard);
  }
}

bool has_own_nodedef(const Upgrade& upgrade, const Element& node) {
  return upgrade.nodedefs.contains(node.attribute("nodedef"));
}

void cannot_upgrade(const Upgrade& upgrade, const Element& element, std::string_view why,
                    std::string_view expected) {
  upgrade.diagnostics.error("cannot-upgrade", location(element), std::string(why),
                            std::string(expected));
}

}  // namespace nacre::upgrading
