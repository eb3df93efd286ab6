#include "jit/document/select.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "runtime/near_names.h"

namespace nacre {

namespace {

constexpr std::array structural = std::to_array<std::string_view>({"attributedef",
                                                                   "backdrop",
                                                                   "collection",
                                                                   "geominfo",
                                                                   "geomprop",
                                                                   "geompropdef",
                                                                   "implementation",
                                                                   "input",
                                                                   "look",
                                                                   "lookgroup",
                                                                   "materialassign",
                                                                   "materialx",
                                                                   "nodedef",
                                                                   "nodegraph",
                                                                   "output",
                                                                   "property",
                                                                   "propertyassign",
                                                                   "propertyset",
                                                                   "propertysetassign",
                                                                   "targetdef",
                                                                   "token",
                                                                   "typedef",
                                                                   "unit",
                                                                   "unitdef",
                                                                   "unittypedef",
                                                                   "variant",
                                                                   "variantassign",
                                                                   "variantset",
                                                                   "visibility",
                                                                   "xi:include",
                                                                   "member",
                                                                   "defaultgeomprop",
                                                                   "material",
                                                                   "shaderref",
                                                                   "bindinput",
                                                                   "bindtoken",
                                                                   "bindparam",
                                                                   "parameter",
                                                                   "comment"});

bool version_agrees(const NodeDef& def, std::string_view version) {
  return def.version == version || (version.empty() && def.is_default_version);
}

// The first input of the instance that the nodedef does not take, or null.
const Element* first_misfit(const Element& instance, const NodeDef& def) {
  for (const Element& child : instance.children()) {
    if (child.category() != "input" || child.name().empty()) continue;
    const std::string_view type = def.input_type(child.name());
    // Every node may be disabled, whether its nodedef says so or not.
    const bool disables = child.name() == "disable" && child.attribute("type") == "boolean";
    if (type.empty() && disables) continue;
    if (type.empty() || type != child.attribute("type")) return &child;
  }
  return nullptr;
}

// The inputs of the instance that the nodedef does not take, if none is beyond leniency.
std::optional<std::vector<const Element*>> misfits(const Element& instance, const NodeDef& def,
                                                   bool (*stands_for)(Type, Type)) {
  std::vector<const Element*> list;
  for (const Element& child : instance.children()) {
    if (child.category() != "input" || child.name().empty()) continue;
    const std::string_view type = def.input_type(child.name());
    const std::string_view own = child.attribute("type");
    if (type == own || (child.name() == "disable" && own == "boolean")) continue;
    const auto from = parse_type(own);
    const auto to = parse_type(type);
    if (!type.empty() && (!from || !to || !stands_for(*from, *to))) return std::nullopt;
    list.push_back(&child);
  }
  return list;
}

std::string list_of(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " or " : ", ";
    text += items[i];
  }
  return text;
}

void add_once(std::vector<std::string>& items, std::string item) {
  if (std::find(items.begin(), items.end(), item) == items.end()) items.push_back(std::move(item));
}

struct Successor {
  std::string_view category;
  std::string_view now;
};
constexpr std::array removed = std::to_array<Successor>(
    {{"include", "<xi:include>"},
     {"swizzle", "<extract>, <convert> or <combine3>, since version 1.39"},
     {"thin_film_bsdf", "thinfilm_thickness and thinfilm_ior of a BSDF, since version 1.39"}});

// What somebody who wrote this category will have meant.
std::string meant_by(std::string_view category, const Definitions& definitions) {
  std::string small(category);
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (small == "xi:include") return "<xi:include>";
  if (small != category && !definitions.of_category(small).empty())
    return fmt::format("<{}>", small);
  for (const Successor& one : removed) {
    if (one.category == small) return std::string(one.now);
  }
  return "a node that a library or the document defines";
}

void report_misfit(const Element& input, const std::vector<const NodeDef*>& candidates,
                   Diagnostics& diagnostics, bool is_tolerated = false) {
  std::vector<std::string> names;
  std::vector<std::string> types;
  for (const NodeDef* def : candidates) {
    for (const NodeDefInput& port : def->inputs) add_once(names, std::string(port.name));
    if (const NodeDefInput* port = def->input(input.name())) {
      add_once(types, std::string(port->type_text));
    }
  }
  if (types.empty()) {
    std::string found = fmt::format("'{}'", input.name());
    std::string hint = near_hint(diagnostics, input.name(), names);
    if (is_tolerated) {
      diagnostics.warning("unknown-input", location(input),
                          "the node has no input of this name, so it is not used", list_of(names),
                          std::move(found), std::move(hint));
    } else {
      diagnostics.error("unknown-input", location(input), "the node has no input of this name",
                        list_of(names), std::move(found), std::move(hint));
    }
    return;
  }
  std::string found(input.attribute("type"));
  if (is_tolerated) {
    diagnostics.warning("input-type", location(input),
                        "the input has another type, so it is converted", list_of(types),
                        std::move(found));
  } else {
    diagnostics.error("input-type", location(input), "the input has another type", list_of(types),
                      std::move(found));
  }
}

// Nothing fitted: says what came nearest to fitting.
void report_no_match(const Element& instance, const std::vector<const NodeDef*>& candidates,
                     Diagnostics& diagnostics) {
  std::vector<std::string> versions;
  std::vector<std::string> types;
  std::vector<const NodeDef*> of_type;
  for (const NodeDef* def : candidates) {
    if (!version_agrees(*def, instance.attribute("version"))) {
      add_once(versions, std::string(def->version));
      continue;
    }
    add_once(types, std::string(def->instance_type()));
    if (def->instance_type() == instance.attribute("type")) of_type.push_back(def);
  }
  if (types.empty()) {
    diagnostics.error("unknown-version", location(instance),
                      fmt::format("there is no such version of '{}'", instance.category()),
                      list_of(versions), fmt::format("'{}'", instance.attribute("version")));
  } else if (!instance.has_attribute("type") || instance.attribute("type").empty()) {
    diagnostics.error("missing-type", location(instance), "the node has no type", list_of(types));
  } else if (of_type.empty()) {
    diagnostics.error("no-matching-nodedef", location(instance),
                      fmt::format("no '{}' has this output type", instance.category()),
                      list_of(types), fmt::format("'{}'", instance.attribute("type")));
  } else {
    // The candidate that takes most inputs is what the author will have meant.
    std::size_t best = 0;
    const Element* misfit = nullptr;
    for (const NodeDef* def : of_type) {
      const Element* input = first_misfit(instance, *def);
      std::size_t place = 0;
      for (const Element& child : instance.children()) {
        if (&child == input) break;
        ++place;
      }
      if (misfit == nullptr || place > best) {
        best = place;
        misfit = input;
      }
    }
    report_misfit(*misfit, of_type, diagnostics);
  }
}

const NodeDef* find_nearest(const Element& instance, const std::vector<const NodeDef*>& candidates,
                            bool (*stands_for)(Type, Type), Diagnostics& diagnostics) {
  const NodeDef* nearest = nullptr;
  std::vector<const Element*> least;
  for (const NodeDef* def : candidates) {
    auto inputs = misfits(instance, *def, stands_for);
    if (!inputs || (nearest != nullptr && inputs->size() >= least.size())) continue;
    nearest = def;
    least = std::move(*inputs);
  }
  for (const Element* input : least) report_misfit(*input, {nearest}, diagnostics, true);
  return nearest;
}

const NodeDef* find_explicit(const Element& instance, const Definitions& definitions,
                             Diagnostics& diagnostics, bool (*stands_for)(Type, Type)) {
  const std::string_view name = instance.attribute("nodedef");
  const NodeDef* def = definitions.nodedef(qualified_name(instance, name));
  if (def == nullptr) def = definitions.nodedef(name);
  if (def == nullptr) {
    diagnostics.error("unknown-nodedef", location(instance), "there is no nodedef of this name",
                      "the name of a nodedef", fmt::format("'{}'", name),
                      near_hint(diagnostics, name, definitions.all(),
                                [](const NodeDef* each) { return each->name; }));
    return nullptr;
  }
  if (def->instance_type() != instance.attribute("type")) {
    diagnostics.error("no-matching-nodedef", location(instance),
                      fmt::format("the nodedef '{}' has another output type", name),
                      std::string(def->instance_type()),
                      fmt::format("'{}'", instance.attribute("type")));
    return nullptr;
  }
  if (const Element* misfit = first_misfit(instance, *def)) {
    if (stands_for != nullptr &&
        find_nearest(instance, {def}, stands_for, diagnostics) != nullptr) {
      return def;
    }
    report_misfit(*misfit, {def}, diagnostics);
    return nullptr;
  }
  return def;
}

}  // namespace

