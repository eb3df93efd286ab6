#include "pbs/tables/look_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace nacre {

namespace {

struct Axis {
  int nodes;
  Float at;
};

/// Nodes around a coordinate.
struct Cell {
  Int first;
  Float fraction;
};

Cell cell_of(const Axis& axis) {
  const Float place = saturate(axis.at) * Float(axis.nodes - 1);
  const Float first = min(floor(place), Float(axis.nodes - 2));
  return {to_int(first), place - first};
}

/// The table with `axis` replaced by the values at its literal coordinate.
std::vector<float> fold_axis(std::span<const float> values, const std::vector<Axis>& axes,
                             std::size_t axis, int quantities) {
  int inner = quantities;
  for (std::size_t k = 0; k < axis; ++k) inner *= axes[k].nodes;
  const int nodes = axes[axis].nodes;
  const float place = std::clamp(axes[axis].at.constant(), 0.0f, 1.0f) * float(nodes - 1);
  const int first = std::min(static_cast<int>(place), nodes - 2);
  const float t = place - float(first);
  const int outer = static_cast<int>(values.size()) / (inner * nodes);
  std::vector<float> out;
  for (int o = 0; o < outer; ++o) {
    const float* slab = values.data() + (o * nodes + first) * inner;
    for (int i = 0; i < inner; ++i) out.push_back((1.0f - t) * slab[i] + t * slab[i + inner]);
  }
  return out;
}

/// The quantities at a place between nodes, linear along each axis.
std::vector<Float> interpolate(Recorder& recorder, std::uint32_t table,
                               const std::vector<Axis>& axes, int quantities) {
  std::vector<Float> fractions;
  std::vector<int> offsets{0};  // Of the corners, first axis fastest.
  Int base(0);
  int stride = quantities;
  for (const Axis& axis : axes) {
    const Cell cell = cell_of(axis);
    base = base + cell.first * Int(stride);
    fractions.push_back(cell.fraction);
    const std::size_t corners = offsets.size();
    for (std::size_t k = 0; k < corners; ++k) offsets.push_back(offsets[k] + stride);
    stride *= axis.nodes;
  }

  // Words side by side, one after the other, are what engines read together; so
  // the two nodes along the first axis come with all their quantities.
  const auto per_node = static_cast<std::size_t>(quantities);
  std::vector<Float> corners(offsets.size() * per_node);
  for (std::size_t corner = 0; corner < offsets.size(); ++corner) {
    for (std::size_t quantity = 0; quantity < per_node; ++quantity) {
      const Ref index = (base + Int(offsets[corner] + static_cast<int>(quantity))).ref();
      corners[corner * per_node + quantity] =
          Float(recorder.emit(Op::table, std::span(&index, 1), table));
    }
  }
  // The last axis first: of those on which all points of a call have one place, engines make rows
  // along the first.
  for (std::size_t axis = fractions.size(); axis-- > 0;) {
    const std::size_t half = corners.size() / 2;
    for (std::size_t k = 0; k < half; ++k) {
      corners[k] = lerp(corners[k], corners[k + half], fractions[axis]);
    }
    corners.resize(half);
  }
  return corners;
}

}  // namespace

std::vector<Float> look_up(Recorder& recorder, const FacetTable& table, Float angle,
                           Float roughness, Float index) {
  std::vector<Axis> axes{{table.angles, angle}, {table.roughnesses, roughness}};
  if (table.indices > 1) axes.push_back({table.indices, index});
  std::vector<float> values(table.values.begin(), table.values.end());
  std::string key(table.name);
  for (std::size_t k = axes.size(); k-- > 0;) {
    if (!axes[k].at.is_constant()) continue;
    values = fold_axis(values, axes, k, table.quantities);
    key += fmt::format("/{}={:08x}", k, axes[k].at.ref().id);
    axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(k));
  }
  std::vector<Float> out;
  if (axes.empty()) {
    for (const float value : values) out.push_back(value);
    return out;
  }
  return interpolate(recorder, recorder.table(key, values), axes, table.quantities);
}

}  // namespace nacre
