#pragma once

#include "jit/document/element.h"

namespace nacre {

/// True if both say the same: category, name, attributes in any order, and children in
/// theirs. Where they were written does not count.
bool same_content(const Element& a, const Element& b);

}  // namespace nacre
