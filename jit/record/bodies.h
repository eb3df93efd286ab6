#pragma once

#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "jit/document/definitions.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// Which nodedefs of the data library run a native body: those of a category in
/// nodes/nodes.txt or pbs/nodes.txt that have no node graph, or whose line says
/// that the body replaces it. A body is made for the ports of the data library's own
/// nodedefs: one of a node pack gets it only where it has the ports of one of those.
class Bodies {
 public:
  /// The body that records a nodedef.
  struct Binding {
    const NodeBody* body = nullptr;  ///< Lives as long as the Bodies.
    const NodeDef* def = nullptr;    ///< What declares the ports.
    bool is_of_host = false;         ///< It came by add().
  };

  /// `library` must outlive it.
  explicit Bodies(const Definitions& library);

  /// Adds or replaces the body of one nodedef. False if there is no such nodedef.
  bool add(const std::string& nodedef, std::function<void(NodeCall&)> record,
           const Definitions& library);

  /// Null: no native body, use the graph.
  const Binding* binding(std::string_view nodedef) const;
  /// Its body alone, or null.
  const NodeBody* find(std::string_view nodedef) const;
  /// Whether it has one.
  bool contains(std::string_view nodedef) const { return binding(nodedef) != nullptr; }

 private:
  std::unordered_map<std::string, Binding> by_nodedef_;
  std::deque<NodeBody> added_;
};

}  // namespace nacre
