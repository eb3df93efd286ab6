#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "jit/document/definitions.h"
#include "jit/document/document.h"
#include "jit/record/record.h"

namespace nacre {

/// Whether a pattern is of a slot or of one of its components: "node/in", "node/in.x".
bool fits_slot(const std::string& name, Type type, const std::string& pattern);

/// The inputs of a document's nodes that may be parameters, by their paths: those that are written,
/// and those that only their definitions have; of nodes within the graph that implements a node,
/// too, below that one's path. Nothing is looked up before somebody asks.
class DocumentInputs {
 public:
  /// `library`: what the document's definitions stand on. `document` may be null: it has none.
  DocumentInputs(const Document* document, const Definitions& library)
      : document_(document), library_(library) {}

  /// Whether one of them fits a pattern, or nothing is known of a node that the pattern may be of.
  bool any_fits(const std::string& pattern);

 private:
  using Inputs = std::map<std::string, Type>;

  void collect(const Element& element, const std::string& path);
  const Inputs& inputs_of(const NodeDef& def, int level);

  const Document* document_;
  const Definitions& library_;
  Diagnostics known_;  ///< Building the graph has said them.
  std::optional<Definitions> definitions_;
  Inputs inputs_;
  std::vector<std::string> unknown_nodes_;
  std::unordered_map<const NodeDef*, Inputs> of_defs_;  ///< Relative to the node.
  bool is_cut_ = false;  ///< There are more, of which nothing is known.
};

}  // namespace nacre
