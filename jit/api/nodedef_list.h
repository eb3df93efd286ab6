#pragma once

#include <nacre/nacre.h>

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "jit/api/text_arena.h"
#include "jit/shading/shading_system.h"

namespace nacre::api {

/// The nodedefs of a system's libraries as hosts see them.
class NodeDefList {
 public:
  /// Copies all texts.
  explicit NodeDefList(const ShadingSystem& system);

  struct Row {
    nacre_nodedef about{};
    std::vector<nacre_port> inputs, outputs;
  };
  const std::vector<Row>& rows() const { return rows_; }
  /// SIZE_MAX if there is none of that name.
  std::size_t find(std::string_view name) const;

 private:
  nacre_port port(const NodeDefInput& input);
  nacre_port port(const NodeDefOutput& output);

  TextArena texts_;
  std::vector<Row> rows_;
  std::unordered_map<std::string_view, std::size_t> by_name_;
};

}  // namespace nacre::api
