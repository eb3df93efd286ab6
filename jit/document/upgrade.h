#pragma once

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Checks that `root`, the root of one file before its includes come in, is a
/// MaterialX document, and brings its own elements from version 1.22 or later to
/// 1.39 (the steps are in jit/document/upgrade/). A rewritten element stands where
/// the one that it replaces was written. What has no equivalent in 1.39 is an
/// error. A missing version counts as 1.39, with a warning.
void upgrade(Document& document, Element& root, Diagnostics& diagnostics);

}  // namespace nacre
