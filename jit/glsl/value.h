#pragma once

#include <span>
#include <string>
#include <vector>

#include "jit/glsl/type.h"
#include "runtime/value/value.h"

namespace nacre::glsl {

/// A value while a text is being recorded: its scalars in the order of
/// part_count(). Natural numbers are recorded as i32.
struct Value {
  Type type;
  std::vector<Ref> parts;
  std::string text;         ///< Of a sampler: the name of the image, or of the uniform.
  bool is_uniform = false;  ///< A sampler that the text itself declares.

  Float number(std::size_t i) const { return Float(parts[i]); }
  Int whole(std::size_t i) const { return Int(parts[i]); }
  Bool truth(std::size_t i) const { return Bool(parts[i]); }
};

inline Value make(Float x) { return {float_type, {x.ref()}, {}}; }
inline Value make(Int x) { return {int_type, {x.ref()}, {}}; }
inline Value make(Bool x) { return {bool_type, {x.ref()}, {}}; }

/// "(vec3, float)".
std::string type_list(std::span<const Value> values);

/// Zero, false, of every part.
Value zero(const Type& type);

/// One scalar of base `from` as one of base `to`; GLSL 4.60, 5.4.1. A float
/// becomes a natural number modulo 2^32 where an int could not hold it.
Ref convert(Ref part, Base from, Base to);

/// Whether a value of type `from` may stand where `to` is expected: the same
/// type, or int -> uint, int or uint -> float of one shape (GLSL 4.60, 4.1.10).
bool converts(const Type& from, const Type& to);
/// The value as that type; only where converts().
Value convert(const Value& value, const Type& to);

}  // namespace nacre::glsl