const NodeDef* find_nodedef(const Element& instance, const Definitions& definitions,
                            Diagnostics& diagnostics, bool (*stands_for)(Type from, Type to)) {
  if (instance.has_attribute("nodedef")) {
    return find_explicit(instance, definitions, diagnostics, stands_for);
  }
  const std::string qualified = qualified_name(instance, instance.category());
  std::vector<const NodeDef*> candidates = definitions.of_category(qualified);
  if (qualified != instance.category()) {
    const auto plain = definitions.of_category(instance.category());
    candidates.insert(candidates.end(), plain.begin(), plain.end());
  }
  std::erase_if(candidates, [](const NodeDef* def) { return !is_for_us(def->target); });
  if (candidates.empty()) {
    diagnostics.error(
        "unknown-node", location(instance), "there is no node of this category",
        meant_by(instance.category(), definitions),
        fmt::format("<{}>", instance.category().substr(0, 100)),
        near_hint(diagnostics, instance.category(), definitions.all(),
                  [](const NodeDef* each) { return std::string_view(each->category); }));
    return nullptr;
  }
  const std::string_view version = instance.attribute("version");
  const std::string_view type = instance.attribute("type");
  std::vector<const NodeDef*> near;
  for (const NodeDef* def : candidates) {
    if (!version_agrees(*def, version) || def->instance_type() != type) continue;
    if (first_misfit(instance, *def) == nullptr) return def;
    near.push_back(def);
  }
  if (stands_for != nullptr) {
    const NodeDef* def = find_nearest(instance, near, stands_for, diagnostics);
    if (def != nullptr) return def;
  }
  report_no_match(instance, candidates, diagnostics);
  return nullptr;
}

bool is_node_category(std::string_view category) {
  return std::find(structural.begin(), structural.end(), category) == structural.end();
}

bool is_material_category(std::string_view category) {
  return category == "surfacematerial" || category == "volumematerial" ||
         category == "lightmaterial";
}

bool is_node(const Element& element) {
  if (!is_node_category(element.category())) return false;
  return element.parent() != nullptr &&
         (element.parent()->category() == "nodegraph" || element.parent()->parent() == nullptr);
}

}  // namespace nacre
