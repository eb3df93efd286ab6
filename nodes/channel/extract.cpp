#include <algorithm>
#include <utility>

#include "runtime/node/node_call.h"

namespace nacre {

/// One component of a colour or vector, or one row of a matrix. MaterialX 1.39
/// Standard Nodes, "extract". An index out of range counts as the nearest one. What
/// is chosen passes as it is, NaN too.
void record_extract(NodeCall& call) {
  const std::vector<Ref>& parts = call.in("in").parts;
  const auto width = static_cast<std::size_t>(component_count(call.out_type()));
  const auto count = static_cast<std::int32_t>(parts.size() / width);
  const Int index = call.integer("index");
  std::vector<Ref> result;
  for (std::size_t column = 0; column < width; ++column) {
    const auto entry = [&](std::int32_t k) {
      return Float(parts[static_cast<std::size_t>(k) * width + column]);
    };
    if (index.is_constant()) {
      result.push_back(entry(std::clamp(index.constant(), 0, count - 1)).ref());
      continue;
    }
    Float chosen = entry(count - 1);
    for (std::int32_t k = count - 2; k >= 0; --k) chosen = select(index <= k, entry(k), chosen);
    result.push_back(chosen.ref());
  }
  call.set(std::move(result));
}

}  // namespace nacre
