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

std::vector<std::size_t> region_ends(const Function& function) {
  std::vector<std::size_t> ends(function.code.size(), 0);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    if (opens_region(function.code[i].op)) open.push_back(i);
    if (!closes_region(function.code[i].op)) continue;
    ends[open.back()] = i;
    open.pop_back();
  }
  return ends;
}

}  // namespace nacre
