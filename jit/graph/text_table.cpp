#include "jit/graph/text_table.h"

#include <algorithm>
#include <utility>

#include "runtime/program/digest.h"

namespace nacre {

TableValues::TableValues(std::vector<float> values)
    : values_(std::move(values)), digest_(to_hex(nacre::digest(values_))) {}

bool is_whole(const TextTable& table) {
  constexpr std::size_t most = std::size_t{1} << 28;
  if (table.values == nullptr || table.channels < 1 || table.channels > 4) return false;
  std::size_t count = table.channels;
  for (const std::size_t size : table.size) {
    if (size < 1 || size > most / count) return false;
    count *= size;
  }
  return table.values->values().size() == count;
}

}  // namespace nacre
