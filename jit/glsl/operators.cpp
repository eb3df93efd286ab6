#include "jit/glsl/operators.h"

#include <array>
#include <utility>

namespace nacre::glsl {

namespace {

// -- Whole numbers

struct Quotient {
  Int quotient;
  Int remainder;
};

/// Of natural numbers, by estimates in float that never exceed the true
/// quotient: each leaves a remainder below d + 2^-20 n, so three and two
/// corrections reach it. Zero for d = 0.
Quotient divide_natural(Int n, Int d) {
  Int quotient = 0;
  Int remainder = n;
  const Float scale = (1.0f - 0x1p-21f) / to_float_unsigned(d);
  for (int i = 0; i < 3; ++i) {
    const Int estimate = to_int(to_float_unsigned(remainder) * scale);
    quotient = quotient + estimate;
    remainder = remainder - estimate * d;
  }
  for (int i = 0; i < 2; ++i) {
    const Bool fits = !less_unsigned(remainder, d);
    quotient = quotient + to_int(fits);
    remainder = select(fits, remainder - d, remainder);
  }
  const Bool defined = d != Int(0);
  return {select(defined, quotient, Int(0)), select(defined, remainder, Int(0))};
}

Quotient divide(Int a, Int b, bool is_signed) {
  if (!is_signed) return divide_natural(a, b);
  const Bool negative_a = a < Int(0);
  const Bool negative_b = b < Int(0);
  const Quotient of_sizes = divide_natural(select(negative_a, -a, a), select(negative_b, -b, b));
  return {select(negative_a ^ negative_b, -of_sizes.quotient, of_sizes.quotient),
          select(negative_a, -of_sizes.remainder, of_sizes.remainder)};
}

std::optional<Ref> whole(std::string_view op, Int a, Int b, bool is_signed) {
  if (op == "+") return (a + b).ref();
  if (op == "-") return (a - b).ref();
  if (op == "*") return (a * b).ref();
  if (op == "/") return divide(a, b, is_signed).quotient.ref();
  if (op == "%") return divide(a, b, is_signed).remainder.ref();
  if (op == "&") return (a & b).ref();
  if (op == "|") return (a | b).ref();
  if (op == "^") return (a ^ b).ref();
  if (op == "<<") return (a << b).ref();
  if (op == ">>") return is_signed ? (a >> b).ref() : shift_right_logical(a, b).ref();
  return std::nullopt;
}

std::optional<Ref> number(std::string_view op, Float a, Float b) {
  if (op == "+") return (a + b).ref();
  if (op == "-") return (a - b).ref();
  if (op == "*") return (a * b).ref();
  if (op == "/") return (a / b).ref();
  return std::nullopt;
}

std::optional<Ref> arithmetic(std::string_view op, Base base, Ref a, Ref b) {
  if (base == Base::number) return number(op, Float(a), Float(b));
  if (base == Base::boolean) return std::nullopt;
  return whole(op, Int(a), Int(b), base == Base::integer);
}

std::optional<Bool> compare(std::string_view op, Base base, Ref a, Ref b) {
  if (op == ">") return compare("<", base, b, a);
  if (op == ">=") return compare("<=", base, b, a);
  if (op != "<" && op != "<=") return std::nullopt;
  const bool strict = op == "<";
  if (base == Base::number) return strict ? Float(a) < Float(b) : Float(a) <= Float(b);
  if (base == Base::integer) return strict ? Int(a) < Int(b) : Int(a) <= Int(b);
  if (base == Base::natural) {
    return strict ? less_unsigned(Int(a), Int(b)) : !less_unsigned(Int(b), Int(a));
  }
  return std::nullopt;
}

/// Both as the wider of their bases: bool stays, int < uint < float.
bool unite(Value& a, Value& b) {
  if (a.type.base == b.type.base) return true;
  if (a.type.base == Base::boolean || b.type.base == Base::boolean) return false;
  const Base base = std::max(a.type.base, b.type.base);
  a = convert(a, a.type.with_base(base));
  b = convert(b, b.type.with_base(base));
  return true;
}

std::optional<Value> logical(std::string_view op, const Value& a, const Value& b) {
  if (a.type != bool_type || b.type != bool_type) return std::nullopt;
  if (op == "&&") return make(a.truth(0) & b.truth(0));
  if (op == "||") return make(a.truth(0) | b.truth(0));
  return make(a.truth(0) ^ b.truth(0));
}

std::optional<Value> componentwise(std::string_view op, const Value& a, const Value& b) {
  const bool a_spreads = a.type.is_scalar();
  const bool b_spreads = b.type.is_scalar();
  if (!a_spreads && !b_spreads && a.type != b.type) return std::nullopt;
  Value result{a_spreads ? b.type : a.type, {}, {}};
  const int count = part_count(result.type);
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::optional<Ref> part =
        arithmetic(op, result.type.base, a.parts[a_spreads ? 0 : at], b.parts[b_spreads ? 0 : at]);
    if (!part) return std::nullopt;
    result.parts.push_back(*part);
  }
  return result;
}

bool is_linear(const Type& a, const Type& b) {
  if (a.base != Base::number || b.base != Base::number) return false;
  if (a.is_matrix() && b.is_matrix()) return a.columns == b.rows;
  if (a.is_matrix() && b.is_vector()) return a.columns == b.rows;
  if (a.is_vector() && b.is_matrix()) return a.rows == b.rows;
  return false;
}

}  // namespace

