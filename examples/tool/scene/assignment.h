#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "examples/render/scene.h"
#include "jit/document/document.h"
#include "jit/graph/look/look.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// Which material goes on which mesh.
struct AssignmentOptions {
  std::string material;              ///< --material
  std::string look;                  ///< --look
  std::vector<std::string> assigns;  ///< --assign NAME=MATERIAL

  void add(CLI::App& command);
};

/// What goes on a mesh.
struct MeshAssignment {
  std::string material;  ///< "": a neutral grey.
  std::vector<VariantChoice> variants;
  std::map<std::string, std::string, std::less<>> tokens;  ///< Of its geometry.
  std::uint32_t visible_to = host::ray_any;                ///< RayKind bits.
  /// The look's properties "twosided" and "matte" and visibility "illumination", as in
  /// host::Mesh. A mesh that no look says anything of is two-sided, though the property's
  /// own default is false: light has to leave solids through their backs.
  bool two_sided = true;
  bool matte = false;
  bool illuminated = true;
  /// The property "dielectric_priority": which of solids that overlap is there; host::Mesh.
  int priority = 0;

  /// The same for assignments that the same kernels serve.
  std::string key() const;
};

/// Where meshes stand, as looks name them: the path of their object and, of a piece of one, its
/// material (Geometry Extensions, "Geometry Representation": the partitions of a mesh).
class MeshPaths {
 public:
  explicit MeshPaths(const host::Scene& scene);
  std::string of(const host::Mesh& mesh) const;

 private:
  std::map<std::string, int> pieces_;  ///< Meshes of an object, by its path.
};

/// One for every mesh. Materials in order of strength: --assign for an object, mesh
/// or material of that name in the scene; the look's materialassigns, by the mesh's
/// path or by its names at the top, where an assignment that is not exclusive lets the
/// one behind it through if its own material has no surface; a material of the document called as
/// the mesh's material; --material, or the document's first material, for what is left. With
/// --material alone, and neither look nor matching names, it goes on everything but
/// the built-in scene's ground and base. The look is the one named, the default of a
/// look group of that name, or the first group's default, or the first look. An --assign
/// that names nothing is an error; an assignment of the look that is on nothing, and a mesh
/// for which only the first of several materials is left, are warnings. A priority that is no
/// integer is the error "bad-priority".
std::vector<MeshAssignment> assign_materials(const Document& document, const host::Scene& scene,
                                             const AssignmentOptions& options,
                                             Diagnostics& diagnostics);

}  // namespace nacre::tool
