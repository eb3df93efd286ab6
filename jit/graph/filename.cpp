#include "jit/graph/filename.h"

#include <fmt/format.h>

#include <algorithm>

namespace nacre {

namespace {

// "frame" or "0Nframe" between braces; the digits to pad to, or nothing.
std::optional<int> frame_digits(std::string_view inside) {
  if (inside == "frame") return 1;
  if (inside.size() != 7 || inside[0] != '0' || !inside.ends_with("frame")) return std::nullopt;
  if (inside[1] < '0' || inside[1] > '9') return std::nullopt;
  return std::max(1, inside[1] - '0');
}

}  // namespace

std::string substitute_filename(
    std::string_view text,
    const std::function<std::optional<std::string>(std::string_view name)>& token,
    std::optional<int> frame) {
  // Known beforehand, so that a text of opening brackets is not searched for each.
  const std::size_t last_bracket = text.rfind(']');
  const std::size_t last_brace = text.rfind('}');
  const auto has_close = [&](std::size_t at) {
    const std::size_t last = text[at] == '[' ? last_bracket : last_brace;
    return (text[at] == '[' || text[at] == '{') && last != std::string_view::npos && last > at;
  };
  std::string result;
  std::size_t at = 0;
  while (at < text.size()) {
    const char open = text[at];
    const char close = open == '[' ? ']' : '}';
    if (!has_close(at)) {
      result += text[at++];
      continue;
    }
    const std::size_t end = text.find(close, at);
    const std::string_view inside = text.substr(at + 1, end - at - 1);
    std::optional<std::string> replacement;
    if (open == '[') {
      replacement = token(inside);
    } else if (const auto digits = frame_digits(inside); digits && frame) {
      replacement = fmt::format("{:0{}}", *frame, *digits);
    }
    result += replacement ? *replacement : std::string(text.substr(at, end - at + 1));
    at = end + 1;
  }
  return result;
}

}  // namespace nacre
