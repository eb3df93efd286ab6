#include "jit/api/channels.h"

#include <algorithm>

#include "jit/api/call.h"
#include "runtime/channel/channel_name.h"
#include "runtime/channel/channel_table.h"

namespace nacre::api {

int number_type(Scalar type) {
  if (type == Scalar::i32) return NACRE_INT;
  return type == Scalar::b1 ? NACRE_BOOL : NACRE_FLOAT;
}

nacre_channel channel_info(const Channel& channel, std::span<const std::uint32_t> state,
                           ChannelList list) {
  const auto [group, component] = parse_channel(channel.name);
  const bool is_input = list == ChannelList::inputs;
  nacre_channel info{.size = 0,
                     .name = channel.name.c_str(),
                     .component = component,
                     .type = number_type(channel.type),
                     .role = is_input ? NACRE_SLOT : NACRE_VALUE,
                     .unit = "",
                     .meaning = ""};
  if (list == ChannelList::results_of_outputs) return info;
  if (const auto number = state_number(channel.name)) {
    info.component = static_cast<int>(std::ranges::find(state, *number) - state.begin());
  }
  const ChannelGroup* known = find_channel_group(group);
  if (known == nullptr || (is_input && known->role == ChannelRole::result)) return info;
  const bool is_state = known->role == ChannelRole::state;
  info.role = is_input || is_state ? static_cast<int>(known->role) : NACRE_RESULT;
  info.unit = known->unit.data();
  info.meaning = known->meaning.data();
  return info;
}

}  // namespace nacre::api

size_t nacre_channel_group_count(void) { return nacre::channel_groups().size(); }

nacre_status nacre_channel_group_get(size_t index, nacre_channel_group* group) {
  const auto groups = nacre::channel_groups();
  if (index >= groups.size()) return NACRE_WRONG_ARGUMENTS;
  const nacre::ChannelGroup& found = groups[index];
  return nacre::api::give(group, {.size = 0,
                                  .name = found.name.data(),
                                  .role = static_cast<int>(found.role),
                                  .components = found.components,
                                  .type = nacre::api::number_type(found.type),
                                  .unit = found.unit.data(),
                                  .meaning = found.meaning.data()});
}
