#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>

#include "runtime/program/op.h"

namespace nacre {

class Recorder;

/// One recorded scalar: either a literal (recorder is null and `id` holds its
/// bits), or a value of the function that a Recorder is building. Float, Int
/// and Bool wrap it; node bodies never see it.
struct Ref {
  Recorder* recorder = nullptr;  ///< Null: a literal.
  std::uint32_t id = 0;          ///< Bits of a literal, or the ValueId.
  Scalar type = Scalar::f32;     ///< Of both kinds.

  /// A literal.
  bool is_constant() const { return recorder == nullptr; }
  /// A literal of these bits.
  bool is_constant(std::uint32_t bits) const { return is_constant() && id == bits; }

  /// A literal of that type.
  /// @{
  static Ref literal(float value) {
    return {nullptr, std::bit_cast<std::uint32_t>(value), Scalar::f32};
  }
  static Ref literal(std::int32_t value) {
    return {nullptr, std::bit_cast<std::uint32_t>(value), Scalar::i32};
  }
  static Ref literal(bool value) { return {nullptr, value ? 1u : 0u, Scalar::b1}; }
  /// @}
};

/// Records `op` on the operands' recorder and returns its value; literals fold
/// and need no recorder.
Ref record(Op op, std::initializer_list<Ref> operands, std::uint32_t imm = 0);

}  // namespace nacre
