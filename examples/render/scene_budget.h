#pragma once

#include <cstddef>
#include <string>

#include "examples/render/scene_limits.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// Counts what the meshes of a scene will take, before they take it.
class SceneBudget {
 public:
  SceneBudget(const SceneLimits& limits, Diagnostics& diagnostics)
      : limits_(limits), diagnostics_(diagnostics) {}

  /// Whether a mesh of that many still has a place.
  bool fits(std::size_t vertices, std::size_t triangles, std::size_t other) const;
  /// One mesh more; `other` bytes besides those of vertices and triangles. False, with an
  /// error at `where`, where that is beyond the limits.
  bool take(const SourceLocation& where, std::size_t vertices, std::size_t triangles,
            std::size_t other);
  /// One more of a mesh that was taken, of a motion of so many segments and steps; the first
  /// counts as the mesh itself does.
  bool take_instance(const SourceLocation& where, bool is_first, std::size_t segments,
                     std::size_t steps);
  /// What belongs to no mesh.
  bool take_bytes(const SourceLocation& where, std::size_t bytes);

 private:
  bool take_mesh(const SourceLocation& where);

  SceneLimits limits_;
  Diagnostics& diagnostics_;
  std::size_t meshes_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace nacre::host
