#include "jit/document/definitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "jit/document/inheritance.h"
#include "jit/document/same_content.h"
#include "jit/document/value_text.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

constexpr std::size_t max_leaves = 4096;  ///< Of a structure.

}  // namespace

Definitions::Definitions(const Document& document, const Definitions* base,
                         Diagnostics& diagnostics)
    : document_(document), base_(base) {
  read_structs(diagnostics);
  read_nodedefs(diagnostics);
  apply_inheritance(diagnostics);
  read_implementations(diagnostics);
  read_units(diagnostics);
}

void Definitions::read_structs(Diagnostics& diagnostics) {
  for (const Element& element : document_.root().children()) {
    if (element.category() != "typedef") continue;
    if (parse_type(element.name())) {
      if (base_ != nullptr && !is_of_base(element)) {
        diagnostics.warning("standard-type", location(element),
                            "a standard type has this name, and is used instead", "another name",
                            fmt::format("'{}'", element.name()));
      }
      continue;
    }
    if (base_ != nullptr && base_->struct_type(element.name()) != nullptr) {
      warn_of_shadow(element, "type", diagnostics);
    }
    StructType type{element.name(), {}};
    if (!add_leaves(element, "", 0, type)) {
      // What is wrong with the members themselves is for check_declarations to say.
      if (type.leaves.size() <= max_leaves) continue;
      diagnostics.error("bad-typedef", location(element), "the structure contains too much",
                        fmt::format("at most {} members", max_leaves));
    } else if (!type.leaves.empty()) {
      structs_.emplace(type.name, std::move(type));
    }
  }
}

// Members that are structures may be declared later, or in the library: by name.
bool Definitions::add_leaves(const Element& definition, const std::string& path, int depth,
                             StructType& type) const {
  constexpr int max_depth = 16;
  for (const Element& member : definition.children()) {
    if (member.category() != "member") continue;
    const std::string_view type_name = member.attribute("type");
    const std::string member_path = path + '.' + std::string(member.name());
    if (const auto known = parse_type(type_name)) {
      type.leaves.push_back({member_path, *known, std::string(member.attribute("value"))});
    } else {
      const Element* inner = resolve(type_name, member);
      if (inner == nullptr || inner->category() != "typedef" || depth == max_depth) return false;
      const std::size_t first = type.leaves.size();
      if (!add_leaves(*inner, member_path, depth + 1, type)) return false;
      // What the member says of the whole is stronger than what its type says.
      const auto values = split_struct_value(member.attribute("value"));
      for (std::size_t i = 0; values && first + i < type.leaves.size() && i < values->size(); ++i) {
        type.leaves[first + i].default_text = (*values)[i];
      }
    }
    if (type.leaves.size() > max_leaves) return false;
  }
  return true;
}

void Definitions::expand_structs(NodeDef& def, Diagnostics& diagnostics) {
  const auto expand = [&](auto& ports, std::string_view value_attribute) {
    auto old = std::move(ports);
    ports.clear();
    for (auto& port : old) {
      const StructType* type = port.type == Type::none ? struct_type(port.type_text) : nullptr;
      if (type == nullptr) {
        ports.push_back(std::move(port));
        continue;
      }
      const std::string_view text = port.element->attribute(value_attribute);
      const auto values = split_struct_value(text);
      if (!text.empty() && (!values || values->size() != type->leaves.size())) {
        diagnostics.error(
            "bad-value", location(*port.element),
            fmt::format("the {} does not fit the type {}", value_attribute, type->name),
            fmt::format("{} members", type->leaves.size()), fmt::format("'{}'", text));
      }
      for (std::uint32_t i = 0; i < type->leaves.size(); ++i) {
        const StructType::Leaf& leaf = type->leaves[i];
        auto part = port;
        part.name = texts_.emplace_back(std::string(port.name) + leaf.path);
        part.type = leaf.type;
        part.type_text = type_name(leaf.type);
        part.member = {port.name, type->name, i + 1};
        const std::string_view part_text =
            values && i < values->size() ? (*values)[i] : std::string_view(leaf.default_text);
        part.default_value = zero_value(leaf.type);
        if (auto value = parse_value(leaf.type, part_text)) part.default_value = std::move(*value);
        part.has_default = true;
        ports.push_back(std::move(part));
      }
    }
  };
  const auto is_struct = [&](const auto& port) {
    return port.type == Type::none && struct_type(port.type_text) != nullptr;
  };
  if (std::any_of(def.inputs.begin(), def.inputs.end(), is_struct)) expand(def.inputs, "value");
  if (std::any_of(def.outputs.begin(), def.outputs.end(), is_struct))
    expand(def.outputs, "default");
}

const StructType* Definitions::struct_type(std::string_view name) const {
  if (base_ != nullptr) {
    if (const StructType* type = base_->struct_type(name)) return type;
  }
  const auto found = structs_.find(name);
  return found == structs_.end() ? nullptr : &found->second;
}

void Definitions::read_nodedefs(Diagnostics& diagnostics) {
  for (const Element& element : document_.root().children()) {
    if (element.category() == "nodedef" && !element.name().empty()) {
      // What the library's name stands for, bodies above all, is made for its ports.
      if (base_ != nullptr && base_->nodedef(element.name()) != nullptr) {
        warn_of_shadow(element, "nodedef", diagnostics);
        continue;
      }
      NodeDef& def = nodedefs_.emplace_back(read_nodedef(element, diagnostics));
      expand_structs(def, diagnostics);
      by_name_.emplace(def.name, &def);
    } else if (element.category() == "geompropdef") {
      // Nodedefs of the library count on the type that its properties have.
      const Element* known = base_ == nullptr ? nullptr : base_->geompropdef(element.name());
      if (known != nullptr && known->attribute("type") != element.attribute("type")) {
        warn_of_shadow(element, "geometric property", diagnostics);
      } else {
        geompropdefs_.emplace(element.name(), &element);
      }
    }
  }
}

