#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "jit/document/element.h"

namespace nacre {

/// Numbers elements so that two have the same number if and only if each leads to the
/// other: what includes itself, directly or not, has the number of what it includes.
/// Strongly connected components (Tarjan, SIAM J. Comput. 1 (1972) 146), in linear time
/// and without recursion. `leads_to` is asked once for each element.
std::unordered_map<const Element*, std::size_t> find_circles(
    std::span<const Element* const> elements,
    const std::function<std::vector<const Element*>(const Element&)>& leads_to);

}  // namespace nacre
