#include "runtime/program/simplify.h"

#include <bit>

namespace nacre {

namespace {

constexpr std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
constexpr std::uint32_t minus_zero = 0x80000000u;

/// Whether x + `zero` is x: of x = -0 only for -0 that is exact.
bool adds_nothing(Ref zero, bool keeps_sign) {
  return zero.is_constant(minus_zero) || (!keeps_sign && zero.is_constant(0u));
}
/// Whether x - `zero` is x.
bool takes_nothing(Ref zero, bool keeps_sign) {
  return zero.is_constant(0u) || (!keeps_sign && zero.is_constant(minus_zero));
}
bool same(Ref a, Ref b) { return a.recorder == b.recorder && a.id == b.id && a.type == b.type; }

std::optional<Ref> simplify_logic(Op op, Ref a, Ref b) {
  switch (op) {
    case Op::band:
      if (a.is_constant()) return a.id != 0 ? b : a;
      if (b.is_constant()) return b.id != 0 ? a : b;
      if (same(a, b)) return a;
      break;
    case Op::bor:
      if (a.is_constant()) return a.id != 0 ? a : b;
      if (b.is_constant()) return b.id != 0 ? b : a;
      if (same(a, b)) return a;
      break;
    case Op::bxor:
      if (a.is_constant(0u)) return b;
      if (b.is_constant(0u)) return a;
      break;
    default: break;
  }
  return std::nullopt;
}

std::optional<Ref> simplify_integer(Op op, Ref a, Ref b) {
  switch (op) {
    case Op::iadd:
    case Op::ior:
    case Op::ixor:
      if (a.is_constant(0u)) return b;
      if (b.is_constant(0u)) return a;
      break;
    case Op::isub:
    case Op::shl:
    case Op::lshr:
    case Op::ashr:
      if (b.is_constant(0u)) return a;
      break;
    case Op::imul:
      if (a.is_constant(1u) || b.is_constant(0u)) return b;
      if (b.is_constant(1u) || a.is_constant(0u)) return a;
      break;
    case Op::iand:
      if (a.is_constant(0u) || b.is_constant(~0u)) return a;
      if (b.is_constant(0u) || a.is_constant(~0u)) return b;
      break;
    default: break;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Ref> simplify(Op op, std::span<const Ref> x, bool keeps_sign) {
  switch (op) {
    case Op::add:
      if (adds_nothing(x[0], keeps_sign)) return x[1];
      if (adds_nothing(x[1], keeps_sign)) return x[0];
      return std::nullopt;
    case Op::sub:
      if (takes_nothing(x[1], keeps_sign)) return x[0];
      return std::nullopt;
    case Op::mul:
      if (x[0].is_constant(one)) return x[1];
      if (x[1].is_constant(one)) return x[0];
      return std::nullopt;
    case Op::div:
      if (x[1].is_constant(one)) return x[0];
      return std::nullopt;
    case Op::select:
      if (x[0].is_constant()) return x[0].id != 0 ? x[1] : x[2];
      if (same(x[1], x[2])) return x[1];
      return std::nullopt;
    case Op::min:
    case Op::max:
    case Op::merge:
      if (same(x[0], x[1])) return x[0];
      return std::nullopt;
    case Op::band:
    case Op::bor:
    case Op::bxor: return simplify_logic(op, x[0], x[1]);
    default:
      if (x.size() == 2 && x[0].type == Scalar::i32) return simplify_integer(op, x[0], x[1]);
      return std::nullopt;
  }
}

}  // namespace nacre
