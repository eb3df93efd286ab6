#include "examples/tool/scene/assignment.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "jit/document/select.h"
#include "jit/graph/find.h"
#include "jit/graph/look/geometry_names.h"
#include "runtime/near_names.h"

namespace nacre::tool {

namespace {

using host::Mesh;

std::string path_of_object(const Mesh& mesh) {
  return mesh.path.empty() ? '/' + mesh.object_name : mesh.path;
}

/// This renderer's name, for properties that are meant for one.
constexpr std::string_view own_target = "nacre";

constexpr std::string_view priority_property = "dielectric_priority";

bool lacks_surface(const Document& document, const FoundMaterial& material) {
  if (!material.surfaceshader.empty() || !material.backsurfaceshader.empty()) return false;
  return is_material_category(document.root().child(material.name)->category());
}

class Assigner {
 public:
  Assigner(const Document& document, const host::Scene& scene, const AssignmentOptions& options,
           Diagnostics& diagnostics)
      : document_(document),
        scene_(scene),
        options_(options),
        diagnostics_(diagnostics),
        rules_(document, diagnostics),
        paths_(scene) {
    for (const FoundMaterial& material : find_materials(document)) {
      known_.insert(material.name);
      if (first_.empty()) first_ = material.name;
      if (lacks_surface(document, material)) without_surface_.insert(material.name);
    }
    read_assigns();
    read_look();
    check_priorities();
    if (!options.material.empty()) check_known(options.material);
  }

  /// Says which assignments are on nothing, and what nothing is assigned to.
  void report_unmatched() const {
    for (const auto& [name, material] : assigns_) {
      if (std::none_of(scene_.meshes.begin(), scene_.meshes.end(),
                       [&](const Mesh& mesh) { return is_called(mesh, name); })) {
        diagnostics_.error("unmatched-assign", {}, "--assign names nothing of the scene",
                           "one of " + names_of_scene(), '"' + name + '"', near_mesh(name));
      }
    }
    if (look_) report_look();
    if (!options_.material.empty() || (known_.size() < 2 && !look_)) return;
    std::size_t count = 0;
    const Mesh* example = nullptr;
    for (const Mesh& mesh : scene_.meshes) {
      if (mesh.light_radiance || mesh.is_stage || !is_left_over(mesh)) continue;
      if (count++ == 0) example = &mesh;
    }
    if (count == 0 || first_.empty()) return;
    diagnostics_.warning("first-material", {document_.files().front(), 0, 0, first_},
                         "nothing says what material " +
                             (count == 1 ? "a mesh has" : std::to_string(count) + " meshes have") +
                             ": the document's first, '" + first_ + "', is taken",
                         "--material, --assign or a look", '\'' + example->object_name + '\'');
  }

  MeshAssignment assignment_of(const Mesh& mesh) const {
    MeshAssignment result;
    if (mesh.light_radiance) return result;
    result.tokens = rules_.tokens_of(path_of(mesh));
    if (look_) {
      result.variants = look_->variants;
      result.visible_to = visible_to(mesh);
      result.illuminated = is_visible(mesh, "illumination");
      result.two_sided = property_of(mesh, "twosided", true);
      result.matte = property_of(mesh, "matte", false);
      result.priority = priority_of(mesh);
    }
    const std::string named = named_material(mesh);
    const Assignment* assigned = named.empty() && look_ ? from_look(mesh) : nullptr;
    if (assigned != nullptr) {
      result.material = assigned->material;
      result.variants.insert(result.variants.end(), assigned->variants.begin(),
                             assigned->variants.end());
    } else {
      result.material = named.empty() ? other_material(mesh) : named;
    }
    return result;
  }

 private:
  std::string path_of(const Mesh& mesh) const { return paths_.of(mesh); }

  /// The path, then the names that a document may know the mesh by.
  std::vector<std::string> names_of(const Mesh& mesh) const {
    std::vector<std::string> names{path_of(mesh)};
    for (const std::string* name : {&mesh.object_name, &mesh.mesh_name, &mesh.material_name}) {
      if (!name->empty()) names.push_back('/' + *name);
    }
    return names;
  }

  static bool is_called(const Mesh& mesh, const std::string& name) {
    return mesh.object_name == name || mesh.mesh_name == name || mesh.material_name == name;
  }

  std::string near_mesh(const std::string& name) const {
    std::vector<std::string> names;
    for (const Mesh& mesh : scene_.meshes) {
      names.insert(names.end(), {mesh.object_name, mesh.mesh_name, mesh.material_name});
    }
    return near_hint(diagnostics_, name, names);
  }

