#pragma once

#include <cstddef>
#include <vector>

#include "runtime/interpreter/registers.h"
#include "runtime/program/cost.h"
#include "runtime/program/program.h"

namespace nacre {

/// A function with its registers assigned and its regions' ends found, each by instruction.
struct Prepared {
  const Function* function;
  std::vector<bool> once;  ///< Computed once a call of the kernel; only the entry has any.
  RegisterMap registers;
  std::vector<std::size_t> end;  ///< The closing instruction, of those that open a region.
  std::vector<double> round;     ///< Steps of a round, of those that open a loop.
};

/// All functions of a Program, which must outlive them.
std::vector<Prepared> prepare(const Program& program);

}  // namespace nacre
