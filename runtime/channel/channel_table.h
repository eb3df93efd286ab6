#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "runtime/program/op.h"

namespace nacre {

/// Who gives a channel its numbers.
enum class ChannelRole : std::uint8_t {
  point,      ///< The host, of the shading point.
  direction,  ///< The host, of what it asks about the point: wi of evaluate, u of sample.
  state,      ///< `begin`, for the other kernels of the material.
  result,     ///< A kernel, for the host.
  slot,       ///< The host, once for a batch, in the parameter block; or a channel, if it asked.
};

/// Channels "<name>.x", ".y", ... of one meaning. All hosts and kernels have in common.
struct ChannelGroup {
  std::string_view name;  ///< "P"; "uv*", where * is a number, or a name after "geomprop.".
  ChannelRole role;       ///< Who gives the numbers.
  int components;  ///< 1: no suffix. At most so many of a geomprop, which has a suffix always.
  Scalar type;     ///< Of each.
  std::string_view unit;     ///< "scene units", "unit vector"; empty: a bare number.
  std::string_view meaning;  ///< One phrase.
};

/// All of them, those of one role together.
std::span<const ChannelGroup> channel_groups();

/// That of a group ("uv3", "duv0dx", "geomprop.age"), or null: an output of a node graph.
const ChannelGroup* find_channel_group(std::string_view group);

}  // namespace nacre
