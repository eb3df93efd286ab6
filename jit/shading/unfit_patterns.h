#pragma once

#include <string>
#include <vector>

#include "jit/document/document.h"
#include "jit/graph/graph.h"
#include "jit/record/record.h"

namespace nacre {

/// Those of the patterns that fit no element of the document, and none below one: of a document's
/// parameters another of its materials may have those that this one has not.
std::vector<std::string> patterns_of_nothing(const std::vector<std::string>& patterns,
                                             const Document& document);

/// Patterns of ShaderOptions::live that fit no parameter of the graph: those of nothing, and those
/// of an input of one of its nodes that has none (it is linked, or there is no such input).
std::vector<std::string> unfit_live(const std::vector<std::string>& live,
                                    const std::vector<std::string>& of_nothing, const Graph& graph);

/// The same of ShaderOptions::varying; those, too, of parameters that are not live. Others than
/// parameters have no slash in their names, and need not be there.
std::vector<std::string> unfit_varying(const std::vector<std::string>& varying,
                                       const std::vector<std::string>& of_nothing,
                                       const Graph& graph, const RecordOptions& options);

}  // namespace nacre