/// Whether the library has the same element: a document may carry copies.
bool Definitions::is_of_base(const Element& element) const {
  const Element* known = base_->document_.root().child(element.name());
  return known != nullptr && same_content(*known, element);
}

void Definitions::warn_of_shadow(const Element& element, std::string_view what,
                                 Diagnostics& diagnostics) const {
  if (is_of_base(element)) return;
  diagnostics.warning(fmt::format("shadowed-{}", what.substr(what.rfind(' ') + 1)),
                      location(element),
                      fmt::format("a library has a {} of this name, which is used instead", what));
}

void Definitions::apply_inheritance(Diagnostics& diagnostics) {
  // A nodedef's own ports, before any are merged, are what its heirs see of it
  // only after the whole chain above; so merge along the chain, nearest first.
  for (NodeDef& def : nodedefs_) {
    const auto base_of = [&](const Element& heir) -> const Element* {
      const std::string_view name = heir.attribute("inherit");
      if (name.empty()) return nullptr;
      const NodeDef* base = resolve_nodedef(name, heir);
      if (base != nullptr) return base->element;
      diagnostics.error(
          "unknown-nodedef", location(heir), "the nodedef to inherit from does not exist",
          "the name of a nodedef", fmt::format("'{}'", name),
          near_hint(diagnostics, name, all(), [](const NodeDef* each) { return each->name; }));
      return nullptr;
    };
    const auto chain = inheritance_chain(*def.element, "nodedef", base_of, diagnostics);
    for (std::size_t i = 1; i < chain.size(); ++i) {
      inherit_ports(def, *nodedef(chain[i]->name()));
    }
  }
  for (const NodeDef& def : nodedefs_) by_category_[def.category].push_back(&def);
}

void Definitions::read_implementations(Diagnostics& diagnostics) {
  // Those for this target come before those for all.
  for (const bool targeted : {true, false}) {
    for (const Element& element : document_.root().children()) {
      const bool is_graph = element.category() == "nodegraph";
      if (!is_graph && element.category() != "implementation") continue;
      const std::string_view target = element.attribute("target");
      if (target.empty() != targeted) read_implementation(element, diagnostics);
    }
  }
}

void Definitions::read_implementation(const Element& element, Diagnostics& diagnostics) {
  const std::string_view def_name = element.attribute("nodedef");
  const std::string_view targets = element.attribute("target");
  const NodeDef* def = def_name.empty() ? nullptr : resolve_nodedef(def_name, element);
  if (def == nullptr) return;
  if (element.has_attribute("file") || element.has_attribute("sourcecode")) {
    if (!is_for_us(targets) && !is_for_us(targets, source_target)) return;
    note_replacement(*def, element);
    // One made for us goes before one made for GLSL, then the first.
    const auto [place, is_new] = sources_.emplace(def, &element);
    const bool is_ours = !targets.empty() && is_for_us(targets);
    if (!is_new && is_ours && !is_for_us(place->second->attribute("target"))) {
      place->second = &element;
    }
    return;
  }
  const Element* graph = &element;
  if (element.category() != "nodegraph") {
    graph = resolve(element.attribute("nodegraph"), element);
    if (graph == nullptr || graph->category() != "nodegraph") return;
    const Element* own = document_.root().child(element.attribute("nodegraph"));
    if (own != nullptr && own->category() == "nodegraph" && own != graph) {
      warn_of_shadow(*own, "nodegraph", diagnostics);
    }
  }
  implemented_.emplace(graph, def);
  if (!is_for_us(targets)) return;
  note_replacement(*def, element);
  graphs_.emplace(def, graph);
}

void Definitions::read_units(Diagnostics& diagnostics) {
  for (const Element& element : document_.root().children()) {
    if (element.category() != "unitdef") continue;
    for (const Element& unit : element.children()) {
      const std::string_view text = unit.attribute("scale");
      double scale = 0;
      std::from_chars(text.data(), text.data() + text.size(), scale);
      if (unit.category() != "unit" || !(scale > 0)) continue;
      if (base_ != nullptr && base_->unit(unit.name())) {
        diagnostics.warning("redefined-unit", location(unit),
                            "a library has a unit of this name, which this one replaces",
                            "a name of its own", fmt::format("'{}'", unit.name()));
      }
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

const Element* Definitions::text_of(const NodeDef& def) const {
  if (base_ != nullptr) {
    if (const Element* source = base_->text_of(def)) return source;
  }
  const auto found = sources_.find(&def);
  return found == sources_.end() ? nullptr : found->second;
}

void Definitions::note_replacement(const NodeDef& def, const Element& implementation) {
  if (&def.element->document() != &document_) replacements_[&def].push_back(&implementation);
}

std::span<const Element* const> Definitions::replacements(const NodeDef& def) const {
  const auto found = replacements_.find(&def);
  if (found == replacements_.end()) return {};
  return found->second;
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

std::vector<std::string_view> Definitions::unit_names() const {
  auto names = base_ == nullptr ? std::vector<std::string_view>() : base_->unit_names();
  for (const auto& [name, unit] : units_) names.push_back(name);
  return names;
}

std::vector<std::string_view> Definitions::geompropdef_names() const {
  auto names = base_ == nullptr ? std::vector<std::string_view>() : base_->geompropdef_names();
  for (const auto& [name, element] : geompropdefs_) names.push_back(name);
  return names;
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

bool is_for_us(std::string_view targets, std::string_view target) {
  if (targets.empty()) return true;
  const std::vector<std::string_view> list = split_list(targets);
  return std::find(list.begin(), list.end(), target) != list.end();
}

}  // namespace nacre
