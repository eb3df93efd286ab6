#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/document/library.h"
#include "jit/graph/graph.h"
#include "jit/graph/options.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// What to build; several may be given at once.
struct GraphRequest {
  /// "NG_marble/out", "out" at the root, or a graph or root node with one output.
  std::vector<std::string> outputs;
  /// A material node: its shaders become outputs "surfaceshader",
  /// "backsurfaceshader", "displacementshader" and "volumeshader", those that
  /// are connected.
  std::string material;
  /// Outputs and inputs of nodes anywhere in the document, as outputs of these names:
  /// "NG_marble/noise1", "NG_marble/separate1/outx", "SR_marble/base_color".
  std::vector<std::string> values = {};
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
