#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/interpreter/lanes.h"
#include "runtime/interpreter/registers.h"
#include "runtime/program/cost.h"
#include "runtime/program/program.h"

namespace nacre {

/// When an instruction is computed.
enum class Turn : std::uint8_t {
  never,  ///< Constants have their registers filled.
  once,   ///< A call of the kernel; only in its entry.
  each,   ///< Block of points.
};

/// What one instruction asks for, at hand.
struct Step {
  LaneOp run = nullptr;  ///< Null where the interpreter itself does the work.
  /// Of the result and the operands, counted in the function's frame; 0 for those that it has not.
  std::array<std::uint32_t, 4> registers{};
  Turn turn = Turn::each;
};

/// A function with its registers assigned and its regions' ends found, each by instruction.
struct Prepared {
  const Function* function;
  RegisterMap registers;
  std::vector<Step> steps;
  std::vector<std::size_t> end;  ///< The closing instruction, of those that open a region.
  /// Of an if_any its first merge, of a merge the next one of the same region, or no_value.
  std::vector<ValueId> next_merge;
  std::vector<ValueId> mask;  ///< Of a merge: what its region opened by.
  std::vector<double> round;  ///< Steps of a round, of those that open a loop.
};

/// All functions of a Program, which must outlive them.
std::vector<Prepared> prepare(const Program& program);

}  // namespace nacre