Value multiply(const Value& a, const Value& b) {
  // A vector on the left is a row, on the right a column.
  const int rows = a.type.is_vector() ? 1 : a.type.rows;
  const int columns = b.type.columns;
  const int inner = a.type.is_vector() ? a.type.rows : a.type.columns;
  Value result{float_type, {}, {}};
  result.type.rows = static_cast<std::uint8_t>(a.type.is_vector() ? columns : rows);
  result.type.columns = static_cast<std::uint8_t>(a.type.is_vector() ? 1 : columns);
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      Float sum = 0.0f;
      for (int k = 0; k < inner; ++k) {
        const auto left = static_cast<std::size_t>(k * rows + row);
        const auto right = static_cast<std::size_t>(column * inner + k);
        const Float product = a.number(left) * b.number(right);
        sum = k == 0 ? product : sum + product;
      }
      result.parts.push_back(sum.ref());
    }
  }
  return result;
}

Bool equal(const Value& a, const Value& b) {
  Bool result = true;
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    Bool same;
    switch (part_base(a.type, static_cast<int>(i))) {
      case Base::number: same = a.number(i) == b.number(i); break;
      case Base::boolean: same = !(a.truth(i) ^ b.truth(i)); break;
      default: same = a.whole(i) == b.whole(i); break;
    }
    result = result & same;
  }
  return result;
}

std::optional<Value> binary(std::string_view op, const Value& left, const Value& right) {
  if (op == "&&" || op == "||" || op == "^^") return logical(op, left, right);
  Value a = left;
  Value b = right;
  if (op == "==" || op == "!=") {
    if (a.type.is_plain() && b.type.is_plain() && !unite(a, b)) return std::nullopt;
    if (a.type != b.type || a.parts.empty()) return std::nullopt;
    const Bool same = equal(a, b);
    return make(op == "==" ? same : !same);
  }
  if (!a.type.is_plain() || !b.type.is_plain()) return std::nullopt;
  const bool shift = op == "<<" || op == ">>";
  if (shift && (!a.type.is_whole() || !b.type.is_whole())) return std::nullopt;
  if (shift) b = convert(b, b.type.with_base(Base::natural));
  if (shift) b.type.base = a.type.base;
  if (!unite(a, b)) return std::nullopt;
  if (op == "<" || op == ">" || op == "<=" || op == ">=") {
    if (!a.type.is_scalar() || !b.type.is_scalar()) return std::nullopt;
    const std::optional<Bool> result = compare(op, a.type.base, a.parts[0], b.parts[0]);
    return result ? std::optional(make(*result)) : std::nullopt;
  }
  if (op == "*" && is_linear(a.type, b.type)) return multiply(a, b);
  return componentwise(op, a, b);
}

std::optional<Value> unary(std::string_view op, const Value& a) {
  if (!a.type.is_plain()) return std::nullopt;
  const Base base = a.type.base;
  if (op == "!" ? a.type != bool_type : base == Base::boolean) return std::nullopt;
  if (op == "~" && !a.type.is_whole()) return std::nullopt;
  if (op == "+") return a;
  Value result{a.type, {}, {}};
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    if (op == "!") result.parts.push_back((!a.truth(i)).ref());
    if (op == "~") result.parts.push_back((a.whole(i) ^ Int(-1)).ref());
    if (op == "-") {
      result.parts.push_back(base == Base::number ? (-a.number(i)).ref() : (-a.whole(i)).ref());
    }
  }
  return result;
}

}  // namespace nacre::glsl
