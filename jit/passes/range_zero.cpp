#include "jit/passes/range_zero.h"

#include <bit>
#include <cstdint>

#include "jit/passes/range_arithmetic.h"
#include "runtime/program/fold.h"

namespace nacre {

namespace {

/// Whether a product that is never negative may be -0.
bool product_may_be_minus_zero(const Instruction& x, const OperandRanges& in) {
  if (x.operands[0] == x.operands[1]) return false;
  if (in[0].low < 0 || in[1].low < 0) return true;
  return may_be_minus_zero(in[0]) || may_be_minus_zero(in[1]);
}

}  // namespace

bool gives_minus_zero(const Instruction& x, const OperandRanges& in) {
  switch (x.op) {
    case Op::abs:
    case Op::exp:
    case Op::i_to_f:
    case Op::u_to_f: return false;
    case Op::constant: return flush_denormal(x.imm) == std::bit_cast<std::uint32_t>(-0.0f);
    case Op::mul: return product_may_be_minus_zero(x, in);
    case Op::fma: return product_may_be_minus_zero(x, in) || may_be_minus_zero(in[2]);
    case Op::add:
    case Op::min:
    case Op::merge: return may_be_minus_zero(in[0]) || may_be_minus_zero(in[1]);
    case Op::max:
      // a > b ? a : b
      if (in[1].low >= 0 && !may_be_minus_zero(in[1])) return false;
      return may_be_minus_zero(in[0]) || may_be_minus_zero(in[1]);
    case Op::select: return may_be_minus_zero(in[1]) || may_be_minus_zero(in[2]);
    case Op::div: return in[0].low < 0 || in[1].low < 0 || may_be_minus_zero(in[0]);
    case Op::sub:
    case Op::sqrt:
    case Op::floor:
    case Op::keep: return may_be_minus_zero(in[0]);
    default: return true;
  }
}

}  // namespace nacre
