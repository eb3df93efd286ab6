#pragma once

#include "examples/render/gltf_accessor.h"
#include "examples/render/gltf_dropped.h"
#include "examples/render/gltf_variants.h"
#include "examples/render/mesh.h"
#include "examples/render/scene_budget.h"

namespace nacre::host {

/// Reads the triangles of mesh primitives (glTF 2.0, 3.7.2.1), and lines that have a radius at each
/// vertex as fibres: attribute _RADIUS, a float, in the mesh's own space.
class GltfPrimitives {
 public:
  GltfPrimitives(const GltfValue& root, GltfBuffers& buffers, GltfAccessors& accessors,
                 SceneBudget& budget, GltfDropped& dropped, const GltfVariants& variants)
      : root_(root),
        buffers_(buffers),
        accessors_(accessors),
        budget_(budget),
        dropped_(dropped),
        variants_(variants) {}

  /// Triangles and vertex arrays in the mesh's own space, and the material's name. False
  /// where there is nothing to draw, after an error or a warning.
  bool read(const GltfValue& primitive, Mesh& mesh);

 private:
  struct Attribute {
    std::string semantic;
    GltfValue index;
    GltfAccessor accessor;
  };

  bool open_attributes(const GltfValue& attributes, std::vector<Attribute>& list);
  bool read_triangles(const GltfValue& primitive, std::size_t mode, std::size_t vertices,
                      std::optional<GltfAccessor> indices, Mesh& mesh);
  bool read_lines(const GltfValue& primitive, std::size_t mode, std::vector<Attribute>& list,
                  std::optional<GltfAccessor> indices, Mesh& mesh);
  void read_attribute(const Attribute& attribute, Mesh& mesh);

  GltfValue root_;
  GltfBuffers& buffers_;
  GltfAccessors& accessors_;
  SceneBudget& budget_;
  GltfDropped& dropped_;
  const GltfVariants& variants_;
};

}  // namespace nacre::host
