/// \file
/// Colour spaces that a host defines: part of <nacre/nacre.hpp>.
#ifndef NACRE_COLORS_HPP
#define NACRE_COLORS_HPP

#include <nacre/nacre.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {

/// A space that was found by some name of it.
struct ColorSpace {
  std::string name;  ///< Its own; "": there is none.
  bool is_data = false;
};

/// Numbers that a transform looks up; see nacre_color_table.
struct ColorTable {
  std::string name;
  std::array<std::size_t, 3> extent{1, 1, 1};
  std::size_t channels = 3;
  bool is_nearest = false;
  std::vector<float> values;
};

/// How colours of one space become those of another; see nacre_color_transform.
struct ColorTransform {
  std::string text;      ///< GLSL; "": there is none.
  std::string function;  ///< `vec4 function(vec4 rgba)`
  std::vector<ColorTable> tables;
};

/// Colour spaces of the host's own, for SystemOptions::colors. Members may be called by several
/// threads at once. What they throw counts as nothing found.
class Colors {
 public:
  virtual ~Colors() = default;
  virtual std::string name() const = 0;  ///< For diagnostics.
  virtual ColorSpace find(const std::string& name) const = 0;
  virtual ColorTransform transform(const std::string& from, const std::string& to) const = 0;
};

namespace detail {

/// What a thread was given last stays until it asks again.
template <class T>
T& kept_by_thread() {
  static thread_local T kept;
  return kept;
}

struct KeptTransform {
  ColorTransform transform;
  std::vector<nacre_color_table> tables;
};

inline int find_color_space(void* user, const char* name, nacre_color_space* space) {
  try {
    std::string& kept = kept_by_thread<std::string>();
    const ColorSpace found = (*static_cast<std::shared_ptr<const Colors>*>(user))->find(name);
    kept = found.name;
    space->name = kept.c_str();
    space->is_data = found.is_data;
    return !kept.empty();
  } catch (...) {
    return 0;
  }
}

inline int find_color_transform(void* user, const char* from, const char* to,
                                nacre_color_transform* transform) {
  try {
    KeptTransform& kept = kept_by_thread<KeptTransform>();
    kept.transform = (*static_cast<std::shared_ptr<const Colors>*>(user))->transform(from, to);
    kept.tables.clear();
    for (const ColorTable& table : kept.transform.tables) {
      std::size_t numbers = table.channels;
      for (const std::size_t extent : table.extent) numbers *= extent;
      if (table.values.size() != numbers) return 0;
      nacre_color_table one{};
      one.size = sizeof one;
      one.name = table.name.c_str();
      for (std::size_t axis = 0; axis < 3; ++axis) one.extent[axis] = table.extent[axis];
      one.channels = table.channels;
      one.is_nearest = table.is_nearest;
      one.values = table.values.data();
      kept.tables.push_back(one);
    }
    transform->text = kept.transform.text.c_str();
    transform->function = kept.transform.function.c_str();
    transform->tables = kept.tables.data();
    transform->table_count = kept.tables.size();
    return !kept.transform.text.empty();
  } catch (...) {
    return 0;
  }
}

/// As the C interface takes them; `name` must live as long as the call.
inline nacre_colors colors_of(const std::shared_ptr<const Colors>& colors,
                              const std::string& name) {
  nacre_colors made{};
  made.size = sizeof made;
  made.name = name.c_str();
  made.user = new std::shared_ptr<const Colors>(colors);
  made.find = find_color_space;
  made.transform = find_color_transform;
  made.destroy = [](void* user) { delete static_cast<std::shared_ptr<const Colors>*>(user); };
  return made;
}

}  // namespace detail

}  // namespace v0
}  // namespace nacre

#endif
