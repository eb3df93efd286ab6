#include "jit/graph/inheritance.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace nacre {

std::optional<Diagnostic> inheritance_fault(const Element& node) {
  const auto fault = [](std::string code, const Element& at, std::string message,
                        std::string expected = {}, std::string found = {}) {
    Diagnostic said;
    said.code = std::move(code);
    said.where = location(at);
    said.message = std::move(message);
    said.expected = std::move(expected);
    said.found = std::move(found);
    return said;
  };
  std::vector<const Element*> chain{&node};
  while (chain.back()->has_attribute("inherit")) {
    const Element& heir = *chain.back();
    const std::string_view name = heir.attribute("inherit");
    const Element* base = node.parent()->child(name);
    if (base == nullptr || base->category() != node.category()) {
      return fault("unknown-nodename", heir, "there is no such node to inherit from",
                   fmt::format("the name of a <{}>", node.category()), fmt::format("'{}'", name));
    }
    if (std::find(chain.begin(), chain.end(), base) != chain.end()) {
      return fault("inherit-cycle", node, "the node inherits from itself, directly or not");
    }
    if (chain.size() >= node.document().max_inheritance()) {
      return fault("inherit-depth", node, "the node inherits over too many levels",
                   fmt::format("at most {}", node.document().max_inheritance()));
    }
    chain.push_back(base);
  }
  return std::nullopt;
}

}  // namespace nacre
