#include "runtime/batch/binder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "runtime/channel/channel_name.h"
#include "runtime/channel/channel_table.h"
#include "runtime/near_names.h"

namespace nacre {

namespace {

std::string expected_of(std::string_view group) {
  const ChannelGroup* known = find_channel_group(group);
  if (known == nullptr) return "an array or a constant bound to it";
  return fmt::format("an array or a constant bound to it: {}{}{}", known->meaning,
                     known->unit.empty() ? "" : ", ", known->unit);
}

}  // namespace

void Binder::bind(std::string_view name, const ChannelLayout& layout,
                  std::ptrdiff_t component_stride) {
  places_[std::string(name)] = {layout, component_stride, {}};
}

void Binder::bind_constant(std::string_view name, std::span<const std::uint32_t> bits) {
  places_[std::string(name)] = {
      {.array = bound_constants, .stride = 0}, 0, {bits.begin(), bits.end()}};
}

const Binder::Place* Binder::find(const std::string& name, std::string_view group,
                                  int& component) const {
  auto found = places_.find(name);
  if (found != places_.end()) {
    component = 0;
    return &found->second;
  }
  found = places_.find(group);
  return found != places_.end() ? &found->second : nullptr;
}

/// What is bound under a name that is nearly the channel's, or its group's.
std::string Binder::near_place(const std::string& channel, const Diagnostics& diagnostics) const {
  const auto name_of = [](const auto& place) { return std::string_view(place.first); };
  const std::string hint = near_hint(diagnostics, parse_channel(channel).group, places_, name_of);
  return hint.empty() ? near_hint(diagnostics, channel, places_, name_of) : hint;
}

std::optional<Binding> Binder::finish(const Program& program, std::span<const std::uint32_t> state,
                                      Diagnostics& diagnostics) const {
  Binding binding;
  const std::size_t errors = diagnostics.error_count();
  const auto layout_of = [&](const Channel& channel) -> std::optional<ChannelLayout> {
    auto [group, component] = parse_channel(channel.name);
    if (group == "state") {
      const auto number = static_cast<std::uint32_t>(component);
      component = static_cast<int>(std::ranges::find(state, number) - state.begin());
    }
    component = std::max(component, 0);
    const Place* place = find(channel.name, group, component);
    if (place == nullptr) return std::nullopt;
    ChannelLayout layout = place->layout;
    const auto i = static_cast<std::size_t>(component);
    if (layout.array == bound_constants) {
      layout.offset = static_cast<std::ptrdiff_t>(4 * binding.constants.size());
      binding.constants.push_back(i < place->bits.size() ? place->bits[i] : 0);
    } else {
      layout.offset += place->component_stride * component;
      binding.arrays = std::max(binding.arrays, layout.array + 1);
    }
    return layout;
  };
  const auto slot_of = [&](std::string_view name) {
    return std::ranges::find(program.parameters, name, &ParameterSlot::name);
  };
  for (const Channel& input : program.inputs) {
    auto layout = layout_of(input);
    // A slot named as the property says whether there is one (nodes/geometric).
    const auto presence = slot_of(parse_channel(input.name).group);
    if (presence != program.parameters.end()) {
      const auto slot = static_cast<std::uint32_t>(presence - program.parameters.begin());
      if (layout && std::ranges::find(binding.present, slot) == binding.present.end()) {
        binding.present.push_back(slot);
      }
      if (!layout) {
        layout = {.array = bound_constants,
                  .offset = static_cast<std::ptrdiff_t>(4 * binding.constants.size()),
                  .stride = 0};
        binding.constants.push_back(0);
      }
    }
    if (layout) {
      binding.inputs.push_back(*layout);
      continue;
    }
    diagnostics.error(
        "unbound-channel", {},
        fmt::format("{} reads '{}', which is bound to nothing", program.name, input.name),
        expected_of(parse_channel(input.name).group), {}, near_place(input.name, diagnostics));
  }
  for (const Channel& output : program.outputs) {
    const auto layout = layout_of(output);
    const bool is_written = layout && layout->array != bound_constants;
    if (is_written && layout->stride == 0) {
      diagnostics.error("unbound-channel", {},
                        fmt::format("{} stores '{}' where all points have one element",
                                    program.name, output.name),
                        "a stride that is not 0");
    }
    binding.outputs.push_back(is_written ? *layout : ChannelLayout{.array = discarded});
  }
  if (diagnostics.error_count() != errors) return std::nullopt;
  const auto count = [&](const ChannelLayout& layout) {
    binding.reads_instances |= layout.element == ElementOf::instance;
    binding.copies += needs_copy(layout, false) ? 1 : 0;
    binding.copies_of_list += needs_copy(layout, true) ? 1 : 0;
  };
  for (const ChannelLayout& input : binding.inputs) {
    const auto first = std::ranges::find(binding.inputs, input);
    binding.first_alike.push_back(static_cast<std::uint32_t>(first - binding.inputs.begin()));
    if (&*first == &input) count(input);
  }
  for (const ChannelLayout& output : binding.outputs) count(output);
  return binding;
}

}  // namespace nacre
