#include "examples/tool/help/option_text.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "examples/tool/help/help.h"

namespace nacre::tool {

namespace {

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = std::min(text.find(at), text.size());
    parts.emplace_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

bool is_word(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-';
  });
}

/// Of the types that CLI11 names itself.
std::string shown_type(const std::string& type) {
  if (type == "INT" || type == "UINT") return "N";
  return type == "FLOAT" ? "X" : type;
}

/// CLI11 has the type, and behind colons what validators say: "TEXT:{exr,png}", "INT:INT in [1 -
/// 9]".
void read_type(const CLI::Option& option, OptionText& text) {
  if (option.get_type_size() == 0) return;
  const std::string all = option.get_type_name();
  const std::size_t colon = all.find(':');
  text.value = shown_type(all.substr(0, colon));
  const std::string checks = colon == std::string::npos ? "" : all.substr(colon + 1);
  if (checks.starts_with('{') && checks.ends_with('}')) {
    text.choices = split(std::string_view(checks).substr(1, checks.size() - 2), ',');
    text.value = fmt::format("{}", fmt::join(text.choices, "|"));
  } else {
    for (std::string& word : split(text.value, '|')) {
      if (is_word(word)) text.choices.push_back(std::move(word));
    }
  }
  const std::size_t range = checks.find("in [");
  if (range == std::string::npos) return;
  std::string numbers = checks.substr(range + 4, checks.find(']') - range - 4);
  if (const std::size_t dash = numbers.find(" - "); dash != std::string::npos) {
    numbers.replace(dash, 3, " to ");
  }
  text.notes += fmt::format(" ({})", numbers);
}

std::string names_of(const std::set<CLI::Option*>& options) {
  std::string names;
  for (const CLI::Option* each : options) names += (names.empty() ? "" : ", ") + each->get_name();
  return names;
}

OptionText text_of(const CLI::Option& option, const HelpTexts& help) {
  OptionText text;
  text.group = option.get_group();
  text.is_positional = option.get_positional();
  text.text = option.get_description();
  read_type(option, text);
  if (text.is_positional) {
    const std::string type = option.get_type_name();
    text.names = {type.substr(0, type.find(':'))};
    text.value.clear();
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back('-' + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  const int count = option.get_expected_min();
  if (count > 1) {
    const std::string one = text.value;
    for (int i = 1; i < count && one.find(' ') == std::string::npos; ++i) text.value += ' ' + one;
  }
  const std::string standard = option.get_default_str();
  if (!standard.empty() && option.get_type_size() != 0) {
    text.notes += fmt::format(" (default: {})", standard);
  }
  if (option.get_required() && !text.is_positional) text.notes += " (required)";
  if (!option.get_excludes().empty()) {
    text.notes += fmt::format(" (not with {})", names_of(option.get_excludes()));
  }
  text.is_common = std::ranges::any_of(text.names, [&](const std::string& name) {
    return std::ranges::find(help.common, name) != help.common.end();
  });
  return text;
}

}  // namespace

std::string OptionText::head() const {
  const std::string all = fmt::format("{}", fmt::join(names, ", "));
  return value.empty() ? all : all + ' ' + value;
}

std::string OptionText::brief(std::initializer_list<const char*> stops) const {
  std::size_t end = text.size();
  for (const char* stop : stops) end = std::min(end, text.find(stop));
  std::string cut = text.substr(0, end);
  const std::size_t standard = text.rfind(" (default");
  if (standard != std::string::npos && standard >= end) cut += text.substr(standard);
  const std::size_t excluded = notes.find(" (not with");
  return cut + notes.substr(0, excluded);
}

bool OptionText::is_file() const {
  const std::string& what = is_positional ? names.front() : value;
  return what.starts_with("FILE") || what.find(".json") != std::string::npos;
}

bool OptionText::is_folder() const { return value == "DIR"; }

void set_help(CLI::App& command, HelpTexts texts) {
  for (const std::string& name : texts.common) (void)command.get_option(name);
  command.formatter(std::make_shared<Help>(std::move(texts)));
}

const HelpTexts& help_of(const CLI::App& command) {
  static const HelpTexts none;
  const auto* help = dynamic_cast<const Help*>(command.get_formatter().get());
  return help == nullptr ? none : help->texts();
}

std::vector<OptionText> option_texts(const CLI::App& command) {
  std::vector<OptionText> texts;
  const HelpTexts& help = help_of(command);
  for (const std::string& group : command.get_groups()) {
    if (group.empty()) continue;
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_group() == group) texts.push_back(text_of(*option, help));
    }
  }
  return texts;
}

std::vector<const CLI::App*> shown_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string result;
  for (const std::string& line : split(text, '\n')) {
    if (line.starts_with(' ') || line.empty()) {
      result += line.empty() ? "\n" : std::string(indent, ' ') + line + '\n';
      continue;
    }
    std::size_t at = 0;
    for (const std::string& word : split(line, ' ')) {
      if (word.empty()) continue;
      if (at > 0 && at + 1 + word.size() > width) {
        result += '\n';
        at = 0;
      }
      result += (at == 0 ? std::string(indent, ' ') : " ") + word;
      at += (at == 0 ? indent : 1) + word.size();
    }
    result += '\n';
  }
  return result;
}

}  // namespace nacre::tool
