#include "examples/tool/assignment.h"

#include <algorithm>
#include <map>
#include <set>

#include "jit/document/nodedef.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

using host::Mesh;

/// A geometry name of a look against a mesh: "*" and "/" are everything, else the
/// last part of the path is the object's, the mesh's or its material's name.
bool geom_matches(std::string_view geom, const Mesh& mesh) {
  if (geom == "*" || geom == "/") return true;
  const std::size_t slash = geom.rfind('/');
  const std::string_view name = slash == std::string_view::npos ? geom : geom.substr(slash + 1);
  return name == "*" || name == mesh.object_name || name == mesh.mesh_name ||
         name == mesh.material_name;
}

class Assigner {
 public:
  Assigner(const Document& document, const AssignmentOptions& options, Diagnostics& diagnostics)
      : document_(document), options_(options), diagnostics_(diagnostics) {
    for (const FoundMaterial& material : find_materials(document)) {
      known_.insert(material.name);
      if (first_.empty()) first_ = material.name;
    }
    read_assigns();
    read_look();
    if (!options.material.empty()) check_known(options.material);
  }

  std::string material_of(const Mesh& mesh) const {
    for (const std::string& name : {mesh.object_name, mesh.mesh_name, mesh.material_name}) {
      if (const auto found = assigns_.find(name); found != assigns_.end()) return found->second;
    }
    for (auto each = look_.rbegin(); each != look_.rend(); ++each) {
      for (const std::string_view geom : split_list(each->geom)) {
        if (geom_matches(geom, mesh)) return each->material;
      }
    }
    if (options_.material.empty() && known_.contains(mesh.material_name)) return mesh.material_name;
    // The stage of the built-in scenes stays neutral.
    if (mesh.material_name == "ground" || mesh.material_name == "base") return {};
    if (!options_.material.empty()) return options_.material;
    return first_;
  }

 private:
  void check_known(const std::string& material) {
    if (known_.contains(material)) return;
    std::string names;
    for (const std::string& name : known_) names += (names.empty() ? "" : ", ") + name;
    diagnostics_.error("unknown-material", {document_.files().front(), 0, 0, {}},
                       "there is no material '" + material + "'",
                       names.empty() ? "a document with a material" : "one of " + names);
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

  void read_look() {
    const std::vector<Look> looks = find_looks(document_, diagnostics_);
    if (options_.look.empty()) {
      if (options_.material.empty() && !looks.empty()) look_ = looks.front().assignments;
      return;
    }
    for (const Look& look : looks) {
      if (look.name == options_.look) {
        look_ = look.assignments;
        return;
      }
    }
    diagnostics_.error("unknown-look", {document_.files().front(), 0, 0, {}},
                       "there is no look '" + options_.look + "'");
  }

  const Document& document_;
  const AssignmentOptions& options_;
  Diagnostics& diagnostics_;
  std::set<std::string> known_;
  std::string first_;
  std::map<std::string, std::string> assigns_;
  std::vector<Assignment> look_;
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

std::vector<std::string> assign_materials(const Document& document, const host::Scene& scene,
                                          const AssignmentOptions& options,
                                          Diagnostics& diagnostics) {
  const Assigner assigner(document, options, diagnostics);
  std::vector<std::string> materials;
  for (const Mesh& mesh : scene.meshes) {
    materials.push_back(mesh.light_radiance ? std::string() : assigner.material_of(mesh));
  }
  return materials;
}

}  // namespace nacre::tool
