#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "runtime/program/op.h"

namespace nacre {

/// The one bit pattern of NaN that can be seen; see Op.
inline constexpr std::uint32_t canonical_nan = 0x7fc00000u;

/// What `op` gives for operands of these bits, or nothing where the operation
/// reads memory or shapes control flow. The plain scalar statement of every
/// operation's meaning: the recorder folds constants with it, and tests hold
/// the engines against it. Transcendental functions are computed in double and
/// rounded once.
std::optional<std::uint32_t> fold(Op op, std::span<const std::uint32_t> operands,
                                  std::uint32_t imm = 0);

/// Zero of the same sign where the bits are a denormal's.
constexpr std::uint32_t flush_denormal(std::uint32_t bits) {
  return (bits & 0x7f800000u) == 0 ? bits & 0x80000000u : bits;
}

/// The binary32 of a binary16, exactly.
float half_to_float(std::uint16_t half);

}  // namespace nacre
