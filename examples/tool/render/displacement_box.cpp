#include "examples/tool/render/displacement_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "examples/render/batch_channels.h"
#include "jit/passes/range.h"
#include "runtime/channel/channel_name.h"

namespace nacre::tool {

namespace {

/// More than interpolation rounds, and than kernels of the least accuracy are off.
constexpr double interpolated = 1e-5, computed = 2e-3;

Range widened(double low, double high, double part) {
  const double room = part * std::max(std::abs(low), std::abs(high));
  return {low - room, high + room, false};
}

/// Of the numbers of a batch, or nothing.
std::optional<Range> hull(std::string_view channel, const host::ShadingBatch& corners) {
  host::Capabilities unused;
  const host::BatchSource source = host::batch_channel(channel, unused);
  const void* const lanes = source ? source(corners) : nullptr;
  if (lanes == nullptr) return {};
  const std::span numbers(static_cast<const float*>(lanes), corners.count);
  if (!std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); })) return {};
  const auto [low, high] = std::ranges::minmax(numbers);
  return widened(low, high, interpolated);
}

/// What does not go from corner to corner in a straight line, but is a unit vector that was
/// interpolated so: one of the hull, made longer.
Range unit(const std::string& group, int component, const host::ShadingBatch& corners) {
  const Range any{-1.001, 1.001, false};
  std::array<Range, 3> hulls;
  double least = 0.0;  // Of the squared length.
  for (int k = 0; k < 3; ++k) {
    const std::optional<Range> found = hull(channel_text(group, k), corners);
    if (!found) return any;
    hulls[k] = *found;
    const bool has_zero = found->low <= 0 && found->high >= 0;
    const double near = std::min(std::abs(found->low), std::abs(found->high));
    least += has_zero ? 0.0 : near * near;
  }
  if (!(least > 0.01)) return any;
  const double longer = std::max(1.0 / std::sqrt(least), 1.0);
  const Range& one = hulls[static_cast<std::size_t>(component)];
  const double low = one.low < 0 ? one.low * longer : one.low;
  const double high = one.high > 0 ? one.high * longer : one.high;
  return {std::max(low, -1.0 - interpolated), std::min(high, 1.0 + interpolated), false};
}

Range within(const Channel& channel, const host::ShadingBatch& corners) {
  if (channel.type != Scalar::f32) return {};
  const auto [group, component] = parse_channel(channel.name);
  // As runtime/node/geometry.h names them.
  if (group == "N" || group == "No") return unit(std::string(group), component, corners);
  if (group == "T" || group == "B" || group == "To" || group == "Bo") return {-1.001, 1.001, false};
  const bool is_straight = group == "P" || group == "Po" || group == "uv0";
  if (!is_straight) return {};
  return hull(channel.name, corners).value_or(Range{});
}

}  // namespace

host::Bounds displacement_box(const Program& recorded, const host::ShadingBatch& corners) {
  std::vector<Range> inputs;
  for (const Channel& channel : recorded.inputs) inputs.push_back(within(channel, corners));
  const std::vector<Range> outputs = output_ranges(recorded, inputs);
  host::Bounds box{{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
  const std::array<std::pair<float*, float*>, 3> ends{
      {{&box.low.x, &box.high.x}, {&box.low.y, &box.high.y}, {&box.low.z, &box.high.z}}};
  for (std::size_t i = 0; i < recorded.outputs.size(); ++i) {
    const auto [group, component] = parse_channel(recorded.outputs[i].name);
    if (group != "offset" || component < 0 || !outputs[i].is_bounded()) continue;
    const Range wide = widened(outputs[i].low, outputs[i].high, computed);
    const auto& [low, high] = ends[static_cast<std::size_t>(component)];
    *low = static_cast<float>(wide.low), *high = static_cast<float>(wide.high);
  }
  return box;
}

}  // namespace nacre::tool
