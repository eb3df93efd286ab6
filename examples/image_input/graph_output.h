#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <nacre/nacre.hpp>
#include <optional>
#include <string>
#include <vector>

#include "examples/image_input/level.h"

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

  const std::string& name() const { return name_; }
  const std::string& type() const { return type_; }  ///< "color3"
  int components() const { return components_; }
  /// What the document says of its texture's size, else 1024.
  int usual_width() const { return usual_width_; }
  int usual_height() const { return usual_height_; }

  /// Values of time and frame, for `shade`.
  nacre::Instance instance(const Request& request) const;

  /// Texels of a level, row by row, channels side by side; integers and booleans as numbers.
  /// Throws nacre::Error where the graph takes too many steps.
  std::vector<float> shade(const nacre::Instance& instance, const Request& request,
                           const Level& level, const Texels& texels) const;

  /// Points shaded since it was made.
  std::uint64_t points() const { return points_; }

 private:
  /// Points of a grid, `width` x `height` of them from (x, y), into as many texels.
  void run(const nacre::Instance& instance, const Request& request, const Level& level,
           const Texels& points, std::vector<float>& values) const;

  std::string name_;
  std::string type_;
  bool is_float_ = true;
  int components_ = 0;
  int usual_width_ = 1024, usual_height_ = 1024;
  std::optional<nacre::Shader> shader_;
  std::optional<nacre::Binding> binding_;
  mutable std::atomic<std::uint64_t> points_ = 0;
};

}  // namespace graph_image
