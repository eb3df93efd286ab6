#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "examples/bake_mesh/mesh_surface.h"
#include "examples/tool/bake/plane_reads.h"
#include "jit/graph/graph.h"
#include "jit/shading/shading_system.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// What `nacre bake` bakes on, the plane or meshes: says what kernels read of it that it does not
/// have, and refuses those that ask for a viewer where there is none.
class BakeTarget {
 public:
  /// `surface`: null for the plane. `is_viewed`: along its normals.
  BakeTarget(std::unique_ptr<host::MeshSurface> surface, bool is_viewed, Diagnostics& diagnostics)
      : surface_(std::move(surface)),
        is_viewed_(is_viewed),
        diagnostics_(diagnostics),
        plane_reads_(diagnostics) {}

  const host::MeshSurface* surface() const { return surface_.get(); }

  /// Makes kernels for it ask for what differs from mesh to mesh.
  void prepare(ShaderOptions& shader) const;
  /// Of the kernel of one output and the graph it was made from; `where` is the output.
  /// `in_frame`: the result is a direction in the surface's frame. False after an error.
  bool prepare(const Graph& graph, const Program& program, bool in_frame,
               const SourceLocation& where);
  /// Before a map is baked; false after an error.
  bool lay_out(const host::BakeSettings& map);

 private:
  bool check_reads(const Graph& graph, const Program& program, const SourceLocation& where);

  std::unique_ptr<host::MeshSurface> surface_;
  bool is_viewed_;
  Diagnostics& diagnostics_;
  PlaneReads plane_reads_;
  std::set<std::pair<std::string, std::string>> said_;  ///< Channel group, path.
};

}  // namespace nacre::tool
