#include "jit/passes/footprint.h"

#include <algorithm>
#include <array>

#include "runtime/channel/channel_name.h"

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
  const auto [group, component] = parse_channel(channel);
  if (std::ranges::find(positions, group) == positions.end() && !is_texture_coordinate(group) &&
      std::ranges::find(more, group) == more.end()) {
    return std::nullopt;
  }
  return channel_text(derivative_text(group, axis), component);
}

}  // namespace nacre
