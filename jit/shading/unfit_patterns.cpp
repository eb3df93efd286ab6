#include "jit/shading/unfit_patterns.h"

#include <algorithm>
#include <span>

#include "jit/record/leaves.h"
#include "jit/record/pattern.h"

namespace nacre {

namespace {

bool fits(const std::string& name, const std::string& pattern) {
  return fits_any(name, {&pattern, 1});
}

/// Whether an element is what the pattern may be of, or one that is in it.
bool has_fitting(const Element& element, const std::string& path, const std::string& pattern) {
  for (const Element& child : element.children()) {
    const std::string own =
        path.empty() ? std::string(child.name()) : path + '/' + std::string(child.name());
    // What nobody wrote has no element: its node has.
    if (fits(own, pattern) || fits(own, pattern.substr(0, pattern.rfind('/')))) return true;
    if (has_fitting(child, own, pattern)) return true;
  }
  return false;
}

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

/// Of a parameter, or of one of its components.
bool fits_parameter(const Parameter& parameter, const std::string& pattern) {
  if (fits(parameter.path, pattern)) return true;
  const int count = component_count(parameter.type);
  for (int i = 0; i < count; ++i) {
    if (fits(slot_name(parameter.path, i, count), pattern)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> patterns_of_nothing(const std::vector<std::string>& patterns,
                                             const Document& document) {
  std::vector<std::string> of_nothing;
  for (const std::string& pattern : patterns) {
    if (!has_fitting(document.root(), {}, pattern)) of_nothing.push_back(pattern);
  }
  return of_nothing;
}

std::vector<std::string> unfit_live(const std::vector<std::string>& live,
                                    const std::vector<std::string>& of_nothing,
                                    const Graph& graph) {
  std::vector<std::string> unfit;
  for (const std::string& pattern : live) {
    const bool is_of_nothing = std::ranges::find(of_nothing, pattern) != of_nothing.end();
    if (!is_of_nothing && !names_input_of(graph, pattern)) continue;
    const bool is_fit = std::ranges::any_of(graph.parameters, [&](const Parameter& parameter) {
      return fits(parameter.path, pattern);
    });
    if (!is_fit) unfit.push_back(pattern);
  }
  return unfit;
}

std::vector<std::string> unfit_varying(const std::vector<std::string>& varying,
                                       const std::vector<std::string>& of_nothing,
                                       const Graph& graph, const RecordOptions& options) {
  std::vector<std::string> unfit;
  for (const std::string& pattern : varying) {
    bool fits_frozen = false, fits_live = false;
    for (const Parameter& parameter : graph.parameters) {
      if (!fits_parameter(parameter, pattern)) continue;
      (is_live(parameter, options) ? fits_live : fits_frozen) = true;
    }
    const bool may_be_elsewhere = pattern.find('/') == std::string::npos ||
                                  (std::ranges::find(of_nothing, pattern) == of_nothing.end() &&
                                   !names_input_of(graph, pattern));
    if (!fits_live && (fits_frozen || !may_be_elsewhere)) unfit.push_back(pattern);
  }
  return unfit;
}

}  // namespace nacre
