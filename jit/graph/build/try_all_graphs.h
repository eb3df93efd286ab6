#pragma once

#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/graph/options.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Builds all nodes, outputs and materials for the sake of the diagnostics, those that
/// nothing reads too. In a sound document only: it meets each fault again.
void try_all_graphs(const Document& document, const Definitions& definitions,
                    const GraphOptions& options, Diagnostics& diagnostics);

}  // namespace nacre
