#pragma once

#include <set>
#include <string>

#include "examples/render/gltf_value.h"

namespace nacre::host {

/// Says, once for each kind of thing, what a glTF file has and this host does not render.
class GltfDropped {
 public:
  /// What belongs to no node. False, with errors, if the file requires an extension
  /// without which it cannot be read.
  bool look_at_file(const GltfValue& root, bool reads_materials);
  void look_at_node(const GltfValue& node);
  void look_at_primitive(const GltfValue& primitive);
  /// Once each, that it is left out.
  void look_at_extension(const std::string& name, const GltfValue& extension);

  /// A warning at the value, unless one of this code was given before.
  void say(const char* code, const GltfValue& where, std::string message, std::string expected = {},
           std::string found = {});

 private:
  void look_at_extensions(const GltfValue& extensions);

  std::set<std::string> said_;
};

}  // namespace nacre::host
