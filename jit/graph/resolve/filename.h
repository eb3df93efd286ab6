#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace nacre {

/// What stands for a name in a file name; nothing, or no function, leaves it.
struct FilenameSubstitutions {
  using Lookup = std::function<std::optional<std::string>(std::string_view name)>;
  Lookup token;      ///< "[NAME]": an interface token.
  Lookup attribute;  ///< "{NAME}": an attribute of the host.
  Lookup geometry;   ///< "<NAME>": a token of the geometry (Geometry Extensions).
};

/// Replaces tokens in a file name (MaterialX 1.39 Specification, "Filename
/// Substitutions"). <UDIM> and <UVTILE>, which depend on the point, {frame} and
/// {0Nframe}, which depend on the node, and what nobody defines stay as they are.
std::string substitute_filename(std::string_view text, const FilenameSubstitutions& by);

/// Replaces "{frame}" and, padded with zeros to N digits, at most 9, "{0Nframe}".
std::string substitute_frame(std::string_view text, int frame);
bool has_frame_token(std::string_view text);

/// The first and last frame that there are files of.
struct FrameRange {
  int first = 0;
  int last = 0;
};

/// "10-99"; nothing if the text is no range or runs backwards.
std::optional<FrameRange> parse_frame_range(std::string_view text);

/// The frame whose file is read: `frame`, or where it lies outside the range what
/// `end_action` says (Standard Nodes, "Texture Node Notes"): the first or last one
/// ("clamp"), counted on from the other end ("periodic"), or bounced off the ends,
/// each end once ("mirror"). Nothing for "constant": the node's default.
std::optional<int> frame_in_range(int frame, FrameRange range, std::string_view end_action);

}  // namespace nacre
