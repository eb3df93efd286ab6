#include "jit/record/text_ports.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nacre {

namespace {

int enum_index(const NodeText& source, std::string_view input, const std::string& text) {
  for (const auto& [name, values] : source.enums) {
    const auto found = std::find(values.begin(), values.end(), text);
    if (name == input && found != values.end()) return static_cast<int>(found - values.begin());
  }
  return 0;
}

glsl::Value value_of(const NodeText& source, const NodeCall::Port& port) {
  glsl::Value value{glsl_type(port.value.type), port.value.parts, {}};
  if (port.value.type == Type::filename) {
    value.text = port.value.text;
  } else if (is_text(port.value.type)) {
    value.parts = {Ref::literal(enum_index(source, port.name, port.value.text))};
  }
  return value;
}

/// Of member `i` of both structures; `path` names the structure, "" or "a.".
std::optional<SourceMisfit> member_misfit(const glsl::Struct& port, const glsl::Struct& found,
                                          std::size_t i, const std::string& path);

std::optional<SourceMisfit> structure_misfit(const glsl::Type& port, const glsl::Type& found,
                                             const std::string& path) {
  if (found.base != glsl::Base::structure || found.is_array()) {
    std::string members;
    for (const glsl::Struct::Member& member : port.structure->members) {
      const bool is_structure = member.type.base == glsl::Base::structure;
      members += fmt::format("{}{} {}", members.empty() ? "" : "; ",
                             is_structure ? "struct" : to_string(member.type), member.name);
    }
    return SourceMisfit{fmt::format("a structure {{ {} }}", members), to_string(found)};
  }
  const std::size_t count =
      std::max(port.structure->members.size(), found.structure->members.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (auto misfit = member_misfit(*port.structure, *found.structure, i, path)) return misfit;
  }
  return std::nullopt;
}

std::string described(const glsl::Struct& type, std::size_t i, const std::string& path) {
  if (i >= type.members.size()) return "no more members";
  const glsl::Struct::Member& member = type.members[i];
  const bool is_structure = member.type.base == glsl::Base::structure;
  return fmt::format("{} {}{}", is_structure ? "a structure" : to_string(member.type), path,
                     member.name);
}

std::optional<SourceMisfit> member_misfit(const glsl::Struct& port, const glsl::Struct& found,
                                          std::size_t i, const std::string& path) {
  SourceMisfit misfit{described(port, i, path), described(found, i, path)};
  if (i >= port.members.size() || i >= found.members.size()) return misfit;
  const glsl::Struct::Member& wanted = port.members[i];
  const glsl::Struct::Member& member = found.members[i];
  if (wanted.type.base == glsl::Base::sampler) {
    return SourceMisfit{"no file name in a structure", misfit.expected};
  }
  if (wanted.name != member.name) return misfit;
  if (wanted.type.base == glsl::Base::structure) {
    return structure_misfit(wanted.type, member.type, fmt::format("{}{}.", path, wanted.name));
  }
  return wanted.type == member.type ? std::nullopt : std::optional(misfit);
}

}  // namespace

glsl::Type glsl_type(Type type) {
  const auto vector = [](int rows) { return glsl::float_type.with_rows(rows); };
  switch (type) {
    case Type::boolean: return glsl::bool_type;
    case Type::integer: return glsl::int_type;
    case Type::float_: return glsl::float_type;
    case Type::vector2: return vector(2);
    case Type::color3:
    case Type::vector3: return vector(3);
    case Type::color4:
    case Type::vector4: return vector(4);
    case Type::matrix33: return {glsl::Base::number, 3, 3};
    case Type::matrix44: return {glsl::Base::number, 4, 4};
    case Type::filename: return {glsl::Base::sampler, 2};
    case Type::string:
    case Type::geomname: return glsl::int_type;
    default: return glsl::void_type;
  }
}

TextPorts::TextPorts(const NodeText& source, const std::vector<NodeCall::Port>& ports) {
  Members members;
  for (const NodeCall::Port& port : ports) members.emplace_back(port.name, value_of(source, port));
  for (std::size_t first = 0; first < members.size();) {
    const std::string head = members[first].first.substr(0, members[first].first.find('.'));
    std::size_t end = first + 1;
    while (end < members.size() && members[end].first.starts_with(head + '.')) ++end;
    const bool is_whole = members[first].first == head;
    ports_.push_back(
        {head,
         is_whole ? members[first].second : structure_of(members, first, end, head.size() + 1),
         first, end - first});
    first = end;
  }
}

/// Members [first, end), whose paths agree in their first `skip` letters.
glsl::Value TextPorts::structure_of(const Members& members, std::size_t first, std::size_t end,
                                    std::size_t skip) {
  glsl::Struct& made = types_.emplace_back();
  glsl::Value result{{glsl::Base::structure}, {}, {}};
  result.type.structure = &made;
  while (first < end) {
    const std::string& path = members[first].first;
    const std::size_t dot = path.find('.', skip);
    std::size_t next = first + 1;
    glsl::Value value = members[first].second;
    if (dot != std::string::npos) {
      while (next < end && members[next].first.starts_with(path.substr(0, dot + 1))) ++next;
      value = structure_of(members, first, next, dot + 1);
    }
    const std::string& name = names_.emplace_back(path.substr(skip, dot - skip));
    made.add({name, value.type});
    result.parts.insert(result.parts.end(), value.parts.begin(), value.parts.end());
    first = next;
  }
  return result;
}

std::optional<SourceMisfit> find_misfit(const glsl::Type& port, const glsl::Type& found) {
  if (port.base == glsl::Base::structure) return structure_misfit(port, found, "");
  if (port == found) return std::nullopt;
  return SourceMisfit{to_string(port), to_string(found)};
}

}  // namespace nacre
