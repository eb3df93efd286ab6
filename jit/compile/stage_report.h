#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jit/compile/facts.h"

namespace nacre {

/// What one stage of the way from a document to a kernel made, for people who look into it.
struct StageReport {
  std::string name;           ///< "graph", "record", "sample: derive", "sample: expand_math", ...
  double milliseconds = 0.0;  ///< Wall clock.
  std::size_t nodes = 0;      ///< Of the graph, after that stage.
  std::size_t instructions = 0;  ///< Of all functions, after the stage.
  std::string text;              ///< What came out; only if asked for.
  std::vector<FactUse> facts;    ///< Of the stage "decide": those that kernels have less for.
};

}  // namespace nacre