  /// Objects and their materials.
  std::string names_of_scene() const {
    std::set<std::string> names;
    for (const Mesh& mesh : scene_.meshes) {
      for (const std::string* name : {&mesh.object_name, &mesh.mesh_name, &mesh.material_name}) {
        if (!name->empty() && !mesh.light_radiance) names.insert(*name);
      }
      if (names.size() > 20) break;
    }
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
  }

  void report_look() const {
    for (const Assignment& assignment : look_->assignments) {
      const auto reaches = [&](const Mesh& mesh) {
        const auto names = names_of(mesh);
        return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return rules_.reach(assignment, name).has_value();
        });
      };
      if (std::any_of(scene_.meshes.begin(), scene_.meshes.end(), reaches)) continue;
      diagnostics_.warning(
          "unmatched-assignment", {document_.files().front(), 0, 0, look_->name},
          "material '" + assignment.material + "' is assigned to nothing of the scene",
          "one of " + names_of_scene(),
          assignment.geom.empty() ? "collection " + assignment.collection : assignment.geom);
    }
  }

  /// Whether only the document's first material is left for a mesh.
  bool is_left_over(const Mesh& mesh) const {
    return named_material(mesh).empty() && (!look_ || from_look(mesh) == nullptr) &&
           !known_.contains(mesh.material_name);
  }

  std::string named_material(const Mesh& mesh) const {
    for (const std::string& name : {mesh.object_name, mesh.mesh_name, mesh.material_name}) {
      if (const auto found = assigns_.find(name); found != assigns_.end()) return found->second;
    }
    return {};
  }

  std::string other_material(const Mesh& mesh) const {
    if (options_.material.empty() && known_.contains(mesh.material_name)) return mesh.material_name;
    if (mesh.is_stage) return {};
    if (!options_.material.empty()) return options_.material;
    return first_;
  }

  /// An assignment to the mesh itself, by any of its names, is stronger than one to
  /// something above it.
  const Assignment* from_look(const Mesh& mesh) const {
    for (const std::string& name : names_of(mesh)) {
      const Assignment* found = rules_.material_of(*look_, name);
      if (found != nullptr && rules_.reach(*found, name) == name.size()) return with_surface(name);
    }
    return with_surface(path_of(mesh));
  }

  /// The strongest assignment whose material has a surface; if none has, the strongest.
  const Assignment* with_surface(const std::string& name) const {
    const std::vector<const Assignment*> all = rules_.materials_of(*look_, name);
    for (const Assignment* each : all) {
      if (!without_surface_.contains(each->material)) return each;
    }
    return all.empty() ? nullptr : all.front();
  }

  /// What the look says of a mesh under its own names counts for more than what it says
  /// of something above it.
  const PropertyAssignment* property_of(const Mesh& mesh, std::string_view property) const {
    const PropertyAssignment* said =
        rules_.property_of(*look_, path_of(mesh), property, own_target);
    for (const std::string& name : names_of(mesh)) {
      const PropertyAssignment* found = rules_.property_of(*look_, name, property, own_target);
      if (found == nullptr || rules_.reach(*found, name) != name.size()) continue;
      said = found;
      break;
    }
    return said;
  }

  bool property_of(const Mesh& mesh, std::string_view property, bool otherwise) const {
    const PropertyAssignment* said = property_of(mesh, property);
    return said != nullptr && said->value.type == Type::boolean ? said->value.ints[0] != 0
                                                                : otherwise;
  }

  int priority_of(const Mesh& mesh) const {
    const PropertyAssignment* said = property_of(mesh, priority_property);
    return said != nullptr && said->value.type == Type::integer ? said->value.ints[0] : 0;
  }

  /// Of the look, whether anything has them or not.
  void check_priorities() {
    if (!look_) return;
    for (const PropertyAssignment& said : look_->properties) {
      const bool is_other = !said.target.empty() && said.target != own_target;
      if (said.property != priority_property || is_other) continue;
      if (said.value.type == Type::integer) continue;
      diagnostics_.error(
          "bad-priority", said.where,
          "look '" + look_->name + "': a " + std::string(priority_property) + " is no integer",
          "type integer and a whole number", said.text);
    }
  }

