#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/document/library.h"
#include "jit/graph/graph.h"
#include "runtime/diagnostic.h"

namespace nacre {

struct GraphOptions {
  /// True for nodedefs that have a body of ours: they become nodes even where
  /// the library has a graph for them. Empty: those without a graph are taken to
  /// have one. A nodedef with neither passes its `defaultinput` or `default`
  /// through, with a warning.
  std::function<bool(std::string_view nodedef)> is_native;
  /// Colour space that the graph computes in. The library's transforms all lead
  /// to the default.
  std::string working_space = "lin_rec709";
  /// What one unit of scene length is; lengths are converted to it.
  std::string distance_unit = "meter";
  /// Replaces "{frame}" and "{0Nframe}" in file names. Kept as they are without.
  std::optional<int> frame;
  /// A graph with more nodes is refused.
  std::size_t max_nodes = 1'000'000;
  /// A node with more inputs is refused.
  std::size_t max_inputs = 1024;
};

/// What to build; several may be given at once.
struct GraphRequest {
  /// "NG_marble/out", "out" at the root, or a graph or root node with one output.
  std::vector<std::string> outputs;
  /// A material node: its shaders become outputs "surfaceshader",
  /// "backsurfaceshader", "displacementshader" and "volumeshader", those that
  /// are connected.
  std::string material;
};

/// Resolves what is requested into a Graph. Nothing if that finds an error;
/// what is not reached from the request is not looked at.
std::optional<Graph> build_graph(const Document& document, const Definitions& definitions,
                                 const GraphRequest& request, const GraphOptions& options,
                                 Diagnostics& diagnostics);

/// The same, reading the document's own definitions first. To build several
/// graphs from one document make its Definitions once.
std::optional<Graph> build_graph(const Document& document, const Library& library,
                                 const GraphRequest& request, const GraphOptions& options,
                                 Diagnostics& diagnostics);

}  // namespace nacre
