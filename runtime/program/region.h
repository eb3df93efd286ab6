#pragma once

#include <cstddef>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

// Of a Program that verify() accepts.

/// The instruction that closes the region which instruction `open` opens.
std::size_t region_end(const Function& function, std::size_t open);

/// region_end() of every region, by the instruction that opens it; 0 for others.
std::vector<std::size_t> region_ends(const Function& function);

}  // namespace nacre
