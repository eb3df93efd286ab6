#include "jit/passes/footprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace nacre {

namespace {

constexpr std::array<std::string_view, 3> positions{"P", "Pm", "Po"};

bool is_texture_coordinate(std::string_view group) {
  return group.size() > 2 && group.starts_with("uv") &&
         group.find_first_not_of("0123456789", 2) == std::string_view::npos;
}

}  // namespace

std::optional<std::string> derivative_channel(std::string_view channel, int axis,
                                              std::span<const std::string_view> more) {
  const std::size_t dot = std::min(channel.rfind('.'), channel.size());
  const std::string_view group = channel.substr(0, dot);
  if (std::ranges::find(positions, group) == positions.end() && !is_texture_coordinate(group) &&
      std::ranges::find(more, group) == more.end()) {
    return std::nullopt;
  }
  return fmt::format("d{}d{}{}", group, axis == 0 ? 'x' : 'y', channel.substr(dot));
}

}  // namespace nacre
