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

class Interpolation {
 public:
  Interpolation(Recorder& recorder, std::uint32_t table, const std::vector<Axis>& axes,
                int quantities)
      : recorder_(recorder), table_(table), quantities_(quantities) {
    int stride = quantities;
    for (const Axis& axis : axes) {
      cells_.push_back(cell_of(axis));
      strides_.push_back(stride);
      stride *= axis.nodes;
    }
  }

  Float at(int quantity) { return along(cells_.size(), Int(quantity)); }

 private:
  /// Interpolates the first `axes` axes from `offset`.
  Float along(std::size_t axes, Int offset) {
    if (axes == 0) {
      const Ref index = offset.ref();
      return Float(recorder_.emit(Op::table, std::span(&index, 1), table_));
    }
    const Cell& cell = cells_[axes - 1];
    const Int stride(strides_[axes - 1]);
    const Int low = offset + cell.first * stride;
    return lerp(along(axes - 1, low), along(axes - 1, low + stride), cell.fraction);
  }

  Recorder& recorder_;
  std::uint32_t table_;
  int quantities_;
  std::vector<Cell> cells_;
  std::vector<int> strides_;
};

}  // namespace

std::vector<Float> look_up(Recorder& recorder, std::string_view name, const GgxTable& table,
                           Float angle, Float roughness, Float index) {
  std::vector<Axis> axes{{table.angles, angle}, {table.roughnesses, roughness}};
  if (table.indices > 1) axes.push_back({table.indices, index});
  std::vector<float> values(table.values.begin(), table.values.end());
  std::string key(name);
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
  Interpolation interpolation(recorder, recorder.table(key, values), axes, table.quantities);
  for (int quantity = 0; quantity < table.quantities; ++quantity) {
    out.push_back(interpolation.at(quantity));
  }
  return out;
}

}  // namespace nacre
