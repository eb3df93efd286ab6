#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "jit/shading/shading_system.h"

namespace nacre {

/// Something that speed is traded by: one file in jit/tune/dimensions, one line in its list.
struct Dimension {
  std::string_view name;  ///< As profiles have it: "accuracy".
  std::string_view what;  ///< For people.
  /// By name, from the most exact to the cheapest.
  std::span<const std::string_view> settings;
  /// How a setting is asked for.
  void (*apply)(std::size_t setting, ShaderOptions& options);
};

/// All, by name.
std::span<const Dimension> dimensions();

}  // namespace nacre
