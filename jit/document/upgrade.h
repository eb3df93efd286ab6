#pragma once

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Checks that `root`, the root of one file before its includes come in, is a
/// MaterialX document, and brings its own elements to version 1.39.
///
/// Now: a document of an older version is taken as it is if it uses nothing
/// that changed since; each element that would have to be rewritten is an
/// error. A missing version counts as 1.39, with a warning.
void upgrade(Document& document, Element& root, Diagnostics& diagnostics);

}  // namespace nacre
