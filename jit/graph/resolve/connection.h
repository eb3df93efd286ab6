#pragma once

#include "jit/document/element.h"
#include "jit/graph/complaints.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// What an <input> or <output> element says it is fed by (Specification,
/// "Inputs": exactly one of value, nodename, nodegraph, interfacename).
struct Connection {
  enum class Kind {
    none,       ///< Nothing is said.
    value,      ///< The element's `value`.
    node,       ///< Output `output` of node `target`; "" for its only one.
    output,     ///< The <output> `target` of a node graph or of the document.
    interface,  ///< Input `output` of the graph around it.
    invalid,    ///< Already reported.
  };
  Kind kind = Kind::none;
  const Element* target = nullptr;
  std::string_view output;
};

/// Looks up the names in a port: the nodes and graphs beside the node, graph or
/// output that the port belongs to; graphs and outputs also at the root.
/// `lenient`: of several outputs of a graph the first, with a warning, where none is named.
Connection find_connection(const Element& port, Diagnostics& diagnostics, bool lenient = false);

/// The same, as strict as `complaints` are; a warning about a port is given once.
Connection find_connection(const Element& port, Complaints& complaints);

/// The element whose children a port's `nodename` names.
const Element& scope_of(const Element& port);

/// The nearest node graph around an element, or the root; of the root itself.
const Element& enclosing_graph(const Element& element);

}  // namespace nacre
