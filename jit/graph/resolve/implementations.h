#pragma once

#include <string_view>
#include <unordered_map>

#include "jit/document/definitions.h"
#include "jit/graph/color/color_transforms.h"
#include "jit/graph/complaints.h"
#include "jit/graph/graph.h"
#include "jit/graph/options.h"

namespace nacre {

/// Which nodedef an element is an instance of, and what implements that: a body, the text
/// of an <implementation>, or a node graph.
class Implementations {
 public:
  /// All must outlive it.
  Implementations(const Definitions& definitions, const GraphOptions& options,
                  const ColorTransforms& colors, Complaints& complaints)
      : definitions_(definitions), options_(options), colors_(colors), complaints_(complaints) {}

  /// Null, after an error, for an element that is no instance of anything.
  const NodeDef* nodedef_of(const Element& node);
  const NodeDef* nodedef(std::string_view name) const { return definitions_.nodedef(name); }
  /// What an element's names mean.
  const Definitions& definitions_of(const Element& element) const;

  /// Whether it becomes a node of the Graph, by a body or a text, whatever graph it has.
  bool is_native(const NodeDef& def) const;
  bool runs_text(const NodeDef& def) const;
  /// The text, of a nodedef that `runs_text`.
  NodeText text_of(const NodeDef& def) const;
  const Element* graph_of(const NodeDef& def) const;

  /// Warns of implementations that a document has for a nodedef of the library.
  void say_unused(const NodeDef& def);

 private:
  bool has_body(const NodeDef& def) const;
  bool fits(const Element& node, const NodeDef& def);

  const Definitions& definitions_;
  const GraphOptions& options_;
  const ColorTransforms& colors_;
  Complaints& complaints_;
  std::unordered_map<const Element*, const NodeDef*> nodedefs_;
};

}  // namespace nacre
