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

/// Of a parameter or an input, or of one of its components.
bool fits_slot(const std::string& name, Type type, const std::string& pattern) {
  if (fits(name, pattern)) return true;
  const int count = component_count(type);
  for (int i = 0; i < count; ++i) {
    if (fits(slot_name(name, i, count), pattern)) return true;
  }
  return false;
}

/// Whether a document has an input that the pattern may be of: also one that nobody wrote, which
/// has no element of its own, but is in the node's definition.
class InputSearch {
 public:
  InputSearch(const Document& document, const Definitions& library, const std::string& pattern)
      : definitions_(document, &library, known_), pattern_(pattern) {}

  bool finds_in(const Element& element, const std::string& path) const {
    for (const Element& child : element.children()) {
      const std::string own =
          path.empty() ? std::string(child.name()) : path + '/' + std::string(child.name());
      if (fits(own, pattern_) || has_input(child, own) || finds_in(child, own)) return true;
    }
    return false;
  }

 private:
  bool has_input(const Element& element, const std::string& path) const {
    const std::string_view category = element.category();
    const std::vector<const NodeDef*> defs = definitions_.of_category(category);
    if (defs.empty()) {
      // No node, or one that nothing is known of.
      const bool may_be =
          !element.attribute("type").empty() && category != "input" && category != "output";
      return may_be && fits(path, pattern_.substr(0, pattern_.rfind('/')));
    }
    return std::ranges::any_of(defs, [&](const NodeDef* def) {
      return std::ranges::any_of(def->inputs, [&](const NodeDefInput& input) {
        return fits_slot(path + '/' + std::string(input.name), input.type, pattern_);
      });
    });
  }

  Diagnostics known_;  ///< Building the graph has said them.
  Definitions definitions_;
  std::string pattern_;
};

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
bool may_be_elsewhere(const std::string& pattern, const Graph& graph, const Document* document,
                      const Definitions& library) {
  if (document == nullptr || names_input_of(graph, pattern)) return false;
  return InputSearch(*document, library, pattern).finds_in(document->root(), {});
}

}  // namespace

std::vector<std::string> unfit_live(const std::vector<std::string>& live, const Graph& graph,
                                    const Document* document, const Definitions& library) {
  std::vector<std::string> unfit;
  for (const std::string& pattern : live) {
    const bool is_fit = std::ranges::any_of(graph.parameters, [&](const Parameter& parameter) {
      return !is_text(parameter.type) && fits(parameter.path, pattern);
    });
    if (!is_fit && !may_be_elsewhere(pattern, graph, document, library)) unfit.push_back(pattern);
  }
  return unfit;
}

std::vector<std::string> unfit_varying(const std::vector<std::string>& varying, const Graph& graph,
                                       const RecordOptions& options, const Document* document,
                                       const Definitions& library) {
  std::vector<std::string> unfit;
  for (const std::string& pattern : varying) {
    if (pattern.find('/') == std::string::npos) continue;
    bool fits_frozen = false, fits_live = false;
    for (const Parameter& parameter : graph.parameters) {
      if (!fits_slot(parameter.path, parameter.type, pattern)) continue;
      (is_live(parameter, options) ? fits_live : fits_frozen) = true;
    }
    if (fits_live) continue;
    if (fits_frozen || !may_be_elsewhere(pattern, graph, document, library))
      unfit.push_back(pattern);
  }
  return unfit;
}

}  // namespace nacre
