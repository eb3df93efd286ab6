#include "runtime/program/region.h"

namespace nacre {

std::size_t region_end(const Function& function, std::size_t open) {
  std::size_t i = open;
  for (int depth = 1; depth > 0;) {
    ++i;
    if (opens_region(function.code[i].op)) ++depth;
    if (closes_region(function.code[i].op)) --depth;
  }
  return i;
}

}  // namespace nacre
