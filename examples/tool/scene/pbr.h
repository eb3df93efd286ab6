#pragma once

#include <set>
#include <string>

#include "examples/render/scene_material.h"
#include "examples/tool/new_document.h"
#include "examples/tool/scene/gltf_pbr_nodes.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// Puts materials of a scene into a document.
class ScenePbr {
 public:
  /// `library`: the data library.
  ScenePbr(NewDocument& document, const Document& library,
           const std::vector<std::string>& image_files, std::string scene_file,
           Diagnostics& diagnostics)
      : document_(document),
        nodes_(document, library),
        image_files_(image_files),
        scene_file_(std::move(scene_file)),
        diagnostics_(diagnostics) {}

  /// A surfacematerial of that name with its nodes. `has_colors`: vertices have, which multiply.
  void add(const host::SceneMaterial& material, const std::string& name, bool has_colors);

 private:
  /// Once for each `what`.
  void warn(const host::SceneMaterial& material, const char* what, const char* instead);
  void warn_of_lacks(const host::SceneMaterial& material, GltfPbrNodes::Kind kind, bool is_that);

  NewDocument& document_;
  GltfPbrNodes nodes_;
  const std::vector<std::string>& image_files_;
  std::string scene_file_;
  Diagnostics& diagnostics_;
  std::set<std::string> said_;
};

}  // namespace nacre::tool
