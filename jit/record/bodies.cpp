#include "jit/record/bodies.h"

#include <algorithm>

#include "nodes/nodes.h"
#include "pbs/closure_nodes.h"

namespace nacre {

namespace {

bool makes_closure(const NodeDef& def) {
  return std::any_of(def.outputs.begin(), def.outputs.end(), [](const NodeDefOutput& output) {
    return is_closure(output.type) || output.type == Type::surfaceshader ||
           output.type == Type::displacementshader || output.type == Type::volumeshader ||
           output.type == Type::lightshader || output.type == Type::material;
  });
}

const NodeBody* of_category(const std::vector<NodeBody>& bodies, std::string_view category) {
  const auto found = std::find_if(bodies.begin(), bodies.end(),
                                  [&](const NodeBody& body) { return body.category == category; });
  return found == bodies.end() ? nullptr : &*found;
}

}  // namespace

Bodies::Bodies(const Definitions& library) {
  for (const NodeDef* def : library.all()) {
    const auto& bodies = makes_closure(*def) ? closure_nodes() : standard_nodes();
    const NodeBody* body = of_category(bodies, def->category);
    if (body == nullptr) continue;
    if (library.graph_of(*def) != nullptr && !body->replaces_graphs) continue;
    by_nodedef_.emplace(def->name, body);
  }
}

bool Bodies::add(const std::string& nodedef, std::function<void(NodeCall&)> record,
                 const Definitions& library) {
  const NodeDef* def = library.nodedef(nodedef);
  if (def == nullptr) return false;
  added_.push_back({def->category, std::move(record), true});
  by_nodedef_[nodedef] = &added_.back();
  return true;
}

const NodeBody* Bodies::find(std::string_view nodedef) const {
  const auto found = by_nodedef_.find(std::string(nodedef));
  return found == by_nodedef_.end() ? nullptr : found->second;
}

}  // namespace nacre
