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
/// that the body replaces it.
class Bodies {
 public:
  explicit Bodies(const Definitions& library);

  /// Adds or replaces the body of one nodedef. False if there is no such nodedef.
  bool add(const std::string& nodedef, std::function<void(NodeCall&)> record,
           const Definitions& library);

  /// Null: no native body, use the graph.
  const NodeBody* find(std::string_view nodedef) const;
  bool contains(std::string_view nodedef) const { return find(nodedef) != nullptr; }

 private:
  std::unordered_map<std::string, const NodeBody*> by_nodedef_;
  std::deque<NodeBody> added_;
};

}  // namespace nacre
