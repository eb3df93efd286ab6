#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::glsl {

struct Struct;

enum class Base : std::uint8_t { none, boolean, integer, natural, number, structure, sampler };

/// A type of the language: scalars, vectors, square matrices, structures, and
/// one-dimensional arrays of these.
struct Type {
  Base base = Base::none;
  std::uint8_t rows = 1;     ///< Components of a vector, or of a matrix's column; a sampler's axes.
  std::uint8_t columns = 1;  ///< Above 1: a matrix.
  int length = 0;            ///< Elements of an array; 0: not an array.
  const Struct* structure = nullptr;

  bool operator==(const Type&) const = default;

  bool is_array() const { return length != 0; }
  bool is_scalar() const { return is_plain() && rows == 1 && columns == 1; }
  bool is_vector() const { return is_plain() && rows > 1 && columns == 1; }
  bool is_matrix() const { return is_plain() && columns > 1; }
  /// Scalar, vector or matrix of numbers or truth values.
  bool is_plain() const {
    return length == 0 && base != Base::none && base != Base::structure && base != Base::sampler;
  }
  bool is_float() const { return is_plain() && base == Base::number; }
  bool is_whole() const { return is_plain() && (base == Base::integer || base == Base::natural); }
  bool is_void() const { return base == Base::none && length == 0; }

  Type element() const {
    Type result = *this;
    result.length = 0;
    return result;
  }
  Type with_rows(int count) const {
    Type result = *this;
    result.rows = static_cast<std::uint8_t>(count);
    result.columns = 1;
    return result;
  }
  Type with_base(Base other) const {
    Type result = *this;
    result.base = other;
    return result;
  }
};

inline constexpr Type void_type{};
inline constexpr Type bool_type{Base::boolean};
inline constexpr Type int_type{Base::integer};
inline constexpr Type uint_type{Base::natural};
inline constexpr Type float_type{Base::number};

struct Struct {
  struct Member {
    std::string_view name;
    Type type;
  };
  std::string_view name;
  std::vector<Member> members;
  int parts = 0;  ///< part_count() of a value; grows no further beyond 2^30.
  int depth = 1;  ///< Structures in one another, this one included.

  void add(const Member& member);
};

/// Scalars that a value of the type has: components of a vector, columns of a
/// matrix one after another, members and elements in order.
int part_count(const Type& type);
/// The base type of scalar `index` of them.
Base part_base(const Type& type, int index);

/// "vec3", "mat4", "Light[2]".
std::string to_string(const Type& type);

/// The built-in type of that name, or void_type with `found` false.
Type builtin_type(std::string_view name, bool& found);

}  // namespace nacre::glsl
