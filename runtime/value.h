#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/type.h"

namespace nacre {

/// A literal of any MaterialX type that has literals. The type says which
/// member holds it; the others are empty.
///
///   float, color*, vector*, matrix*   floats: component_count(type) of them
///   boolean, integer                  ints: one, a boolean being 0 or 1
///   string, filename, geomname        texts: one
///   floatarray, color3array, ...      floats: elements one after another
///   integerarray                      ints
///   stringarray, geomnamearray        texts
///   closures, shaders, material       nothing: "unconnected"
struct Value {
  Type type = Type::none;          ///< None: no value.
  std::vector<float> floats;       ///< Matrices row by row.
  std::vector<std::int32_t> ints;  ///< Booleans, too.
  std::vector<std::string> texts;  ///< As in the document, references of XML resolved.

  bool operator==(const Value&) const = default;
};

}  // namespace nacre
