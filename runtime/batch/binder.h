#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/batch/layout.h"
#include "runtime/diagnostic.h"
#include "runtime/program/program.h"

namespace nacre {

/// Where each channel of one kernel is in a host's arrays: made once for a kernel, used for
/// every batch.
struct Binding {
  std::vector<ChannelLayout> inputs;     ///< One a Program::inputs entry.
  std::vector<ChannelLayout> outputs;    ///< One a Program::outputs entry.
  std::vector<std::uint32_t> constants;  ///< What layouts of array `bound_constants` lie in.
  /// One an input: the first of its layout, which may be itself. As N and Ng of a flat triangle
  /// are: where they must be copied one copy is enough.
  std::vector<std::uint32_t> first_alike;
  std::uint32_t arrays = 0;      ///< As many as a Batch must have.
  bool reads_instances = false;  ///< A Batch must have a list of them.
  /// Channels that kernels cannot take where they are: of batches without a list of points, and
  /// with one.
  /// @{
  std::uint32_t copies = 0;
  std::uint32_t copies_of_list = 0;
  /// @}
  /// Slots "geomprop.<name>" that are true, for the host has that property.
  std::vector<std::uint32_t> present;
};

/// ChannelLayout::array of what bind_constant() was given.
inline constexpr std::uint32_t bound_constants = ~std::uint32_t{0} - 1;
/// ChannelLayout::array of outputs that nobody wants.
inline constexpr std::uint32_t discarded = ~std::uint32_t{0};

/// Whether a list says which elements of a channel are the points', of a batch with or without a
/// list of points.
constexpr bool is_listed(const ChannelLayout& layout, bool has_points) {
  return layout.element == ElementOf::instance ||
         (layout.element == ElementOf::point && has_points);
}
/// Whether that leaves no array that a kernel can take: a four-byte number for each point.
constexpr bool needs_copy(const ChannelLayout& layout, bool has_points) {
  return layout.stride != 4 || layout.array == discarded || is_listed(layout, has_points);
}

/// Where a host keeps its numbers, channel by channel. It binds all that it has, once; each
/// kernel takes what it needs.
class Binder {
 public:
  /// A channel, "P.x"; or a group, "P", whose components are `component_stride` bytes apart, as
  /// are the values of "state" (in the order of the material's list). A channel that was bound
  /// by itself counts before its group, and what is bound later before what was earlier.
  void bind(std::string_view name, const ChannelLayout& layout,
            std::ptrdiff_t component_stride = 4);
  /// The same for all points of all batches: bits of one value a component, those that are
  /// left out being 0. Of a group or a channel.
  void bind_constant(std::string_view name, std::span<const std::uint32_t> bits);

  /// For one kernel. Nothing, with an error for each, where inputs have no place; outputs that
  /// have none are discarded, and a geometric property without one is absent (the node's default).
  /// `state`: MaterialKernels::state, of a material's kernel.
  std::optional<Binding> finish(const Program& program, std::span<const std::uint32_t> state,
                                Diagnostics& diagnostics) const;

 private:
  struct Place {
    ChannelLayout layout;
    std::ptrdiff_t component_stride = 4;
    std::vector<std::uint32_t> bits;  ///< Of a constant.
  };
  std::string near_place(const std::string& channel, const Diagnostics& diagnostics) const;
  const Place* find(const std::string& name, std::string_view group, int& component) const;

  std::map<std::string, Place, std::less<>> places_;
};

}  // namespace nacre
