#pragma once

#include <memory>
#include <string>
#include <vector>

#include "examples/image_input/level.h"
#include "examples/image_input/request.h"

namespace graph_image {

/// What there is to say of a graph output as an image.
struct GraphInfo {
  std::string output;         ///< "NG_marble/base_color"
  std::string type;           ///< "color3"
  std::string warnings;       ///< A line each.
  int components = 0;         ///< Numbers of a texel.
  int width = 0, height = 0;  ///< What the document says of its texture's size, else 1024.
};

/// A graph output that somebody has open. Any number of threads may shade.
class OpenedGraph {
 public:
  virtual ~OpenedGraph() = default;

  virtual const GraphInfo& info() const = 0;
  /// Texels of a level, row by row, numbers side by side; integers and booleans as numbers.
  /// Throws an exception of the standard's where the graph takes too many steps.
  virtual std::vector<float> shade(const Level& level, const Texels& texels) const = 0;
};

/// Opens what is asked for; its size does not matter. Throws an exception of the standard's.
using OpenGraph = std::unique_ptr<OpenedGraph>(const Request& request);

}  // namespace graph_image
