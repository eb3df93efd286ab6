#pragma once

#include "jit/document/document.h"
#include "jit/document/library.h"
#include "jit/graph/build/build.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Finds what is wrong with a whole document, including what no output depends
/// on: every instance must have a nodedef, every port a source that exists and
/// a value that fits; graphs must fit the nodedefs they implement; then every
/// output, material and loose shader is built. Each fault is reported once.
/// True if there is no error; warnings do not count.
bool check_document(const Document& document, const Library& library, const GraphOptions& options,
                    Diagnostics& diagnostics);

}  // namespace nacre
