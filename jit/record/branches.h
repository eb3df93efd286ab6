#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "jit/graph/graph.h"

namespace nacre {

/// Where the nodes of a graph are recorded, so that what only one side of a
/// conditional node needs is computed only where that side is taken.
///
/// Every conditional (ifgreater, ifgreatereq, ifequal with numbers to choose from) has
/// two branches, for its inputs in1 and in2. A node stands in the innermost branch that
/// all its readers stand in, itself or in branches within; branch 0 is the whole graph.
struct BranchPlan {
  static constexpr std::uint32_t whole = 0;
  struct Branch {
    std::uint32_t parent = whole;
    std::uint32_t depth = 0;
    std::vector<std::uint32_t> nodes;  ///< Ascending.
  };
  std::vector<Branch> branches;  ///< Branch 0 first.
  /// By node: the branches of a conditional's in1 and in2; 0 and 0 for others.
  std::vector<std::array<std::uint32_t, 2>> of_node;
};

/// Linear in the size of the graph. Conditionals that stand 64 branches deep have none
/// of their own.
BranchPlan plan_branches(const Graph& graph);

}  // namespace nacre
