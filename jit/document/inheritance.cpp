#include "jit/document/inheritance.h"

#include <fmt/format.h>

#include <algorithm>

namespace nacre {

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
                      fmt::format("the name of a <{}>", node.category()),
                      fmt::format("'{}'", name));
    return nullptr;
  };
  return inheritance_chain(node, "node", base_of, diagnostics);
}

}  // namespace nacre
