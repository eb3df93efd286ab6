#include "jit/glsl/part.h"

namespace nacre::glsl {

namespace {

constexpr std::string_view component_sets[] = {"xyzw", "rgba", "stpq"};

}  // namespace

std::vector<std::size_t> swizzle(std::string_view text, int rows) {
  for (const std::string_view set : component_sets) {
    std::vector<std::size_t> parts;
    for (const char letter : text) {
      const std::size_t at = set.find(letter);
      if (at < static_cast<std::size_t>(rows)) parts.push_back(at);
    }
    if (parts.size() == text.size() && parts.size() <= 4) return parts;
  }
  return {};
}

std::optional<std::pair<std::size_t, Type>> find_member(const Type& type, std::string_view text) {
  std::size_t at = 0;
  for (const Struct::Member& member : type.structure->members) {
    if (member.name == text) return std::pair(at, member.type);
    at += static_cast<std::size_t>(part_count(member.type));
  }
  return std::nullopt;
}

std::optional<Type> element_type(const Type& type) {
  if (type.is_array()) return type.element();
  if (type.is_matrix()) return type.with_rows(type.rows);
  if (type.is_vector()) return type.with_rows(1);
  return std::nullopt;
}

int element_count(const Type& type) {
  if (type.is_array()) return type.length;
  return type.is_matrix() ? type.columns : type.rows;
}

}  // namespace nacre::glsl
