#pragma once

#include <map>
#include <string>

#include "examples/tool/new_document.h"
#include "jit/document/document.h"

namespace nacre::tool {

/// gltf_pbr, and nodes with its inputs for what its graph in the data library leaves undone: that
/// graph computes the medium of KHR_materials_volume and puts it nowhere, and knows no thin walls.
class GltfPbrNodes {
 public:
  enum class Kind {
    plain,   ///< The library's.
    wall,    ///< Light passes through as through a sheet (KHR_materials_transmission).
    volume,  ///< Light that gets in is attenuated (KHR_materials_volume).
  };

  /// `library`: the data library, which outlives this.
  GltfPbrNodes(NewDocument& document, const Document& library)
      : document_(document), library_(library) {}

  /// The category of such a node. The document gets its nodedef and graph, copies of the library's
  /// that are changed, when it is first asked for. That of the plain one where the library's graph
  /// has not the nodes that would be changed.
  std::string category(Kind kind);

 private:
  std::string make(Kind kind);

  NewDocument& document_;
  const Document& library_;
  std::map<Kind, std::string> made_;
};

}  // namespace nacre::tool
