#include "jit/glsl/type.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace nacre::glsl {

namespace {

constexpr long long max_parts = 1 << 30;

constexpr Type vector(Base base, std::uint8_t rows) { return {base, rows}; }
constexpr Type matrix(std::uint8_t size) { return {Base::number, size, size}; }
constexpr Type sampler(std::uint8_t axes) { return {Base::sampler, axes}; }

constexpr std::array<std::pair<std::string_view, Type>, 28> builtin_types{{
    {"void", void_type},
    {"bool", bool_type},
    {"int", int_type},
    {"uint", uint_type},
    {"float", float_type},
    {"vec2", vector(Base::number, 2)},
    {"vec3", vector(Base::number, 3)},
    {"vec4", vector(Base::number, 4)},
    {"ivec2", vector(Base::integer, 2)},
    {"ivec3", vector(Base::integer, 3)},
    {"ivec4", vector(Base::integer, 4)},
    {"uvec2", vector(Base::natural, 2)},
    {"uvec3", vector(Base::natural, 3)},
    {"uvec4", vector(Base::natural, 4)},
    {"bvec2", vector(Base::boolean, 2)},
    {"bvec3", vector(Base::boolean, 3)},
    {"bvec4", vector(Base::boolean, 4)},
    {"mat2", matrix(2)},
    {"mat3", matrix(3)},
    {"mat4", matrix(4)},
    {"mat2x2", matrix(2)},
    {"mat3x3", matrix(3)},
    {"mat4x4", matrix(4)},
    {"sampler1D", sampler(1)},
    {"sampler2D", sampler(2)},
    {"sampler3D", sampler(3)},
    // Read at three numbers as well; without such images nothing tells them apart.
    {"samplerCube", sampler(3)},
    {"sampler2DArray", sampler(3)},
}};

std::string_view scalar_name(Base base) {
  switch (base) {
    case Base::boolean: return "bool";
    case Base::integer: return "int";
    case Base::natural: return "uint";
    case Base::number: return "float";
    default: return "void";
  }
}

std::string element_name(const Type& type) {
  if (type.base == Base::structure) return std::string(type.structure->name);
  if (type.base == Base::sampler) return fmt::format("sampler{}D", type.rows);
  if (type.columns > 1) return fmt::format("mat{}", type.columns);
  if (type.rows == 1) return std::string(scalar_name(type.base));
  std::string_view prefix;
  if (type.base == Base::boolean) prefix = "b";
  if (type.base == Base::integer) prefix = "i";
  if (type.base == Base::natural) prefix = "u";
  return fmt::format("{}vec{}", prefix, type.rows);
}

int element_parts(const Type& type) {
  if (type.base == Base::none || type.base == Base::sampler) return 0;
  return type.base == Base::structure ? type.structure->parts : type.rows * type.columns;
}

}  // namespace

void Struct::add(const Member& member) {
  members.push_back(member);
  const long long sum = parts + static_cast<long long>(part_count(member.type));
  parts = static_cast<int>(std::min<long long>(sum, max_parts));
  if (member.type.base == Base::structure)
    depth = std::max(depth, member.type.structure->depth + 1);
}

int part_count(const Type& type) {
  const long long length = type.is_array() ? type.length : 1;
  return static_cast<int>(std::min<long long>(element_parts(type) * length, max_parts));
}

Base part_base(const Type& type, int index) {
  if (type.base != Base::structure) return type.base;
  const int parts = element_parts(type);
  if (parts == 0) return Base::none;
  index %= parts;
  for (const Struct::Member& member : type.structure->members) {
    const int count = part_count(member.type);
    if (index < count) return part_base(member.type, index);
    index -= count;
  }
  return Base::none;
}

std::string to_string(const Type& type) {
  return type.is_array() ? fmt::format("{}[{}]", element_name(type), type.length)
                         : element_name(type);
}

Type builtin_type(std::string_view name, bool& found) {
  for (const auto& [candidate, type] : builtin_types) {
    found = candidate == name;
    if (found) return type;
  }
  return void_type;
}

}  // namespace nacre::glsl
