#pragma once

#include <string_view>

#include "jit/document/definitions.h"
#include "jit/document/element.h"
#include "jit/graph/complaints.h"
#include "jit/graph/resolve/connection.h"

namespace nacre {

/// What an input comes from, once the interfaces of the graphs around it are followed outwards.
struct Feed {
  /// The port that says it: the one asked about, or an <input> of a graph around it, or of the
  /// nodedef that such a graph implements.
  const Element* port = nullptr;
  /// The port that names it by `interfacename`; `port` itself where none does.
  const Element* reader = nullptr;
  /// What `port` says: anything but an interface.
  Connection connection;
};

/// Every graph stands for itself here, not for a node that it implements.
Feed find_feed(const Element& port, const Definitions& definitions, Complaints& complaints);

/// The same, through outputs of graphs too: to a node, or to where a value stands or nothing.
Feed find_source_node(const Element& port, const Definitions& definitions, Complaints& complaints);

/// The <input> of a compound graph, or of the document, that `interfacename` names in it; null if
/// there is none.
const Element* find_interface(const Element& graph, std::string_view name);

/// What stands for an interface that there is not, which is said: an error, or with
/// GraphOptions::lenient, for a node's input, its own value (where `takes_value`) or nothing.
Connection without_interface(const Element& port, bool takes_value, Complaints& complaints);

}  // namespace nacre
