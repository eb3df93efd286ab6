#include "runtime/channel/channel_name.h"

#include <charconv>
#include <cstdint>

namespace nacre {

namespace {

constexpr std::string_view letters = "xyzw";
constexpr std::string_view state_prefix = "state.";

/// The whole text as a number that is no sign's.
std::optional<int> parse_number(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, number);
  if (fault != std::errc() || stop != end || text.front() == '-') return std::nullopt;
  return number;
}

}  // namespace

ChannelName parse_channel(std::string_view name) {
  if (const auto number = state_number(name)) {
    return {name.substr(0, state_prefix.size() - 1), static_cast<int>(*number)};
  }
  if (name.size() < 3 || name[name.size() - 2] != '.') return {name, -1};
  const std::size_t component = letters.find(name.back());
  if (component == std::string_view::npos) return {name, -1};
  return {name.substr(0, name.size() - 2), static_cast<int>(component)};
}

std::string channel_text(std::string_view group, int component) {
  std::string text(group);
  if (component < 0) return text;
  text += '.';
  const auto i = static_cast<std::size_t>(component);
  if (group != "state" && i < letters.size()) return text += letters[i];
  return text += std::to_string(component);
}

std::optional<DerivativeName> parse_derivative(std::string_view group) {
  const bool is_derivative =
      group.size() > 3 && group.front() == 'd' && (group.ends_with("dx") || group.ends_with("dy"));
  if (!is_derivative) return std::nullopt;
  return DerivativeName{group.substr(1, group.size() - 3), group.back() == 'x' ? 0 : 1};
}

std::string derivative_text(std::string_view group, int axis) {
  return 'd' + std::string(group) + (axis == 0 ? "dx" : "dy");
}

std::optional<std::uint32_t> state_number(std::string_view name) {
  if (!name.starts_with(state_prefix) || name.size() == state_prefix.size()) return std::nullopt;
  const auto number = parse_number(name.substr(state_prefix.size()));
  if (!number) return std::nullopt;
  return static_cast<std::uint32_t>(*number);
}

}  // namespace nacre
