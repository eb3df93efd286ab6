#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jit/passes/range.h"

namespace nacre {

/// The numbers of the inputs <name>.x, .y and .z, where they are floats.
std::optional<std::array<std::uint32_t, 3>> vector_inputs(const Program& program,
                                                          const std::string& name);

/// Finds the scalar products of a Program's entry of which something is known, in whichever order
/// they are summed.
class Dots {
 public:
  Dots(const Program& program, const Known& known);

  /// What is known of the next value of the entry as a scalar product; of values in order, but for
  /// those of loops, which come again.
  Range look_at(ValueId value);

 private:
  /// Two inputs that are multiplied, by number.
  using Term = std::pair<std::uint32_t, std::uint32_t>;
  struct Dot {
    std::array<Term, 3> terms;  ///< Sorted.
    Range range;                ///< With room for the rounding of any order.
  };

  std::vector<Term> terms_of(ValueId value) const;
  bool is_input(ValueId value) const;

  const std::vector<Instruction>& code_;
  std::vector<Dot> dots_;
  std::vector<std::vector<Term>> terms_;  ///< By value: what is summed, sorted; empty: else.
};

}  // namespace nacre
