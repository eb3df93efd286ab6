#pragma once

#include <set>
#include <string>
#include <vector>

#include "jit/graph/graph.h"
#include "runtime/diagnostic.h"
#include "runtime/program/program.h"

namespace nacre::tool {

/// A node that reads something of a surface, or an output in which who does is unknown.
struct GeometryRead {
  std::string group;     ///< Of channels (runtime/node/geometry.h): "P", "wo", "geomprop.wear".
  std::string path;      ///< Of the node, GraphNode::path.
  SourceLocation where;  ///< Of the node.
};

/// The groups of channels that a kernel reads, derivatives as what they are of: "P" for "dPdx.y".
std::set<std::string> groups_read(const Program& program);

/// Who reads these groups, in the graph's order, and at `output` those that no node is known of.
std::vector<GeometryRead> geometry_reads(const Graph& graph, const std::set<std::string>& groups,
                                         const SourceLocation& output);

/// What a group is: "position", "geometric property 'wear'".
std::string attribute_name(const std::string& group);

}  // namespace nacre::tool
