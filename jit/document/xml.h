#pragma once

#include <cstdint>
#include <string_view>

#include "jit/document/document.h"
#include "jit/document/read.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Parses a file that `document` holds, in place, and returns its root element,
/// which is not linked to anything yet; `text` is the same once more, for what is
/// to be said about it. Null after an error. UTF-8 only; document type declarations
/// are refused, so there are no entities to expand.
Element* parse_xml(Document& document, std::uint16_t file, std::string_view text,
                   const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace nacre
