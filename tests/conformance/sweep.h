#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "jit/graph/build/builder.h"
#include "jit/shading/shading_system.h"

namespace nacre::testing {

/// Builds graphs around one nodedef whose every input varies over the surface.
class Sweep {
 public:
  Sweep(const Library& library, const NodeDef& def);

  /// Every output of the nodedef; of a BSDF or EDF, a surface that has it.
  std::optional<Graph> finish(const GraphOptions& options, Diagnostics& diagnostics);

 private:
  GraphBuilder::Node geomprop(Type type, const std::string& name);
  GraphBuilder::Node varying(const NodeDefInput& input);
  GraphBuilder::Node closure(Type type, const std::string& name);

  const NodeDef& def_;
  GraphBuilder builder_;
  GraphBuilder::Node node_{};
};

/// Arrays by channel, as the four-byte elements that kernels read and write.
using Arrays = std::map<std::string, std::vector<std::uint32_t>>;

/// What the geometric properties of a Sweep have at edges: zeros, denormals, whole and
/// huge numbers; with `wild` also what is not finite and what overflows when squared.
/// Each channel goes through them in an order of its own.
std::vector<std::uint32_t> edge_values(const Channel& channel, bool wild, std::size_t count);

/// A kernel's parameters, with every geometric property there.
std::vector<std::uint32_t> sweep_parameters(const BoundKernel& kernel);

/// Runs a kernel over `count` points and returns its outputs. Channels that `known`
/// lacks are those of an ordinary surface.
Arrays run(const BoundKernel& kernel, const Arrays& known, std::size_t count);

}  // namespace nacre::testing
