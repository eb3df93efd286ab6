#include "jit/api/python/channel_use.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace nacre::python {

namespace {

bool is_digits(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return '0' <= c && c <= '9'; });
}

/// Of "P.y" 1, of a matrix's "m.12" 12; -1 for channels that are no component.
int component_of(std::string_view channel) {
  const std::size_t dot = channel.rfind('.');
  if (dot == std::string_view::npos) return -1;
  const std::string_view last = channel.substr(dot + 1);
  if (last.size() == 1 && std::strchr("xyzw", last[0]) != nullptr) {
    return static_cast<int>(std::string_view("xyzw").find(last[0]));
  }
  return is_digits(last) && last.size() < 8 ? std::stoi(std::string(last)) : -1;
}

/// "duv*dx" fits "duv0dx"; the star of "geomprop.*" stands for any text.
bool fits(std::string_view pattern, std::string_view name) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == name;
  const std::string_view before = pattern.substr(0, star);
  const std::string_view behind = pattern.substr(star + 1);
  if (name.size() <= before.size() + behind.size()) return false;
  if (name.substr(0, before.size()) != before) return false;
  if (name.substr(name.size() - behind.size()) != behind) return false;
  name.remove_prefix(before.size());
  name.remove_suffix(behind.size());
  return before.back() == '.' || is_digits(name);
}

std::optional<nacre_channel_group> group_of(std::string_view name) {
  for (std::size_t i = 0; i < nacre_channel_group_count(); ++i) {
    nacre_channel_group group{};
    group.size = sizeof group;
    detail::check(nacre_channel_group_get(i, &group));
    if (fits(group.name, name)) return group;
  }
  return std::nullopt;
}

void add(ChannelUse& use, const std::string& name, const Channel& channel, bool is_stored) {
  if (!covers(name, channel.name)) return;
  use.is_used = true;
  (is_stored ? use.is_stored : use.is_read) = true;
  use.is_scalar = use.is_scalar || name == channel.name;
  // All of the state is one array of floats, whatever its numbers are.
  if (channel.role != NACRE_STATE || name == channel.name) use.type = channel.type;
  const int component =
      channel.role == NACRE_STATE ? channel.component : component_of(channel.name);
  if (name != channel.name) use.least = std::max(use.least, component + 1);
}

}  // namespace

bool covers(std::string_view name, std::string_view channel) {
  if (name == channel) return true;
  return component_of(channel) >= 0 && name == channel.substr(0, channel.rfind('.'));
}

std::optional<ChannelUse> channel_use(const Shader& shader, std::uint32_t entries,
                                      const std::string& name) {
  ChannelUse use;
  for (int i = 0; i < NACRE_ENTRY_COUNT; ++i) {
    const auto entry = static_cast<nacre_entry>(i);
    if ((entries >> i & 1) == 0 || !shader.has(entry)) continue;
    for (const Channel& each : shader.inputs(entry)) add(use, name, each, false);
    for (const Channel& each : shader.results(entry)) add(use, name, each, true);
  }
  use.most = use.least;
  if (use.is_scalar) {
    use.least = use.most = 1;
    return use;
  }
  if (name == "state") {
    // One array may serve several shaders, some of which keep nothing.
    use.most = std::numeric_limits<int>::max();
    if (!use.is_used) use.least = 0;
    return use;
  }
  const std::size_t number = nacre_shader_find_parameter(shader.get(), name.c_str());
  nacre_parameter parameter{};
  parameter.size = sizeof parameter;
  if (nacre_shader_parameter(shader.get(), number, &parameter) == NACRE_OK) {
    use.least = use.most = parameter.components;
    use.type = parameter.number_type;
    return use;
  }
  if (const auto group = group_of(name)) {
    // Kernels read what they need of a group, hosts have all of it; of a property nobody knows.
    use.most = group->components;
    if (name.substr(0, 9) != "geomprop.") use.least = use.most;
    if (!use.is_used) use.type = group->type;
    return use;
  }
  const int component = component_of(name);
  const bool is_component = component >= 0 && group_of(name.substr(0, name.rfind('.')));
  if (!use.is_used && !is_component) return std::nullopt;
  return use;
}

}  // namespace nacre::python
