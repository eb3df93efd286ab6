#pragma once

#include <string_view>

#include "jit/document/element.h"
#include "jit/graph/graph.h"
#include "runtime/type.h"

namespace nacre {

/// What a port comes to.
struct Resolved {
  bool failed = false;
  Type type = Type::none;
  Source source;
  std::string_view unit;             ///< Still to be converted from; "" if not.
  const Element* carrier = nullptr;  ///< The element that wrote the literal.
  bool is_absent = false;            ///< Says nothing after all: the default counts.
};

/// A string where a file name is wanted is one.
inline void take_string(Type wanted, Resolved& result) {
  if (wanted != Type::filename || result.type != Type::string) return;
  result.type = wanted;
  result.source.value.type = wanted;
}

}  // namespace nacre
