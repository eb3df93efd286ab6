#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "examples/image_input/opened_graph.h"
#include "examples/image_input/plane.h"

namespace graph_image {

/// A compiled output of a document, on the plane. Any number of threads may shade with one.
class GraphOutput {
 public:
  /// Of the request count: the document, already read, the output, the profile, accuracy,
  /// anisotropy and the frame's whole number, which names of images depend on. Code is made while
  /// the first points are interpreted, with the same bits, but at `fast`, where they could differ.
  /// Throws Wrong and nacre::Error.
  GraphOutput(nacre::System& system, const nacre::Document& document, const Request& request,
              std::vector<nacre::Diagnostic>& said);

  /// But for the warnings, which are the caller's.
  const GraphInfo& info() const { return info_; }

  /// Values of time and frame, for `shade`.
  nacre::Instance instance(const Request& request) const;

  /// As OpenedGraph::shade, of points of a grid that has those of all of the level.
  std::vector<float> shade(const nacre::Instance& instance, const PlaneGrid& grid,
                           const Level& level, const Texels& texels) const;

  /// Points shaded since it was made.
  std::uint64_t points() const { return points_; }

 private:
  /// The numbers of points of a grid.
  void run(const nacre::Instance& instance, const PlaneGrid& grid, const Texels& points,
           std::vector<float>& values) const;

  GraphInfo info_;
  bool is_float_ = true;
  std::unique_ptr<const nacre::Shader> shader_;
  std::unique_ptr<const nacre::Binding> binding_;
  mutable std::atomic<std::uint64_t> points_ = 0;
};

}  // namespace graph_image
