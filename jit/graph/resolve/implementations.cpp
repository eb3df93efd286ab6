#include "jit/graph/resolve/implementations.h"

#include <fmt/format.h>

#include "jit/document/inheritance.h"
#include "jit/document/select.h"
#include "jit/graph/resolve/lenient.h"
#include "jit/graph/resolve/node_text.h"

namespace nacre {

bool Implementations::is_native(const NodeDef& def) const {
  // What a material consists of is asked of the node itself, never of a graph.
  if (is_material_category(def.category)) return true;
  return has_body(def) || runs_text(def);
}

bool Implementations::has_body(const NodeDef& def) const {
  const bool has_graph = graph_of(def) != nullptr;
  if (options_.prefer == Preference::graph && has_graph) return false;
  return options_.is_native ? options_.is_native(def.name) : !has_graph;
}

bool Implementations::runs_text(const NodeDef& def) const {
  if (colors_.has_source(def)) return true;
  if (definitions_.text_of(def) == nullptr || !may_be_text(def)) return false;
  // Those of MaterialX's generators are closures of theirs, and those that read images are given
  // more than the nodedef says.
  const bool is_of_generators = is_lobe(def) || (reads_image(def) && has_body(def));
  if (options_.prefer == Preference::source && !is_of_generators) return true;
  return !has_body(def) && graph_of(def) == nullptr;
}

NodeText Implementations::text_of(const NodeDef& def) const {
  auto of_config = colors_.text_of(def);
  return of_config ? std::move(*of_config) : node_text(def, *definitions_.text_of(def));
}

const Element* Implementations::graph_of(const NodeDef& def) const {
  return definitions_of(*def.element).graph_of(def);
}

const Definitions& Implementations::definitions_of(const Element& element) const {
  const Definitions* made_here = colors_.definitions_of(element);
  return made_here != nullptr ? *made_here : definitions_;
}

// A nodedef of the library keeps the library's implementation, and ours.
void Implementations::say_unused(const NodeDef& def) {
  for (const Element* own : definitions_.replacements(def)) {
    const Element* used = runs_text(def)   ? definitions_.text_of(def)
                          : is_native(def) ? nullptr
                                           : graph_of(def);
    if (used != nullptr && &used->document() == &own->document()) return;
    complaints_.warning(
        "ambiguous-implementation", *own,
        fmt::format("'{}' has another implementation, which is used instead", def.name),
        "a nodedef of its own",
        used == nullptr ? "a native node" : fmt::format("'{}'", used->name()));
  }
}

const NodeDef* Implementations::nodedef_of(const Element& node) {
  const auto known = nodedefs_.find(&node);
  if (known != nodedefs_.end()) return known->second;
  const NodeDef* def = find_nodedef(node, definitions_of(node), complaints_.diagnostics(),
                                    complaints_.is_lenient() ? stands_for : nullptr);
  if (def != nullptr && !fits(node, *def)) def = nullptr;
  const std::size_t errors = complaints_.diagnostics().error_count();
  node_inheritance(node, complaints_.diagnostics());
  if (complaints_.diagnostics().error_count() != errors) def = nullptr;
  nodedefs_.emplace(&node, def);
  return def;
}

bool Implementations::fits(const Element& node, const NodeDef& def) {
  if (def.inputs.size() > options_.max_inputs) {
    complaints_.error("too-many-inputs", node, "the node has too many inputs",
                      fmt::format("at most {}", options_.max_inputs),
                      fmt::format("{}", def.inputs.size()));
    return false;
  }
  for (const Element& child : node.children()) {
    if (child.category() != "input" || !child.name().empty()) continue;
    complaints_.error("missing-name", child, "the input has no name", "name=\"NAME\"");
    return false;
  }
  return true;
}

}  // namespace nacre
