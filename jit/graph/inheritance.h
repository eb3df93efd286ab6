#pragma once

#include <optional>

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Why a node cannot have what it says it inherits from others of its class and scope
/// (Specification, "Shader Nodes"): unknown-nodename, inherit-cycle or inherit-depth.
std::optional<Diagnostic> inheritance_fault(const Element& node);

}  // namespace nacre
