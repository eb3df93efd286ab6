#include "jit/shading/document_inputs.h"

#include <algorithm>

#include "jit/document/select.h"
#include "jit/document/value_text.h"
#include "jit/record/leaves.h"
#include "jit/record/pattern.h"

namespace nacre {

namespace {

/// Of nodes within the graphs of nodes: far beyond what anybody sets by a path, and less than a
/// document that doubles itself again and again can ask for.
constexpr int most_levels = 16;
constexpr std::size_t most_inputs = 200'000;

std::string below(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + '/' + std::string(name);
}

}  // namespace

bool fits_slot(const std::string& name, Type type, const std::string& pattern) {
  if (fits_pattern(name, pattern)) return true;
  const int count = component_count(type);
  for (int i = 0; i < count; ++i) {
    if (fits_pattern(slot_name(name, i, count), pattern)) return true;
  }
  return false;
}

bool DocumentInputs::any_fits(const std::string& pattern) {
  if (document_ == nullptr) return false;
  if (!definitions_) {
    definitions_.emplace(*document_, &library_, known_);
    collect(document_->root(), {});
  }
  if (is_cut_) return true;
  const std::string owner = pattern.substr(0, pattern.rfind('/'));
  return std::ranges::any_of(
             inputs_,
             [&](const auto& each) { return fits_slot(each.first, each.second, pattern); }) ||
         std::ranges::any_of(unknown_nodes_,
                             [&](const std::string& node) { return fits_pattern(node, owner); });
}

void DocumentInputs::collect(const Element& element, const std::string& path) {
  for (const Element& child : element.children()) {
    is_cut_ = is_cut_ || inputs_.size() > most_inputs;
    if (is_cut_) return;
    const std::string own = below(path, child.name());
    if (child.category() == "input") {
      const Type type = parse_type(child.attribute("type")).value_or(Type::none);
      if (is_numeric(type)) inputs_.emplace(own, type);
    } else if (is_node(child)) {
      if (const NodeDef* def = find_nodedef(child, *definitions_, known_)) {
        for (const auto& [name, type] : inputs_of(*def, 0)) inputs_.emplace(below(own, name), type);
      } else {
        unknown_nodes_.push_back(own);
      }
    }
    collect(child, own);
  }
}

const DocumentInputs::Inputs& DocumentInputs::inputs_of(const NodeDef& def, int level) {
  const auto [known, is_new] = of_defs_.try_emplace(&def);
  if (!is_new) return known->second;  // Of a definition that is within itself nothing more.
  Inputs found;
  for (const NodeDefInput& input : def.inputs) {
    if (is_numeric(input.type)) found.emplace(input.name, input.type);
  }
  if (const Element* graph = definitions_->graph_of(def)) {
    for (const Element& node : graph->children()) {
      const NodeDef* inner = is_node(node) ? find_nodedef(node, *definitions_, known_) : nullptr;
      if (inner == nullptr) continue;
      is_cut_ = is_cut_ || level == most_levels || found.size() > most_inputs;
      if (is_cut_) break;
      const Inputs of_inner = inputs_of(*inner, level + 1);  // The map may grow meanwhile.
      for (const auto& [name, type] : of_inner) {
        found.emplace(below(std::string(node.name()), name), type);
      }
    }
  }
  return of_defs_[&def] = std::move(found);
}

}  // namespace nacre
