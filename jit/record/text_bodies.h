#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "jit/document/nodedef.h"
#include "jit/graph/graph.h"
#include "jit/record/text_modules.h"
#include "runtime/node/node_call.h"
#include "runtime/stop.h"

namespace nacre {

/// Runs nodes whose implementation is a text of the GLSL subset. May be used from any thread.
///
/// How a node becomes a call follows MaterialX's GLSL generator: the inputs in
/// the nodedef's order, then the outputs; colours and vectors as vecN, matrices
/// as matN whose columns are MaterialX's rows, a string as the index of its
/// value among those allowed (else 0), a file name as sampler2D. A structure (typedef)
/// is one that the text declares, of any name, with the same members in the same order.
class TextBodies {
 public:
  /// `roots` as in TextModules.
  explicit TextBodies(std::vector<std::filesystem::path> roots = {}) : modules_(std::move(roots)) {}
  const std::vector<std::filesystem::path>& roots() const { return modules_.roots(); }

  /// Records the node and sets its outputs. False, with a diagnostic, for a
  /// text that cannot be read or does not fit the node: it says the file, line and column
  /// of the text and the path of the implementation, and is said once for all nodes.
  /// A BSDF becomes a lobe whose functions the text has: jit/record/text_lobe.h;
  /// `holds_lobes` is for them.
  bool record(const NodeText& source, NodeCall& call, const Stop& stop = {},
              bool holds_lobes = true);

  /// Records the node on its own, every number unknown, to find what is wrong
  /// with the text.
  bool check(const NodeText& source, const NodeDef& def, Diagnostics& diagnostics,
             const Stop& stop = {});

 private:
  TextModules modules_;
};

}  // namespace nacre
