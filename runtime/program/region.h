#pragma once

#include <cstddef>

#include "runtime/program/program.h"

namespace nacre {

/// The instruction that closes the region which instruction `open` opens; the Program is
/// one that verify() accepts.
std::size_t region_end(const Function& function, std::size_t open);

}  // namespace nacre
