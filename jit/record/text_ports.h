#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "jit/glsl/value.h"
#include "jit/graph/graph.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// What a port of that type is in GLSL; void for what no text can hold.
glsl::Type glsl_type(Type type);

/// The ports of a node as its nodedef declares them: what came apart as "in.a", "in.b.c"
/// is one structure again. Lives as long as the types of its values are used.
class TextPorts {
 public:
  struct Port {
    std::string name;
    glsl::Value value;      ///< Without parts for outputs.
    std::size_t first = 0;  ///< Of the node's ports, the first that it stands for;
    std::size_t count = 1;  ///< and how many.
  };

  TextPorts(const NodeText& source, const std::vector<NodeCall::Port>& ports);

  const std::vector<Port>& all() const { return ports_; }

 private:
  using Members = std::vector<std::pair<std::string, glsl::Value>>;

  glsl::Value structure_of(const Members& members, std::size_t first, std::size_t end,
                           std::size_t skip);

  std::deque<glsl::Struct> types_;
  std::deque<std::string> names_;
  std::vector<Port> ports_;
};

/// How a type of a text differs from what a port is: as a diagnostic says it.
struct SourceMisfit {
  std::string expected;
  std::string found;
};
/// A structure fits one that has members of the same names and types in the same order,
/// whatever either is called; other types fit themselves. File names fit no member.
std::optional<SourceMisfit> find_misfit(const glsl::Type& port, const glsl::Type& found);

}  // namespace nacre
