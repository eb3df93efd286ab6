#include "jit/shading/unfit_patterns.h"

#include <algorithm>
#include <span>

#include "jit/record/leaves.h"
#include "jit/record/pattern.h"

namespace nacre {

namespace {

/// Whether a pattern is of an input of a node that the graph has: that has no such parameter then,
/// whatever else the document holds.
bool names_input_of(const Graph& graph, const std::string& pattern) {
  const std::size_t slash = pattern.rfind('/');
  if (slash == std::string::npos) return false;
  const std::string_view owner = std::string_view(pattern).substr(0, slash);
  return std::ranges::any_of(graph.nodes,
                             [&](const GraphNode& each) { return each.path == owner; }) ||
         std::ranges::any_of(graph.parameters, [&](const Parameter& each) {
           return std::string_view(each.path).substr(0, each.path.rfind('/')) == owner;
         });
}

/// Whether a pattern that fits no parameter of the graph may be of another material or output.
bool may_be_elsewhere(const std::string& pattern, const Graph& graph, DocumentInputs& document) {
  return !names_input_of(graph, pattern) && document.any_fits(pattern);
}

}  // namespace

std::vector<std::string> unfit_live(const std::vector<std::string>& live, const Graph& graph,
                                    DocumentInputs& document) {
  std::vector<std::string> unfit;
  for (const std::string& pattern : live) {
    const bool is_fit = std::ranges::any_of(graph.parameters, [&](const Parameter& parameter) {
      return !is_text(parameter.type) && fits_pattern(parameter.path, pattern);
    });
    if (!is_fit && !may_be_elsewhere(pattern, graph, document)) unfit.push_back(pattern);
  }
  return unfit;
}

std::vector<std::string> unfit_varying(const std::vector<std::string>& varying, const Graph& graph,
                                       const RecordOptions& options, DocumentInputs& document) {
  std::vector<std::string> unfit;
  for (const std::string& pattern : varying) {
    if (pattern.find('/') == std::string::npos) continue;
    bool fits_frozen = false, fits_live = false;
    for (const Parameter& parameter : graph.parameters) {
      if (!fits_slot(parameter.path, parameter.type, pattern)) continue;
      (is_live(parameter, options) ? fits_live : fits_frozen) = true;
    }
    if (fits_live) continue;
    if (fits_frozen || !may_be_elsewhere(pattern, graph, document)) unfit.push_back(pattern);
  }
  return unfit;
}

}  // namespace nacre
