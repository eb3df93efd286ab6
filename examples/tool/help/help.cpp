#include "examples/tool/help/help.h"

#include <fmt/format.h>

#include <algorithm>

namespace nacre::tool {

namespace {

constexpr std::size_t width = 80;   ///< Of a line.
constexpr std::size_t column = 26;  ///< Where the texts of options begin.

std::string option_lines(const OptionText& option, const std::string& what) {
  const std::string head = "  " + option.head();
  std::string text = wrapped(what, width, column);
  if (head.size() + 2 > column) return head + '\n' + text;
  return text.empty() ? head + '\n' : text.replace(0, head.size(), head);
}

std::string usage(const CLI::App& app, const std::string& name,
                  const std::vector<OptionText>& options) {
  std::string line = name;
  if (!shown_commands(app).empty()) return fmt::format("Usage: {} COMMAND [OPTION]...\n", line);
  for (const OptionText& each : options) {
    if (each.is_positional) line += ' ' + each.names.front();
  }
  return fmt::format("Usage: {} [OPTION]...\n", line);
}

std::string command_list(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : shown_commands(app)) {
    OptionText line;
    line.names = {command->get_name()};
    line.text = command->get_description();
    text += option_lines(line, line.text);
  }
  return text.empty() ? text : "\nCommands:\n" + text;
}

/// In the order in which they are named.
std::string common_options(const std::vector<OptionText>& options, const HelpTexts& help) {
  std::string text;
  for (const std::string& name : help.common) {
    const auto is_it = [&](const OptionText& option) {
      return std::ranges::find(option.names, name) != option.names.end();
    };
    const auto found = std::ranges::find_if(options, is_it);
    if (found != options.end()) text += option_lines(*found, found->brief({"; ", ". "}));
  }
  return text.empty() ? text : "\nOptions:\n" + text;
}

std::string all_options(const std::vector<OptionText>& options) {
  std::string text;
  std::string group;
  for (const OptionText& option : options) {
    if (option.group != group) text += fmt::format("\n{}:\n", option.group);
    group = option.group;
    text += option_lines(option, option.text + option.notes);
  }
  return text;
}

}  // namespace

std::string Help::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  const std::vector<OptionText> options = option_texts(*app);
  const bool is_all = mode != CLI::AppFormatMode::Normal || texts_.common.empty();
  std::string text = usage(*app, name, options);
  text += wrapped(app->get_description() + '.', width, 0);
  text += command_list(*app);
  text += is_all ? all_options(options) : common_options(options, texts_);
  if (is_all && !app->get_footer().empty()) text += '\n' + wrapped(app->get_footer(), width, 0);
  if (!texts_.examples.empty()) text += "\nExamples:\n";
  for (const std::string& line : texts_.examples) text += "  " + line + '\n';
  if (!is_all) {
    const auto rest = std::ranges::count_if(
        options, [](auto& each) { return !each.is_common && !each.is_positional; });
    text += fmt::format("\n{} --help-all lists {} more options, and says more.\n", name, rest);
  }
  return text;
}

}  // namespace nacre::tool
