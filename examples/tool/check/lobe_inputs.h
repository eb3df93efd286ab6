#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jit/document/nodedef.h"

namespace nacre::tool {

/// An input as a document gives it a value.
struct LobeInput {
  std::string name, type, value;
};

/// Inputs that a lobe is tried with, those left out at their defaults: first all of them, then what
/// is lowest everywhere, then highest, then drawn ones, half of their numbers at an end. `count` at
/// most; fewer where there is nothing to draw: numbers between uimin and uimax (or the soft ones;
/// colours between 0 and 1), truth values, and strings of an enumeration. The same each time.
std::vector<std::vector<LobeInput>> lobe_inputs(const NodeDef& def, std::size_t count);

/// Numeric inputs that have their defaults in all of these, for the nodedef gives no range.
std::vector<std::string> inputs_without_range(const NodeDef& def);

/// "roughness=0.5 color=0, 1, 0"; "defaults".
std::string to_string(const std::vector<LobeInput>& inputs);

}  // namespace nacre::tool
