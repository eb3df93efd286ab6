#pragma once

#include <string>
#include <vector>

#include "examples/render/scene.h"
#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// The materials of a scene as a MaterialX document: for each a gltf_pbr, one of GltfPbrNodes, or a
/// surface_unlit.
struct SceneDocument {
  std::string text;
  /// The same with a look, for those who read it beside the scene: it assigns the materials by
  /// where meshes stand, and says which are seen from the front alone.
  std::string text_with_look;
};

/// Textures of occlusion are left out: light that is traced is occluded by what is there, and
/// gltf_pbr makes nothing of its input of that name.
/// What those nodes cannot express is a warning at `scene_file`, once each.
///
/// Mesh::material_name becomes the name in the document: MaterialX has fewer letters than glTF. A
/// material that is on meshes with and without vertex colours is there twice.
/// `image_files`: what each of the scene's images is called in the document. `library`: the data
/// library.
SceneDocument make_scene_document(host::Scene& scene, const std::string& scene_file,
                                  const std::vector<std::string>& image_files,
                                  const Document& library, Diagnostics& diagnostics);

}  // namespace nacre::tool
