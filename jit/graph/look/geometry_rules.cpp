#include <fmt/format.h>

#include <algorithm>

#include "jit/document/nodedef.h"
#include "jit/document/value_text.h"
#include "jit/graph/look/geometry_names.h"
#include "jit/graph/look/look.h"

namespace nacre {

namespace {

// Collections within collections: deeper is a circle, which is reported elsewhere.
constexpr int max_collection_depth = 64;

/// The last of those that reach furthest down to the geometry.
template <typename Said, typename Accepts>
const Said* nearest(const GeometryRules& rules, const std::vector<Said>& list,
                    std::string_view geometry, Accepts&& accepts) {
  const Said* best = nullptr;
  std::size_t best_reach = 0;
  for (const Said& said : list) {
    if (!accepts(said)) continue;
    const auto reach = rules.reach(said, geometry);
    if (!reach || (best != nullptr && *reach < best_reach)) continue;
    best = &said;
    best_reach = *reach;
  }
  return best;
}

bool is_empty(const GeometryTarget& target) {
  return target.geom.empty() && target.collection.empty();
}

}  // namespace

GeometryRules::GeometryRules(const Document& document, Diagnostics& diagnostics)
    : document_(document) {
  for (const Element& element : document.root().children()) {
    if (element.category() == "collection") {
      Collection& collection = collections_[std::string(element.name())];
      collection.include = geom_list(element, "includegeom");
      collection.exclude = geom_list(element, "excludegeom");
      for (std::string_view name : split_list(element.attribute("includecollection"))) {
        collection.collections.emplace_back(name);
      }
    } else if (element.category() == "geominfo") {
      infos_.push_back(
          {{geom_list(element, "geom"), std::string(element.attribute("collection"))}, &element});
    }
  }
  check_circles(diagnostics);
}

void GeometryRules::check_circles(Diagnostics& diagnostics) const {
  for (const Element& element : document_.root().children()) {
    if (element.category() != "collection") continue;
    const std::string name(element.name());
    std::vector<std::string> open{name};
    for (std::size_t i = 0; i < open.size(); ++i) {
      const auto found = collections_.find(open[i]);
      if (found == collections_.end()) continue;
      const std::vector<std::string>& inner = found->second.collections;
      if (std::find(inner.begin(), inner.end(), name) != inner.end()) {
        diagnostics.error("include-cycle", location(element),
                          "the collection includes itself, directly or not");
        break;
      }
      for (const std::string& next : inner) {
        if (std::find(open.begin(), open.end(), next) == open.end()) open.push_back(next);
      }
    }
  }
}

std::optional<std::size_t> GeometryRules::reach_of_list(std::string_view list,
                                                        std::string_view geometry) const {
  const std::vector<std::string_view> expressions = split_geom_list(list);
  for (std::string_view path = geometry; !path.empty(); path = parent_geom(path)) {
    for (std::string_view expression : expressions) {
      if (geom_matches(expression, path, path.size() == geometry.size())) return path.size();
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> GeometryRules::reach_of_collection(const std::string& name,
                                                              std::string_view geometry,
                                                              int depth) const {
  const auto found = collections_.find(name);
  if (found == collections_.end() || depth > max_collection_depth) return std::nullopt;
  const Collection& collection = found->second;
  if (reach_of_list(collection.exclude, geometry)) return std::nullopt;
  std::optional<std::size_t> reach = reach_of_list(collection.include, geometry);
  for (const std::string& inner : collection.collections) {
    reach = std::max(reach, reach_of_collection(inner, geometry, depth + 1));
  }
  return reach;
}

std::optional<std::size_t> GeometryRules::reach(const GeometryTarget& target,
                                                std::string_view geometry) const {
  return std::max(reach_of_list(target.geom, geometry),
                  reach_of_collection(target.collection, geometry, 0));
}

const Assignment* GeometryRules::material_of(const Look& look, std::string_view geometry) const {
  return nearest(*this, look.assignments, geometry, [](const Assignment&) { return true; });
}

std::vector<const Assignment*> GeometryRules::materials_of(const Look& look,
                                                           std::string_view geometry) const {
  std::vector<std::pair<std::size_t, const Assignment*>> found;
  for (const Assignment& assignment : look.assignments) {
    if (const auto reached = reach(assignment, geometry)) found.emplace_back(*reached, &assignment);
  }
  // The nearest first; of the equally near, which lie in one list, the last one first.
  std::sort(found.rbegin(), found.rend());
  std::vector<const Assignment*> materials;
  for (const auto& [reached, assignment] : found) {
    materials.push_back(assignment);
    if (assignment->exclusive) break;
  }
  return materials;
}

bool GeometryRules::is_visible(const Look& look, std::string_view geometry,
                               std::string_view vistype, std::string_view viewer) const {
  // Hidden from everything is stronger than any one kind.
  for (const std::string_view kind : {std::string_view{}, vistype}) {
    const auto* found =
        nearest(*this, look.visibilities, geometry, [&](const VisibilityAssignment& said) {
          if (said.vistype != kind) return false;
          return is_empty(said.viewer) || (!viewer.empty() && reach(said.viewer, viewer));
        });
    if (found != nullptr && !found->visible) return false;
  }
  return true;
}

const PropertyAssignment* GeometryRules::property_of(const Look& look, std::string_view geometry,
                                                     std::string_view property,
                                                     std::string_view target) const {
  return nearest(*this, look.properties, geometry, [&](const PropertyAssignment& said) {
    return said.property == property && (said.target.empty() || said.target == target);
  });
}

std::map<std::string, std::string, std::less<>> GeometryRules::tokens_of(
    std::string_view geometry) const {
  std::map<std::string, std::string, std::less<>> tokens;
  for (const auto& [target, info] : infos_) {
    if (!reach(target, geometry)) continue;
    for (const Element& token : info->children()) {
      if (token.category() != "token") continue;
      tokens.insert_or_assign(std::string(token.name()), std::string(token.attribute("value")));
    }
  }
  for (const Element& element : document_.root().children()) {
    if (element.category() != "tokendefault") continue;
    tokens.emplace(element.name(), element.attribute("value"));
  }
  return tokens;
}

std::vector<GeometryValue> GeometryRules::geomprops_of(std::string_view geometry) const {
  std::vector<GeometryValue> values;
  for (const auto& [target, info] : infos_) {
    if (!reach(target, geometry)) continue;
    for (const Element& geomprop : info->children()) {
      if (geomprop.category() != "geomprop") continue;
      const auto type = parse_type(geomprop.attribute("type"));
      GeometryValue& value = values.emplace_back();
      value.name = geomprop.name();
      if (type) value.value = parse_value(*type, geomprop.attribute("value")).value_or(Value{});
    }
  }
  return values;
}

}  // namespace nacre
