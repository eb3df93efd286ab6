#pragma once

#include <cstdint>
#include <string_view>

namespace nacre {

/// What one lane of one value holds.
enum class Scalar : std::uint8_t {
  none,  ///< No value: stores and structure.
  f32,   ///< IEEE 754 binary32; double in the reference engine. Never denormal.
  i32,   ///< 32 bits, two's complement; operations wrap.
  b1,    ///< A truth value.
};

/// The operations of a Program. What each computes is said here once and holds
/// in every engine, bit for bit in the JIT and the interpreter:
///
/// * f32 arithmetic rounds to nearest even; denormal results and inputs are
///   zero of the same sign; the result of an invalid operation is NaN. NaN has
///   one observable value, 0x7fc00000: `store` and `bits` write no other.
/// * The sign of a zero result of add and sub is unspecified (x + 0 is x).
/// * i32 operations wrap modulo 2^32; shifts use the low five bits of the
///   count; no integer operation is undefined for any input.
enum class Op : std::uint8_t {
  // Leaves. imm: constant bits, or an index into the Program's lists.
  constant,   ///< imm: the bits (f32, i32) or 0 / 1 (b1).
  parameter,  ///< Slot imm of the parameter block. Uniform. b1: slot != 0.
  input,      ///< Channel imm of the batch. Denormals read as zero.
  argument,   ///< Argument imm of the outlined function this stands in.

  // f32 -> f32
  add,
  sub,
  mul,
  div,    ///< x / 0 is an infinity or NaN as IEEE says.
  fma,    ///< a * b + c, rounded once.
  min,    ///< a < b ? a : b, so b where either is NaN.
  max,    ///< a > b ? a : b, so b where either is NaN.
  sqrt,   ///< NaN below zero.
  neg,    ///< Flips the sign bit.
  abs,    ///< Clears the sign bit.
  floor,  ///< Infinities and NaN pass.
  ceil,
  trunc,
  round,  ///< To nearest, ties to even.

  // f32, f32 -> b1. All but ne are false where either is NaN.
  eq,
  ne,
  lt,
  le,

  // i32 -> i32
  iadd,
  isub,
  imul,
  umulhi,  ///< High half of the unsigned 64-bit product.
  iand,
  ior,
  ixor,
  shl,
  lshr,  ///< Shifts zeros in.
  ashr,  ///< Shifts the sign in.

  // i32, i32 -> b1
  ieq,
  ilt,  ///< Signed.
  ult,  ///< Unsigned.

  // b1 -> b1
  band,
  bor,
  bxor,
  bnot,

  select,  ///< (b1, x, x) -> x: the second where true, else the third.

  // Conversions
  f_to_i,     ///< Toward zero; clamped to the range of i32; NaN gives 0.
  i_to_f,     ///< Signed, to nearest even.
  u_to_f,     ///< Unsigned, to nearest even.
  bits,       ///< The bits of an f32; every NaN gives 0x7fc00000.
  from_bits,  ///< The f32 of those bits; a denormal gives zero of its sign.
  b_to_i,     ///< 1 where true, else 0.
  half_to_f,  ///< The binary16 in the low 16 bits, exactly.

  // Transcendental functions, f32 -> f32. The pass `expand_math` replaces them
  // by the operations above, as the accuracy mode asks; only the reference
  // engine runs them, through the C library in double.
  sin,
  cos,
  tan,
  asin,   ///< NaN outside [-1, 1].
  acos,   ///< NaN outside [-1, 1].
  atan2,  ///< (y, x); atan2(0, 0) = 0 with C99's signs.
  exp,
  exp2,
  log,   ///< -inf at 0, NaN below.
  log2,  ///< -inf at 0, NaN below.
  pow,   ///< C99 Annex F.

  // Memory
  table,         ///< (i32 index) Entry of constant table imm; index clamped to it.
  fitted,        ///< (i32 index) Number index & 15 of row imm of the numbers that parameters were
                 ///< fitted with (Fit).
  texel,         ///< (i32 slot, i32 word) One word of a resident texture.
  texture_call,  ///< (slot, u, v, dudx, dvdx, dudy, dvdy[, i32 anisotropy]) A look-up that the
                 ///< host answers; imm: filter and address modes, with the anisotropy of who
                 ///< gives none. See `result`.
  result,        ///< (call or texture_call) Result imm of it.

  // Structure. A region is the instructions between its opening and closing
  // one; values defined in it are not visible after it, except merge and next.
  if_any,  ///< (b1 mask) The region runs if any lane's mask is true.
  merge,   ///< (inner, outer) Last in an if_any region, visible after it: inner
           ///< in the lanes of the mask, outer in the others.
  end_if,
  loop,   ///< (b1 mask) Runs its region at most loop_bound(imm) times while any lane is
          ///< active. With loop_must_end in imm it is an error if one still is then: the
          ///< run ends, RunStatus::too_many_steps.
  carry,  ///< (initial) First in a loop region: the value carried by a lane.
  next,   ///< (carry, value) Last but one in a loop region: what the carry becomes
          ///< in active lanes. Visible after the loop as the final value.
  again,  ///< (b1) Last in a loop region: lanes where false stop being active.
  end_loop,
  call,  ///< (arguments...) Function imm of the Program. See `result`.
  give,  ///< (value) Result imm of the outlined function this stands in.

  // Marks that passes remove.
  keep,      ///< (x) -> x. Where a material's scatter state is cut: `begin` stores
             ///< it, the other kernels load it. imm: 0.
  ddx,       ///< (f32) Derivative along axis imm (0: x, 1: y) of the footprint.
  stand_in,  ///< (x, y) -> x, with the derivatives of y: of a value that was drawn, so that it
             ///< has none, for the one that it is drawn for.

  store,  ///< (value) Output channel imm.
};

/// How an operation looks: for the printer, the verifier and the passes.
struct OpInfo {
  Op op;                  ///< The one that the row is of.
  std::string_view name;  ///< "add", as texts of Programs have it.
  /// One letter an operand: f, i, b, or x for any (all x of one operation
  /// agree); "*" for as many as there are; those behind "?" all or none.
  std::string_view operands;
  Scalar result;    ///< none also where the instruction itself says (x).
  bool any_result;  ///< The result's type is that of the x operands.
  bool commutes;    ///< Two operands may change places.
};

/// The row of an operation.
const OpInfo& info(Op op);
/// In the imm of a loop: more rounds than its bound are no result, but an error.
inline constexpr std::uint32_t loop_must_end = 0x80000000u;
/// Rounds that the imm of a loop allows.
constexpr std::uint32_t loop_bound(std::uint32_t imm) { return imm & ~loop_must_end; }

/// Operations there are.
inline constexpr int op_count = static_cast<int>(Op::store) + 1;

/// Opens a region: if_any, loop.
bool opens_region(Op op);
/// Closes a region: end_if, end_loop.
bool closes_region(Op op);
/// Has an effect or shapes control flow: never shared, never moved.
bool is_structural(Op op);
/// sin ... pow.
bool is_transcendental(Op op);

/// "f32", "i32", "b1" or "none".
std::string_view scalar_name(Scalar scalar);

}  // namespace nacre
