#pragma once

#include <string>
#include <vector>

#include "runtime/program/slice.h"
#include "runtime/value/vector.h"

namespace nacre {

/// "<name>.x", ".y" and ".z".
inline void add_color(std::vector<SliceOutput>& outputs, const std::string& name, Float3 v) {
  outputs.push_back({name + ".x", v.x.ref()});
  outputs.push_back({name + ".y", v.y.ref()});
  outputs.push_back({name + ".z", v.z.ref()});
}

}  // namespace nacre
