#pragma once

#include <array>
#include <string>
#include <string_view>

#include "nodes/math/matrix.h"
#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// What leads from one named space to another. Object and model space are one;
/// equal, empty and unknown names change nothing, as in MaterialX's generators.
enum class SpaceChange { none, object_to_world, world_to_object };

inline SpaceChange space_change(std::string_view from, std::string_view to) {
  const auto object = [](std::string_view name) { return name == "object" || name == "model"; };
  if (object(from) && to == "world") return SpaceChange::object_to_world;
  if (from == "world" && object(to)) return SpaceChange::world_to_object;
  return SpaceChange::none;
}

/// The change as the node's "fromspace" and "tospace" name it.
inline SpaceChange space_change(const NodeCall& call) {
  return space_change(call.text("fromspace"), call.text("tospace"));
}

/// The matrix of the change, or of the change back. Points and vectors are rows
/// on the left.
inline Matrix space_matrix(Recorder& recorder, SpaceChange change, bool back = false) {
  Matrix result = identity(4);
  if (change == SpaceChange::none) return result;
  const bool to_world = (change == SpaceChange::object_to_world) != back;
  const std::string name = to_world ? "object_to_world." : "world_to_object.";
  for (std::size_t i = 0; i < 16; ++i) {
    result.entries[i] = uniform(recorder, name + std::to_string(i), result.entries[i].constant());
  }
  return result;
}

/// v through the matrix; w is 1 for points, 0 for vectors. The last column of an
/// affine matrix isn't needed.
inline Float3 through(const Matrix& m, Float3 v, float w) {
  const auto component = [&](int column) {
    return fma(v.x, m(0, column), fma(v.y, m(1, column), fma(v.z, m(2, column), w * m(3, column))));
  };
  const auto direction = [&](int column) {
    return fma(v.x, m(0, column), fma(v.y, m(1, column), v.z * m(2, column)));
  };
  if (w == 0.0f) return {direction(0), direction(1), direction(2)};
  return {component(0), component(1), component(2)};
}

}  // namespace nacre
