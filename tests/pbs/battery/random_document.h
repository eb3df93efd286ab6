#pragma once

#include <cstdint>
#include <string>

namespace nacre {

/// A document whose material M is a shading model or a tree of closures, fed by a random graph of
/// pattern nodes and by values, among them those at which parts are left out: 0 and 1. The graph
/// reads uv0 and P, has no steps and magnifies no rounding; roughnesses are at least 0.2. The same
/// for the same seed.
std::string random_document(std::uint64_t seed);

}  // namespace nacre
