#pragma once

#include <set>
#include <string>
#include <utility>

#include "jit/graph/graph.h"
#include "runtime/diagnostic.h"
#include "runtime/program/program.h"

namespace nacre::tool {

/// Warns of what a bake on the plane (examples/bake/plane.h) cannot know: nodes that read
/// the position, frame, vertex colours or properties of a surface, or the direction of its
/// viewer, get the plane's. Each node is named once.
class PlaneReads {
 public:
  explicit PlaneReads(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Of the kernel of one output and the graph it was made from; `where` is the output.
  /// `in_frame`: the result is a direction that is turned with a surface's frame later,
  /// so that the frame's own axes are right.
  void warn(const Graph& graph, const Program& program, bool in_frame, const SourceLocation& where);

 private:
  Diagnostics& diagnostics_;
  std::set<std::pair<std::string, std::string>> said_;  ///< Channel group, path.
};

}  // namespace nacre::tool
