#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nacre {

/// The name of a channel, taken apart: "P.x" is component 0 of the group "P", "state.7" is
/// component 7 of "state", and "pdf" a group by itself. Refers to the text it was made of.
struct ChannelName {
  std::string_view group;  ///< "P", "uv0", "duv0dx", "geomprop.age".
  int component = -1;      ///< x, y, z, w are 0 to 3; -1: the group is one channel.

  bool operator==(const ChannelName&) const = default;
};

/// Of any text; one that is no such name is a group.
ChannelName parse_channel(std::string_view name);

/// The inverse: "P.x".
std::string channel_text(std::string_view group, int component);

/// What a derivative's group is of: "dPdx" is P along axis 0, "duv0dy" uv0 along axis 1.
struct DerivativeName {
  std::string_view group;  ///< "P"
  int axis = 0;            ///< 0 for x, 1 for y of the footprint.

  bool operator==(const DerivativeName&) const = default;
};

/// Nothing for groups that are no derivatives.
std::optional<DerivativeName> parse_derivative(std::string_view group);

/// The inverse: "dPdx".
std::string derivative_text(std::string_view group, int axis);

/// k of "state.<k>", a value that `begin` stores; nothing for other channels.
std::optional<std::uint32_t> state_number(std::string_view name);

}  // namespace nacre
