#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace nacre {

/// The types of MaterialX ports (Specification, "MaterialX Data Types").
enum class Type : std::uint8_t {
  none,
  boolean,
  integer,
  float_,
  color3,
  color4,
  vector2,
  vector3,
  vector4,
  matrix33,  ///< Nine floats, row-major; vectors are rows and stand on the left.
  matrix44,  ///< Sixteen floats, row-major.
  string,
  filename,
  geomname,
  integer_array,
  float_array,
  color3_array,
  color4_array,
  vector2_array,
  vector3_array,
  vector4_array,
  string_array,
  geomname_array,
  bsdf,
  edf,
  vdf,
  surfaceshader,
  displacementshader,
  volumeshader,
  lightshader,
  material,
};

/// The name a document uses: "color3", "BSDF", "integerarray".
std::string_view type_name(Type type);
/// The type of that name, or nothing for a name the standard does not have.
std::optional<Type> parse_type(std::string_view name);

/// Scalars in one value: 1 for float, 3 for color3, 16 for matrix44;
/// 0 for strings, arrays, closures and shaders.
int component_count(Type type);

/// Types an image can hold and a Program can compute with: component_count > 0.
inline bool is_numeric(Type type) { return component_count(type) > 0; }
/// String, filename and geomname.
bool is_text(Type type);
/// The nine array types.
bool is_array(Type type);
/// BSDF, EDF, VDF.
bool is_closure(Type type);

}  // namespace nacre
