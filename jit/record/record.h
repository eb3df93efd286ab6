#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "jit/graph/graph.h"
#include "jit/record/bodies.h"
#include "runtime/node/recorded.h"
#include "runtime/node/texture_source.h"
#include "runtime/program/cost.h"
#include "runtime/program/recorder.h"
#include "runtime/stop.h"

namespace nacre {

class TextBodies;

/// Whether the values that an author wrote stay changeable in the kernel.
enum class ParameterMode {
  frozen,  ///< Folded in: the smallest and fastest kernel.
  live,    ///< Slots of the parameter block, named as Graph::parameters are, with
           ///< ".x", ".y", ... for components; one kernel fits all variants.
};

/// How a Graph is recorded.
struct RecordOptions {
  Accuracy accuracy = Accuracy::standard;            ///< What bodies aim at.
  ParameterMode parameters = ParameterMode::frozen;  ///< Of the graph's parameters.
  /// Parameters that are live in any case: their paths fit one of these (is_live).
  std::vector<std::string> live = {};
  TextureProvider* textures = nullptr;  ///< Null: no node has an image.
  /// Runs the graph's `sources`; null: nodes that need one are errors.
  TextBodies* texts = nullptr;
  /// What a text says of a lobe is held to what lobes promise; false: for who looks at the text.
  bool holds_lobes = true;
  /// Compute what only one side of a conditional node needs only where it is taken;
  /// false changes no result, only what it costs.
  bool lazy = true;
  /// Told which node is recorded next; may be null.
  std::function<void(const GraphNode& node)> before_node = {};
  /// See ShaderOptions.
  bool fade_noise = false;
  /// A graph that leads to more is refused.
  std::size_t max_instructions = 500'000;
  /// A graph that takes more for each pass of points, every loop counted for one round, is
  /// refused; see runtime/program/cost.h.
  std::uint64_t max_steps = default_max_steps;
  /// The file that a name written in `document` stands for; the name itself if null.
  std::function<std::string(const std::string& name, const std::string& document)> resolve_file;
  /// Ends recording early, as an error.
  Stop stop = {};
};

/// Records the nodes of a graph that its outputs may need, and returns the values of
/// the outputs. Nothing, with a diagnostic, for a node that has no body and for what
/// becomes too large.
std::optional<std::vector<Recorded>> record_graph(const Graph& graph, const Bodies& bodies,
                                                  const RecordOptions& options, Recorder& recorder,
                                                  Diagnostics& diagnostics);

}  // namespace nacre
