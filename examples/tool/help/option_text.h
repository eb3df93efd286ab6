#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace nacre::tool {

/// What a subcommand's help has beside its options.
struct HelpTexts {
  /// Options that the short help shows, in this order; "--out". The others are in --help-all.
  std::vector<std::string> common;
  std::vector<std::string> examples;  ///< Command lines.
};

/// An option as help, manual and completion show it.
struct OptionText {
  std::vector<std::string> names;  ///< "-q", "--quiet"; of a positional one "FILE.mtlx".
  std::string value;               ///< What it takes: "N|WxH", "NAME", "exr|png|tx"; "" for a flag.
  std::vector<std::string> choices;  ///< Words that it may be: "exr", "png", "tx"; may be empty.
  std::string text;                  ///< What it is.
  std::string notes;                 ///< " (default: 1) (required)"
  std::string group;                 ///< A title.
  bool is_positional = false;
  bool is_common = false;  ///< In the short help.

  /// "-q, --quiet", "--size N|WxH"
  std::string head() const;
  /// As much of `text` as says what it is, up to one of `stops`; with the default.
  std::string brief(std::initializer_list<const char*> stops) const;
  /// Whether the value names a file or folder.
  bool is_file() const;
  bool is_folder() const;
};

/// Puts the texts of a subcommand's help where help, manual and completion find them. An option in
/// `common` that there is not is a fault of ours: an exception.
void set_help(CLI::App& command, HelpTexts texts);
const HelpTexts& help_of(const CLI::App& command);

/// All options that are shown, in the order of their groups.
std::vector<OptionText> option_texts(const CLI::App& command);

/// Those that are not hidden, in order.
std::vector<const CLI::App*> shown_commands(const CLI::App& app);

/// Lines of at most `width` letters, each after `indent` spaces; lines of the text that begin with
/// a space stay as they are.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent);

}  // namespace nacre::tool
