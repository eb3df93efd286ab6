#pragma once

#include <cstdint>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// Where the interpreter keeps each value of one function.
struct RegisterMap {
  std::vector<std::uint32_t> of;  ///< By value id; no_value for those without one.
  std::uint32_t count = 0;        ///< Registers in the frame.
};

/// Gives every value a register. Constants, and what is computed `once` a call (by value id),
/// keep theirs for good; the others share by last use.
RegisterMap assign_registers(const Function& function, const std::vector<bool>& once);

}  // namespace nacre
