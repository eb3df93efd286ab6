#include "examples/tool/scene/document.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "examples/tool/new_document.h"
#include "examples/tool/scene/assignment.h"
#include "examples/tool/scene/pbr.h"

namespace nacre::tool {

namespace {

using host::Mesh;

/// Of what is asked of the document: a material of the scene, or glTF's default, and whether the
/// meshes that have it have colours.
using Use = std::pair<std::optional<std::size_t>, bool>;

bool has_colors(const Mesh& mesh) {
  return std::ranges::any_of(mesh.primvars, [](const auto& p) { return p.name == "color0"; });
}

Use use_of(const Mesh& mesh) { return {mesh.material, has_colors(mesh)}; }

/// A name that MaterialX allows, as like the other as can be.
std::string plain_name(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    result += is_plain ? c : '_';
  }
  if (result.empty()) return "material";
  return result[0] >= '0' && result[0] <= '9' ? '_' + result : result;
}

/// A geometry name that stands for a path: of what it is made of, what would mean something else
/// is any letter.
std::string geometry(std::string path) {
  for (char& c : path) {
    if (std::string_view(",{}[]*").find(c) != std::string_view::npos) c = '?';
  }
  return path;
}

class Writer {
 public:
  Writer(host::Scene& scene, const std::string& scene_file, const std::vector<std::string>& files,
         const Document& library, Diagnostics& diagnostics)
      : scene_(scene), pbr_(document_, library, files, scene_file, diagnostics) {
    default_.name = "default";
  }

  SceneDocument write() {
    for (const Mesh& mesh : scene_.meshes) uses_.insert(use_of(mesh));
    for (std::size_t i = 0; i < scene_.materials.all.size(); ++i) {
      if (!uses_.contains({i, false}) && !uses_.contains({i, true})) uses_.insert({i, false});
    }
    for (const Use& use : uses_) add(use);
    SceneDocument result;
    result.text = document_.text();
    write_look();
    result.text_with_look = document_.text();
    for (Mesh& mesh : scene_.meshes) mesh.material_name = names_.at(use_of(mesh));
    return result;
  }

 private:
  const host::SceneMaterial& material_of(const Use& use) const {
    return use.first ? scene_.materials.all[*use.first] : default_;
  }

  void add(const Use& use) {
    const host::SceneMaterial& material = material_of(use);
    const bool is_second = use.second && uses_.contains({use.first, false});
    const std::string name =
        document_.free_name(plain_name(material.name) + (is_second ? "_colors" : ""));
    names_[use] = name;
    pbr_.add(material, name, use.second);
  }

  void write_look() {
    const MeshPaths paths(scene_);
    std::map<std::string, std::string> places;  // By material of the document.
    std::string fronts;
    const auto add = [](std::string& list, const std::string& place) {
      list += (list.empty() ? "" : ", ") + place;
    };
    for (const Mesh& mesh : scene_.meshes) {
      const std::string place = geometry(paths.of(mesh));
      add(places[names_.at(use_of(mesh))], place);
      if (!material_of(use_of(mesh)).two_sided) add(fronts, place);
    }
    Element& look = document_.make("look", document_.free_name("look_of_scene"));
    for (const auto& [name, list] : places) {
      Element& assign = document_.make("materialassign", "assign_" + name);
      document_.set(assign, "material", name);
      document_.set(assign, "geom", list);
      document_.append(look, assign);
    }
    if (!fronts.empty()) {
      Element& sides = document_.make("propertyassign", "sides", "boolean");
      document_.set(sides, "property", "twosided");
      document_.set(sides, "value", "false");
      document_.set(sides, "geom", fronts);
      document_.append(look, sides);
    }
    document_.append(document_.root(), look);
  }

  host::Scene& scene_;
  host::SceneMaterial default_;  ///< glTF 2.0, 3.7.2.1: of meshes without one.
  NewDocument document_;
  ScenePbr pbr_;
  std::set<Use> uses_;
  std::map<Use, std::string> names_;
};

}  // namespace

SceneDocument make_scene_document(host::Scene& scene, const std::string& scene_file,
                                  const std::vector<std::string>& image_files,
                                  const Document& library, Diagnostics& diagnostics) {
  return Writer(scene, scene_file, image_files, library, diagnostics).write();
}

}  // namespace nacre::tool
