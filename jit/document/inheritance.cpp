#include "jit/document/inheritance.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "runtime/near_names.h"

namespace nacre {

namespace {

bool says_something(const Element& input) {
  for (const Attribute& attribute : input.attributes()) {
    if (attribute.name == "value") return true;
    const bool connects = attribute.name == "nodename" || attribute.name == "nodegraph" ||
                          attribute.name == "interfacename" || attribute.name == "output";
    if (connects && !attribute.value.empty()) return true;
  }
  return false;
}

}  // namespace

std::vector<const Element*> inheritance_chain(
    const Element& element, std::string_view what,
    const std::function<const Element*(const Element& heir)>& base_of, Diagnostics& diagnostics) {
  std::vector<const Element*> chain{&element};
  while (const Element* base = base_of(*chain.back())) {
    if (std::find(chain.begin(), chain.end(), base) != chain.end()) {
      diagnostics.error("inherit-cycle", location(element),
                        fmt::format("the {} inherits from itself, directly or not", what));
      break;
    }
    if (chain.size() >= element.document().max_inheritance()) {
      diagnostics.error("inherit-depth", location(element),
                        fmt::format("the {} inherits over too many levels", what),
                        fmt::format("at most {}", element.document().max_inheritance()));
      break;
    }
    chain.push_back(base);
  }
  return chain;
}

std::vector<const Element*> node_inheritance(const Element& node, Diagnostics& diagnostics) {
  const auto base_of = [&](const Element& heir) -> const Element* {
    if (!heir.has_attribute("inherit")) return nullptr;
    const std::string_view name = heir.attribute("inherit");
    const Element* base = node.parent()->child(name);
    if (base != nullptr && base->category() == node.category()) return base;
    diagnostics.error("unknown-nodename", location(heir), "there is no such node to inherit from",
                      fmt::format("the name of a <{}>", node.category()), fmt::format("'{}'", name),
                      near_hint(diagnostics, name, node.parent()->children(), [&](auto& each) {
                        return each.category() == node.category() ? each.name()
                                                                  : std::string_view();
                      }));
    return nullptr;
  };
  return inheritance_chain(node, "node", base_of, diagnostics);
}

const Element* find_input(const Element& node, std::string_view name) {
  // The chain is bounded in case it is a circle.
  const Element* element = &node;
  const std::size_t most = node.document().max_inheritance();
  for (std::size_t depth = 0; element != nullptr && depth < most; ++depth) {
    const Element* input = element->child(name);
    if (input != nullptr && input->category() == "input" && says_something(*input)) return input;
    const std::string_view base = element->attribute("inherit");
    element = base.empty() ? nullptr : element->parent()->child(base);
  }
  return nullptr;
}

std::vector<const Element*> find_inputs(const Element& node, Diagnostics& diagnostics) {
  std::vector<const Element*> inputs;
  std::unordered_set<std::string_view> names;
  for (const Element* element : node_inheritance(node, diagnostics)) {
    for (const Element& child : element->children()) {
      if (child.category() != "input" || !says_something(child)) continue;
      if (names.insert(child.name()).second) inputs.push_back(&child);
    }
  }
  return inputs;
}

}  // namespace nacre
