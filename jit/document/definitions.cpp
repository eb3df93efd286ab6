#include "jit/document/definitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace nacre {

Definitions::Definitions(const Document& document, const Definitions* base,
                         Diagnostics& diagnostics)
    : document_(document), base_(base) {
  read_nodedefs(diagnostics);
  apply_inheritance(diagnostics);
  read_implementations();
  read_units();
}

void Definitions::read_nodedefs(Diagnostics& diagnostics) {
  for (const Element& element : document_.root().children()) {
    if (element.category() == "nodedef" && !element.name().empty()) {
      NodeDef& def = nodedefs_.emplace_back(read_nodedef(element, diagnostics));
      by_name_.emplace(def.name, &def);
    } else if (element.category() == "geompropdef") {
      geompropdefs_.emplace(element.name(), &element);
    }
  }
}

void Definitions::apply_inheritance(Diagnostics& diagnostics) {
  // A nodedef's own ports, before any are merged, are what its heirs see of it
  // only after the whole chain above; so merge along the chain, nearest first.
  for (NodeDef& def : nodedefs_) {
    std::vector<const Element*> seen{def.element};
    std::string_view parent = def.element->attribute("inherit");
    const Element* user = def.element;
    while (!parent.empty()) {
      const NodeDef* base = resolve_nodedef(parent, *user);
      if (base == nullptr) {
        diagnostics.error("unknown-nodedef", location(*user),
                          "the nodedef to inherit from does not exist", "the name of a nodedef",
                          fmt::format("'{}'", parent));
        break;
      }
      if (std::find(seen.begin(), seen.end(), base->element) != seen.end()) {
        diagnostics.error("inherit-cycle", location(*def.element),
                          "the nodedef inherits from itself, directly or not");
        break;
      }
      if (seen.size() >= max_inheritance) {
        diagnostics.error("inherit-depth", location(*def.element),
                          "the nodedef inherits over too many levels",
                          fmt::format("at most {}", max_inheritance));
        break;
      }
      inherit_ports(def, *base);
      seen.push_back(base->element);
      user = base->element;
      parent = base->element->attribute("inherit");
    }
  }
  for (const NodeDef& def : nodedefs_) by_category_[def.category].push_back(&def);
}

void Definitions::read_implementations() {
  for (const Element& element : document_.root().children()) {
    const bool is_graph = element.category() == "nodegraph";
    if (!is_graph && element.category() != "implementation") continue;
    const std::string_view def_name = element.attribute("nodedef");
    if (def_name.empty()) continue;
    const NodeDef* def = resolve_nodedef(def_name, element);
    const Element* graph = &element;
    if (!is_graph) {
      graph = resolve(element.attribute("nodegraph"), element);
      if (graph == nullptr || graph->category() != "nodegraph") continue;
    }
    if (def == nullptr) continue;
    implemented_.emplace(graph, def);
    if (is_for_us(element.attribute("target"))) graphs_.emplace(def, graph);
  }
}

void Definitions::read_units() {
  for (const Element& element : document_.root().children()) {
    if (element.category() != "unitdef") continue;
    for (const Element& unit : element.children()) {
      const std::string_view text = unit.attribute("scale");
      double scale = 0;
      std::from_chars(text.data(), text.data() + text.size(), scale);
      if (unit.category() != "unit" || !(scale > 0)) continue;
      units_.emplace(unit.name(), Unit{element.attribute("unittype"), scale});
    }
  }
}

const NodeDef* Definitions::nodedef(std::string_view name) const {
  if (base_ != nullptr) {
    if (const NodeDef* def = base_->nodedef(name)) return def;
  }
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second;
}

std::vector<const NodeDef*> Definitions::of_category(std::string_view category) const {
  std::vector<const NodeDef*> result;
  if (base_ != nullptr) result = base_->of_category(category);
  const auto found = by_category_.find(category);
  if (found != by_category_.end()) {
    result.insert(result.end(), found->second.begin(), found->second.end());
  }
  return result;
}

std::vector<const NodeDef*> Definitions::all() const {
  std::vector<const NodeDef*> result;
  if (base_ != nullptr) result = base_->all();
  for (const NodeDef& def : nodedefs_) result.push_back(&def);
  return result;
}

const Element* Definitions::graph_of(const NodeDef& def) const {
  if (base_ != nullptr) {
    if (const Element* graph = base_->graph_of(def)) return graph;
  }
  const auto found = graphs_.find(&def);
  return found == graphs_.end() ? nullptr : found->second;
}

const NodeDef* Definitions::implemented_by(const Element& graph) const {
  const auto found = implemented_.find(&graph);
  if (found != implemented_.end()) return found->second;
  return base_ == nullptr ? nullptr : base_->implemented_by(graph);
}

const Element* Definitions::geompropdef(std::string_view name) const {
  const auto found = geompropdefs_.find(name);
  if (found != geompropdefs_.end()) return found->second;
  return base_ == nullptr ? nullptr : base_->geompropdef(name);
}

std::optional<Definitions::Unit> Definitions::unit(std::string_view name) const {
  const auto found = units_.find(name);
  if (found != units_.end()) return found->second;
  return base_ == nullptr ? std::nullopt : base_->unit(name);
}

const Element* Definitions::resolve(std::string_view name, const Element& user) const {
  if (name.empty()) return nullptr;
  const auto lookup = [this](std::string_view wanted) -> const Element* {
    for (const Definitions* at : {base_, this}) {
      if (at == nullptr) continue;
      if (const Element* found = at->document_.root().child(wanted)) return found;
    }
    return nullptr;
  };
  const std::string qualified = qualified_name(user, name);
  if (const Element* found = lookup(qualified)) return found;
  return qualified == name ? nullptr : lookup(name);
}

const NodeDef* Definitions::resolve_nodedef(std::string_view name, const Element& user) const {
  if (const NodeDef* def = nodedef(qualified_name(user, name))) return def;
  return nodedef(name);
}

bool is_for_us(std::string_view targets) {
  if (targets.empty()) return true;
  const std::vector<std::string_view> list = split_list(targets);
  return std::find(list.begin(), list.end(), own_target) != list.end();
}

}  // namespace nacre
