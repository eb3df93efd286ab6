#include "runtime/type.h"

#include <array>
#include <cstddef>

namespace nacre {

namespace {

struct TypeRow {
  std::string_view name;
  int components;
};

// In the order of the enumeration.
constexpr std::array<TypeRow, 31> rows{{
    {"none", 0},         {"boolean", 1},     {"integer", 1},       {"float", 1},
    {"color3", 3},       {"color4", 4},      {"vector2", 2},       {"vector3", 3},
    {"vector4", 4},      {"matrix33", 9},    {"matrix44", 16},     {"string", 0},
    {"filename", 0},     {"geomname", 0},    {"integerarray", 0},  {"floatarray", 0},
    {"color3array", 0},  {"color4array", 0}, {"vector2array", 0},  {"vector3array", 0},
    {"vector4array", 0}, {"stringarray", 0}, {"geomnamearray", 0}, {"BSDF", 0},
    {"EDF", 0},          {"VDF", 0},         {"surfaceshader", 0}, {"displacementshader", 0},
    {"volumeshader", 0}, {"lightshader", 0}, {"material", 0},
}};
static_assert(rows.size() == static_cast<std::size_t>(Type::material) + 1);

const TypeRow& row(Type type) { return rows[static_cast<std::size_t>(type)]; }

}  // namespace

std::string_view type_name(Type type) { return row(type).name; }

std::optional<Type> parse_type(std::string_view name) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].name == name) return static_cast<Type>(i);
  }
  return std::nullopt;
}

int component_count(Type type) { return row(type).components; }

bool is_text(Type type) {
  return type == Type::string || type == Type::filename || type == Type::geomname;
}

bool is_array(Type type) { return type >= Type::integer_array && type <= Type::geomname_array; }

bool is_closure(Type type) { return type == Type::bsdf || type == Type::edf || type == Type::vdf; }

}  // namespace nacre
