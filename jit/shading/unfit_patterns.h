#pragma once

#include <string>
#include <vector>

#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/graph/graph.h"
#include "jit/record/record.h"

namespace nacre {

/// Patterns of ShaderOptions::live that fit no parameter of the graph, and no input of its document
/// (null: it has none), of whose parameters another material may have those that this one has not.
/// But an input of a node of the graph is one of its parameters, or linked, or a typing error.
/// `library`: what nodes have, whether written or not, together with the document's definitions.
std::vector<std::string> unfit_live(const std::vector<std::string>& live, const Graph& graph,
                                    const Document* document, const Definitions& library);

/// The same of ShaderOptions::varying; those, too, of parameters that are not live. Others than
/// parameters have no slash in their names, and need not be there.
std::vector<std::string> unfit_varying(const std::vector<std::string>& varying, const Graph& graph,
                                       const RecordOptions& options, const Document* document,
                                       const Definitions& library);

}  // namespace nacre