  std::uint32_t visible_to(const Mesh& mesh) const {
    std::uint32_t kinds = 0;
    for (const auto& [kind, vistype] :
         {std::pair{host::ray_camera, "camera"}, std::pair{host::ray_shadow, "shadow"},
          std::pair{host::ray_secondary, "secondary"}}) {
      if (is_visible(mesh, vistype)) kinds |= kind;
    }
    return kinds;
  }

  bool is_visible(const Mesh& mesh, std::string_view vistype) const {
    const auto names = names_of(mesh);
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
      return rules_.is_visible(*look_, name, vistype);
    });
  }

  void check_known(const std::string& material) {
    if (known_.contains(material)) return;
    std::string names;
    for (const std::string& name : known_) names += (names.empty() ? "" : ", ") + name;
    diagnostics_.error("unknown-material", {document_.files().front(), 0, 0, {}},
                       "there is no material '" + material + "'",
                       names.empty() ? "a document with a material" : "one of " + names, {},
                       near_hint(diagnostics_, material, known_));
  }

  void read_assigns() {
    for (const std::string& text : options_.assigns) {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos) {
        diagnostics_.error("bad-assign", {}, "--assign names no material", "NAME=MATERIAL",
                           '"' + text + '"');
        continue;
      }
      check_known(text.substr(equals + 1));
      assigns_[text.substr(0, equals)] = text.substr(equals + 1);
    }
  }

  /// The look that --look means, or the document's default.
  std::string wanted_look() const {
    const std::vector<LookGroup> groups = find_look_groups(document_);
    for (const LookGroup& group : groups) {
      const bool is_meant =
          options_.look.empty() ? !group.default_look.empty() : group.name == options_.look;
      if (!is_meant) continue;
      if (!group.default_look.empty()) return group.default_look;
      if (!group.looks.empty()) return group.looks.front();
    }
    return options_.look;
  }

  void read_look() {
    const std::vector<Look> looks = find_looks(document_, diagnostics_);
    const std::string wanted = wanted_look();
    if (options_.look.empty() && (!options_.material.empty() || looks.empty())) return;
    for (const Look& look : looks) {
      if (!wanted.empty() && look.name != wanted) continue;
      look_ = look;
      return;
    }
    diagnostics_.error("unknown-look", {document_.files().front(), 0, 0, {}},
                       "there is no look '" + wanted + "'", {}, {},
                       near_hint(diagnostics_, wanted, looks,
                                 [](auto& each) { return std::string_view(each.name); }));
  }

  const Document& document_;
  const host::Scene& scene_;
  const AssignmentOptions& options_;
  Diagnostics& diagnostics_;
  GeometryRules rules_;
  MeshPaths paths_;
  std::set<std::string> known_;
  std::set<std::string, std::less<>> without_surface_;  ///< Such as a <volumematerial>.
  std::string first_;
  std::map<std::string, std::string> assigns_;
  std::optional<Look> look_;
};

}  // namespace

void AssignmentOptions::add(CLI::App& command) {
  command.add_option("--material", material, "Material for every mesh that nothing else names")
      ->type_name("NAME");
  command.add_option("--look", look, "Look that assigns materials (default: the first, if any)")
      ->type_name("NAME");
  command.add_option("--assign", assigns, "Material for an object, mesh or material of the scene")
      ->type_name("NAME=MATERIAL");
}

MeshPaths::MeshPaths(const host::Scene& scene) {
  for (const Mesh& mesh : scene.meshes) ++pieces_[path_of_object(mesh)];
}

std::string MeshPaths::of(const Mesh& mesh) const {
  const std::string path = path_of_object(mesh);
  const bool is_piece = pieces_.at(path) > 1 && !mesh.material_name.empty();
  return is_piece ? path + '/' + mesh.material_name : path;
}

std::string MeshAssignment::key() const {
  std::string text = material;
  for (const VariantChoice& choice : variants) {
    text += '\n' + choice.variantset + '=' + choice.variant;
  }
  for (const auto& [name, value] : tokens) text += '\n' + name + '<' + value;
  return text;
}

std::vector<MeshAssignment> assign_materials(const Document& document, const host::Scene& scene,
                                             const AssignmentOptions& options,
                                             Diagnostics& diagnostics) {
  const Assigner assigner(document, scene, options, diagnostics);
  std::vector<MeshAssignment> assignments;
  for (const Mesh& mesh : scene.meshes) assignments.push_back(assigner.assignment_of(mesh));
  assigner.report_unmatched();
  return assignments;
}

}  // namespace nacre::tool
