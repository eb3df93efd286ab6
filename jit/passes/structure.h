#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// How the values of one function are computed, whatever order they were recorded in. C++
/// leaves open which operand of a sum is evaluated first, so a node's body compiled by another
/// compiler records the same values in another order; a pass that has to choose between values
/// chooses by these.
struct Structure {
  std::vector<std::uint32_t> depth;  ///< By value: operations on the longest way to it.
  /// By value: equal for values that the same operations make of the same inputs. Operands of
  /// what commutes count in any order.
  std::vector<std::uint64_t> digest;
  std::uint64_t whole = 0;  ///< Of what the function gives.
};

/// That of every function of `program`.
std::vector<Structure> structures_of(const Program& program);

}  // namespace nacre
