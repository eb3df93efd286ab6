#include "jit/glsl/value.h"

#include <fmt/format.h>

namespace nacre::glsl {

Value zero(const Type& type) {
  Value result{type, {}, {}};
  for (int i = 0; i < part_count(type.element()); ++i) {
    switch (part_base(type, i)) {
      case Base::boolean: result.parts.push_back(Ref::literal(false)); break;
      case Base::number: result.parts.push_back(Ref::literal(0.0f)); break;
      default: result.parts.push_back(Ref::literal(0)); break;
    }
  }
  const std::vector<Ref> element = result.parts;
  for (int i = 1; i < type.length; ++i) {
    result.parts.insert(result.parts.end(), element.begin(), element.end());
  }
  return result;
}

namespace {

Ref to_natural(Float x) {
  const Float half = 2147483648.0f;
  const Int low = to_int(x);
  const Int high = to_int(x - half) ^ Int(INT32_MIN);
  return select(x >= half, high, low).ref();
}

}  // namespace

Ref convert(Ref part, Base from, Base to) {
  if (from == to) return part;
  const bool from_whole = from == Base::integer || from == Base::natural;
  switch (to) {
    case Base::boolean:
      return from_whole ? (Int(part) != Int(0)).ref() : (Float(part) != Float(0.0f)).ref();
    case Base::number:
      if (from == Base::boolean) return to_float(Bool(part)).ref();
      return from == Base::natural ? to_float_unsigned(Int(part)).ref() : to_float(Int(part)).ref();
    case Base::integer:
    case Base::natural:
      if (from == Base::boolean) return to_int(Bool(part)).ref();
      if (from_whole) return part;
      return to == Base::natural ? to_natural(Float(part)) : to_int(Float(part)).ref();
    default: return part;
  }
}

bool converts(const Type& from, const Type& to) {
  if (from == to) return true;
  if (!from.is_whole() || !to.is_plain() || from.with_base(to.base) != to) return false;
  return to.base == Base::number || (from.base == Base::integer && to.base == Base::natural);
}

Value convert(const Value& value, const Type& to) {
  if (value.type == to) return value;
  Value result{to, {}, {}};
  for (const Ref part : value.parts) {
    result.parts.push_back(convert(part, value.type.base, to.base));
  }
  return result;
}

std::string type_list(std::span<const Value> values) {
  std::string text;
  for (const Value& value : values) {
    if (!text.empty()) text += ", ";
    text += to_string(value.type);
  }
  return fmt::format("({})", text);
}

}  // namespace nacre::glsl
