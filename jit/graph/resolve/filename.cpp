#include "jit/graph/resolve/filename.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace nacre {

namespace {

// "frame" or "0Nframe" between braces; the digits to pad to, or nothing.
std::optional<int> frame_digits(std::string_view inside) {
  if (inside == "frame") return 1;
  if (inside.size() != 7 || inside[0] != '0' || !inside.ends_with("frame")) return std::nullopt;
  if (inside[1] < '0' || inside[1] > '9') return std::nullopt;
  return std::max(1, inside[1] - '0');
}

// Replaces what stands between brackets of any of the three kinds: by(open, inside).
template <typename By>
std::string replace_bracketed(std::string_view text, By&& by) {
  constexpr std::string_view opening = "[{<", closing = "]}>";
  // Known beforehand, so that a text of opening brackets is not searched for each.
  std::array<std::size_t, 3> last{};
  for (std::size_t k = 0; k < 3; ++k) last[k] = text.rfind(closing[k]);
  std::string result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t kind = opening.find(text[at]);
    const bool closes =
        kind != std::string_view::npos && last[kind] != std::string_view::npos && last[kind] > at;
    if (!closes) {
      result += text[at++];
      continue;
    }
    const std::size_t end = text.find(closing[kind], at);
    const std::optional<std::string> replacement = by(text[at], text.substr(at + 1, end - at - 1));
    result += replacement ? *replacement : std::string(text.substr(at, end - at + 1));
    at = end + 1;
  }
  return result;
}

// `value` in [0, period).
int wrapped(std::int64_t value, std::int64_t period) {
  return static_cast<int>((value % period + period) % period);
}

}  // namespace

std::string substitute_filename(std::string_view text, const FilenameSubstitutions& by) {
  return replace_bracketed(
      text, [&](char open, std::string_view inside) -> std::optional<std::string> {
        if (inside == "UDIM" || inside == "UVTILE" || frame_digits(inside)) return std::nullopt;
        const FilenameSubstitutions::Lookup& lookup = open == '['   ? by.token
                                                      : open == '{' ? by.attribute
                                                                    : by.geometry;
        return lookup ? lookup(inside) : std::nullopt;
      });
}

std::string substitute_frame(std::string_view text, int frame) {
  return replace_bracketed(text,
                           [&](char open, std::string_view inside) -> std::optional<std::string> {
                             const auto digits = open == '{' ? frame_digits(inside) : std::nullopt;
                             if (!digits) return std::nullopt;
                             return fmt::format("{:0{}}", frame, *digits);
                           });
}

bool has_frame_token(std::string_view text) { return substitute_frame(text, 0) != text; }

std::optional<FrameRange> parse_frame_range(std::string_view text) {
  FrameRange range;
  const char* end = text.data() + text.size();
  const auto [dash, first_error] = std::from_chars(text.data(), end, range.first);
  if (first_error != std::errc{} || dash == end || *dash != '-') return std::nullopt;
  const auto [rest, last_error] = std::from_chars(dash + 1, end, range.last);
  if (last_error != std::errc{} || rest != end || range.last < range.first) return std::nullopt;
  return range;
}

std::optional<int> frame_in_range(int frame, FrameRange range, std::string_view end_action) {
  if (frame >= range.first && frame <= range.last) return frame;
  if (end_action == "clamp") return std::clamp(frame, range.first, range.last);
  const std::int64_t from_first = std::int64_t{frame} - range.first;
  const std::int64_t count = std::int64_t{range.last} - range.first + 1;
  if (end_action == "periodic") return range.first + wrapped(from_first, count);
  if (end_action != "mirror") return std::nullopt;
  if (count == 1) return range.first;
  const std::int64_t there_and_back = 2 * (count - 1);
  const int step = wrapped(from_first, there_and_back);
  return range.first + static_cast<int>(step < count ? step : there_and_back - step);
}

}  // namespace nacre
