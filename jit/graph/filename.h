#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace nacre {

/// Replaces "[NAME]" by what `token` says and, with a frame, "{frame}" and
/// "{0Nframe}" (Specification, "Filename Substitutions"). <UDIM>, <UVTILE>,
/// other braces and tokens that nobody defines stay as they are. A frame is
/// padded with zeros to N digits, at most 9.
std::string substitute_filename(
    std::string_view text,
    const std::function<std::optional<std::string>(std::string_view name)>& token,
    std::optional<int> frame);

}  // namespace nacre
