#include "runtime/program/op.h"

#include <array>
#include <cstddef>

namespace nacre {

namespace {

using enum Scalar;

// In the order of the enumeration; checked below.
constexpr std::array<OpInfo, op_count> table{{
    {Op::constant, "const", "", none, true, false},
    {Op::parameter, "param", "", none, true, false},
    {Op::input, "input", "", none, true, false},
    {Op::argument, "arg", "", none, true, false},
    {Op::add, "add", "ff", f32, false, true},
    {Op::sub, "sub", "ff", f32, false, false},
    {Op::mul, "mul", "ff", f32, false, true},
    {Op::div, "div", "ff", f32, false, false},
    {Op::fma, "fma", "fff", f32, false, false},
    {Op::min, "min", "ff", f32, false, false},
    {Op::max, "max", "ff", f32, false, false},
    {Op::sqrt, "sqrt", "f", f32, false, false},
    {Op::neg, "neg", "f", f32, false, false},
    {Op::abs, "abs", "f", f32, false, false},
    {Op::floor, "floor", "f", f32, false, false},
    {Op::ceil, "ceil", "f", f32, false, false},
    {Op::trunc, "trunc", "f", f32, false, false},
    {Op::round, "round", "f", f32, false, false},
    {Op::eq, "eq", "ff", b1, false, true},
    {Op::ne, "ne", "ff", b1, false, true},
    {Op::lt, "lt", "ff", b1, false, false},
    {Op::le, "le", "ff", b1, false, false},
    {Op::iadd, "iadd", "ii", i32, false, true},
    {Op::isub, "isub", "ii", i32, false, false},
    {Op::imul, "imul", "ii", i32, false, true},
    {Op::umulhi, "umulhi", "ii", i32, false, true},
    {Op::iand, "iand", "ii", i32, false, true},
    {Op::ior, "ior", "ii", i32, false, true},
    {Op::ixor, "ixor", "ii", i32, false, true},
    {Op::shl, "shl", "ii", i32, false, false},
    {Op::lshr, "lshr", "ii", i32, false, false},
    {Op::ashr, "ashr", "ii", i32, false, false},
    {Op::ieq, "ieq", "ii", b1, false, true},
    {Op::ilt, "ilt", "ii", b1, false, false},
    {Op::ult, "ult", "ii", b1, false, false},
    {Op::band, "band", "bb", b1, false, true},
    {Op::bor, "bor", "bb", b1, false, true},
    {Op::bxor, "bxor", "bb", b1, false, true},
    {Op::bnot, "bnot", "b", b1, false, false},
    {Op::select, "select", "bxx", none, true, false},
    {Op::f_to_i, "f_to_i", "f", i32, false, false},
    {Op::i_to_f, "i_to_f", "i", f32, false, false},
    {Op::u_to_f, "u_to_f", "i", f32, false, false},
    {Op::bits, "bits", "f", i32, false, false},
    {Op::from_bits, "from_bits", "i", f32, false, false},
    {Op::b_to_i, "b_to_i", "b", i32, false, false},
    {Op::half_to_f, "half_to_f", "i", f32, false, false},
    {Op::sin, "sin", "f", f32, false, false},
    {Op::cos, "cos", "f", f32, false, false},
    {Op::tan, "tan", "f", f32, false, false},
    {Op::asin, "asin", "f", f32, false, false},
    {Op::acos, "acos", "f", f32, false, false},
    {Op::atan2, "atan2", "ff", f32, false, false},
    {Op::exp, "exp", "f", f32, false, false},
    {Op::exp2, "exp2", "f", f32, false, false},
    {Op::log, "log", "f", f32, false, false},
    {Op::log2, "log2", "f", f32, false, false},
    {Op::pow, "pow", "ff", f32, false, false},
    {Op::table, "table", "i", f32, false, false},
    {Op::fitted, "fitted", "i", f32, false, false},
    {Op::texel, "texel", "ii", i32, false, false},
    {Op::texture_call, "texture_call", "iffffff?i", none, false, false},
    {Op::result, "result", "*", none, true, false},
    {Op::if_any, "if_any", "b", none, false, false},
    {Op::merge, "merge", "xx", none, true, false},
    {Op::end_if, "end_if", "", none, false, false},
    {Op::loop, "loop", "b", none, false, false},
    {Op::carry, "carry", "x", none, true, false},
    {Op::next, "next", "xx", none, true, false},
    {Op::again, "again", "b", none, false, false},
    {Op::end_loop, "end_loop", "", none, false, false},
    {Op::call, "call", "*", none, false, false},
    {Op::give, "give", "x", none, false, false},
    {Op::keep, "keep", "x", none, true, false},
    {Op::ddx, "ddx", "f", f32, false, false},
    {Op::stand_in, "stand_in", "ff", f32, false, false},
    {Op::store, "store", "x", none, false, false},
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (static_cast<std::size_t>(table[i].op) != i) return false;
  }
  return true;
}
static_assert(in_order());

}  // namespace

const OpInfo& info(Op op) { return table[static_cast<std::size_t>(op)]; }

bool opens_region(Op op) { return op == Op::if_any || op == Op::loop; }

bool closes_region(Op op) { return op == Op::end_if || op == Op::end_loop; }

bool is_structural(Op op) {
  switch (op) {
    case Op::if_any:
    case Op::merge:
    case Op::end_if:
    case Op::loop:
    case Op::carry:
    case Op::next:
    case Op::again:
    case Op::end_loop:
    case Op::give:
    case Op::store: return true;
    default: return false;
  }
}

bool is_transcendental(Op op) { return op >= Op::sin && op <= Op::pow; }

std::string_view scalar_name(Scalar scalar) {
  switch (scalar) {
    case none: return "none";
    case f32: return "f32";
    case i32: return "i32";
    case b1: return "b1";
  }
  return "";
}

}  // namespace nacre
