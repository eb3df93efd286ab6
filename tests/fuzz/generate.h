#pragma once

#include "tests/fuzz/splice.h"

namespace nacre::fuzz {

/// A document of a few nodes of the data library that read one another where types allow,
/// with outputs, and a material where there is a surface: right but for odd values.
Tree generate(const std::vector<const Tree*>& nodedefs, Random& random);

}  // namespace nacre::fuzz
