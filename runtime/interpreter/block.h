#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/interpreter/lanes.h"
#include "runtime/kernel.h"

namespace nacre {

/// All lanes of a truth value that holds.
inline constexpr std::uint32_t all_ones = ~0u;

/// The points that are computed side by side: `lanes` of them from `first` on. What a block
/// reads and writes outside the registers, operation by operation.
struct Block {
  const Program& program;
  std::span<const std::vector<std::uint32_t>> tables;  ///< Words of the Program's, no denormals.
  const KernelArguments& arguments;
  std::uint64_t first = 0;
  int lanes = block_lanes;

  void load_constant(Register& to, const Instruction& constant) const;
  void load_parameter(Register& to, const Instruction& parameter) const;
  /// Beyond the batch the last point is repeated: no lane takes a way of its own.
  void load_input(Register& to, const Instruction& input) const;
  void load_table(Register& to, const Instruction& table, const Register& index) const;
  void load_fitted(Register& to, const Instruction& fitted, const Register& index) const;
  void load_texel(Register& to, const Register& slot, const Register& word) const;
  /// `from`: slot, u, v, dudx, dvdx, dudy, dvdy; `to`: r, g, b, a.
  void call_texture(std::span<Register, 4> to, const Instruction& call,
                    std::span<const Register* const> from) const;
  void store(const Register& value, const Instruction& output) const;
};

}  // namespace nacre
