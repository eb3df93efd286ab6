#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "runtime/program/program.h"
#include "runtime/value/ref.h"

namespace nacre {

// What is known of operands from the instructions that define them, in `code`.

/// The operands of a select without what its condition makes pointless: a negation, which
/// swaps the sides, and on each side a choice by the same condition.
std::array<Ref, 3> simple_choice(const std::vector<Instruction>& code,
                                 std::span<const Ref> operands);

/// Operands on either side of a condition.
struct Sides {
  ValueId condition;
  std::array<Ref, 3> yes, no;
};
/// Of literals and choices between two literals, all by one condition; nothing of others, or where
/// there is no choice.
std::optional<Sides> literal_sides(const std::vector<Instruction>& code,
                                   std::span<const Ref> operands);

/// Whether max(x, limit) is `limit`, a literal that is not negative, for what x is: a product
/// with a literal 0 is a zero, or NaN where the other factor is not finite. So a colour
/// that is clamped from below is black where its weight is off, whatever the colour is.
bool is_limit(const std::vector<Instruction>& code, Ref x, Ref limit);

}  // namespace nacre
