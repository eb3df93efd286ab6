#pragma once

#include <string>
#include <vector>

#include "jit/graph/graph.h"
#include "jit/record/record.h"
#include "jit/shading/document_inputs.h"

namespace nacre {

/// Patterns of ShaderOptions::live that fit no parameter of the graph, and no input of its
/// document, of whose parameters another material may have those that this one has not. But an
/// input of a node of the graph is one of its parameters, or linked, or a typing error.
std::vector<std::string> unfit_live(const std::vector<std::string>& live, const Graph& graph,
                                    DocumentInputs& document);

/// The same of ShaderOptions::varying; those, too, of parameters that are not live. Others than
/// parameters have no slash in their names, and need not be there.
std::vector<std::string> unfit_varying(const std::vector<std::string>& varying, const Graph& graph,
                                       const RecordOptions& options, DocumentInputs& document);

}  // namespace nacre
