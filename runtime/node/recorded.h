#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/type.h"
#include "runtime/value/value.h"
#include "runtime/value/vector.h"

namespace nacre {

/// Base of what a BSDF, EDF, VDF or shader port carries while recording; the
/// pbs library defines the kinds. Never exists at run time.
class Closure {
 public:
  virtual ~Closure() = default;
};
using ClosurePtr = std::shared_ptr<const Closure>;  ///< Null: unconnected.

/// Of the parts of a numeric type.
constexpr Scalar scalar_of(Type type) {
  if (type == Type::integer) return Scalar::i32;
  return type == Type::boolean ? Scalar::b1 : Scalar::f32;
}

/// A recorded value of any MaterialX type: what flows along a connection.
struct Recorded {
  Type type = Type::none;  ///< Says which of the others holds it.
  std::vector<Ref> parts;  ///< component_count(type) scalars: Int for integer, Bool for
                           ///< boolean, Float otherwise; matrices row by row.
  std::string text;        ///< string, filename, geomname: always a literal.
  ClosurePtr closure;      ///< Closures and shaders; null: unconnected.

  /// Nothing.
  Recorded() = default;
  /// A value of type `t`, which must be one that such parts make.
  /// @{
  Recorded(Type t, Float x) : type(t), parts{x.ref()} {}
  Recorded(Type t, Int x) : type(t), parts{x.ref()} {}
  Recorded(Type t, Bool x) : type(t), parts{x.ref()} {}
  Recorded(Type t, Float2 v) : type(t), parts{v.x.ref(), v.y.ref()} {}
  Recorded(Type t, Float3 v) : type(t), parts{v.x.ref(), v.y.ref(), v.z.ref()} {}
  Recorded(Type t, Float4 v) : type(t), parts{v.x.ref(), v.y.ref(), v.z.ref(), v.w.ref()} {}
  Recorded(Type t, std::vector<Ref> p) : type(t), parts(std::move(p)) {}
  Recorded(Type t, ClosurePtr c) : type(t), closure(std::move(c)) {}
  /// @}

  /// Part `i`, which must be a Float.
  Float number(std::size_t i = 0) const { return Float(parts[i]); }
};

}  // namespace nacre
