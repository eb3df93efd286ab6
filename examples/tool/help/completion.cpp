#include "examples/tool/help/completion.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "examples/tool/help/option_text.h"
#include "examples/tool/options.h"

namespace nacre::tool {

namespace {

/// For a list.
std::string brief(const OptionText& option) {
  OptionText alone;
  alone.text = option.text.substr(0, option.text.find(" ("));
  return alone.brief({": ", "; ", ". "});
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

std::vector<OptionText> typed_options(const CLI::App& command) {
  std::vector<OptionText> options = option_texts(command);
  std::erase_if(options, [](const OptionText& each) { return each.is_positional; });
  return options;
}

std::string all_names(const std::vector<OptionText>& options) {
  std::string names;
  for (const OptionText& each : options) {
    for (const std::string& name : each.names) names += (names.empty() ? "" : " ") + name;
  }
  return names;
}

std::string command_words(const CLI::App& app) {
  std::string words;
  for (const CLI::App* each : shown_commands(app)) {
    words += (words.empty() ? "" : " ") + each->get_name();
  }
  return words;
}

/// Words that stand in place of FILE: those of `completion SHELL`; empty for files.
std::vector<std::string> positional_words(const CLI::App& command) {
  for (const OptionText& each : option_texts(command)) {
    if (each.is_positional && !each.choices.empty()) return each.choices;
  }
  return {};
}

// -- bash ---------------------------------------------------------------------------------

/// What stands behind an option.
std::string bash_values(const OptionText& option) {
  if (!option.choices.empty()) return fmt::format("words '{}'", fmt::join(option.choices, " "));
  if (option.is_folder()) return "folders";
  return option.is_file() ? "files" : ":";
}

std::string bash_command(const CLI::App& command) {
  const std::vector<OptionText> options = typed_options(command);
  std::string text = fmt::format("    {})\n      case $previous in\n", command.get_name());
  for (const OptionText& each : options) {
    if (each.value.empty()) continue;
    text += fmt::format("        {}) {}; return ;;\n", fmt::join(each.names, "|"),
                        replaced(bash_values(each), "words", "_nacre_words"));
  }
  const auto words = positional_words(command);
  text += fmt::format(
      "      esac\n      if [[ $current == -* ]]; then _nacre_words '{}'\n      else {}\n      fi "
      ";;\n",
      all_names(options),
      words.empty() ? "documents" : fmt::format("_nacre_words '{}'", fmt::join(words, " ")));
  for (const char* kind : {"folders", "files", "documents"}) {
    text = replaced(text, fmt::format(") {};", kind), fmt::format(") _nacre_{};", kind));
    text = replaced(text, fmt::format("else {}\n", kind), fmt::format("else _nacre_{}\n", kind));
  }
  return text;
}

constexpr const char* bash_head =
    R"(# Completion of nacre for bash. Made by `nacre completion bash`.

_nacre_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current"); }
_nacre_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$current")
}
_nacre_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$current")
}
_nacre_documents() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X '!*.mtlx' -- "$current")
}

_nacre() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  # Readline splits --option=value in three.
  if [[ $current == "=" ]]; then
    current=
  elif [[ $previous == "=" ]]; then
    previous=${COMP_WORDS[COMP_CWORD-2]}
  fi
  if ((COMP_CWORD == 1)); then
)";

std::string bash_script(const CLI::App& app) {
  std::string text = bash_head;
  text += fmt::format("    _nacre_words '{} {}'\n    return\n  fi\n  case ${{COMP_WORDS[1]}} in\n",
                      command_words(app), all_names(typed_options(app)));
  for (const CLI::App* command : shown_commands(app)) text += bash_command(*command);
  return text + "  esac\n}\n\ncomplete -F _nacre nacre\n";
}

// -- zsh ----------------------------------------------------------------------------------

/// Within the single quotes and brackets of a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result;
}

std::string zsh_values(const OptionText& option) {
  if (option.value.empty()) return {};
  const std::string title = ':' + zsh_text(option.value) + ':';
  if (!option.choices.empty()) return fmt::format("{}({})", title, fmt::join(option.choices, " "));
  if (option.is_folder()) return title + "_files -/";
  return option.is_file() ? title + "_files" : title;
}

std::string zsh_command(const CLI::App& command) {
  std::string text = fmt::format("    {})\n      _arguments", command.get_name());
  for (const OptionText& each : typed_options(command)) {
    for (const std::string& name : each.names) {
      text +=
          fmt::format(" \\\n        '*{}[{}]{}'", name, zsh_text(brief(each)), zsh_values(each));
    }
  }
  const auto words = positional_words(command);
  return text + (words.empty()
                     ? " \\\n        '1:document:_files -g \"*.mtlx\"' ;;\n"
                     : fmt::format(" \\\n        '1:word:({})' ;;\n", fmt::join(words, " ")));
}

std::string zsh_script(const CLI::App& app) {
  std::string text = "#compdef nacre\n# Made by `nacre completion zsh`.\n\n_nacre() {\n";
  text += "  local line state\n  _arguments -C";
  for (const OptionText& each : typed_options(app)) {
    for (const std::string& name : each.names) {
      text += fmt::format(" \\\n    '{}[{}]'", name, zsh_text(brief(each)));
    }
  }
  text +=
      " \\\n    '1: :->command' '*::argument:->argument'\n  case $state in\n    command)\n"
      "      local -a commands=(\n";
  for (const CLI::App* command : shown_commands(app)) {
    text +=
        fmt::format("        '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
  }
  text += "      )\n      _describe command commands ;;\n    argument)\n  case $line[1] in\n";
  for (const CLI::App* command : shown_commands(app)) text += zsh_command(*command);
  return text + "  esac ;;\n  esac\n}\n\n_nacre \"$@\"\n";
}

// -- fish ---------------------------------------------------------------------------------

std::string fish_text(const std::string& text) {
  return '\'' + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + '\'';
}

std::string fish_option(const std::string& condition, const OptionText& option) {
  std::string text = "complete -c nacre -n " + fish_text(condition);
  for (const std::string& name : option.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.choices.empty()) {
    text += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
  } else if (option.is_folder()) {
    text += " -x -a '(__fish_complete_directories)'";
  } else if (option.is_file()) {
    text += " -r -F";
  } else if (!option.value.empty()) {
    text += " -x";
  }
  return text + " -d " + fish_text(brief(option)) + '\n';
}

std::string fish_script(const CLI::App& app) {
  std::string text = "# Completion of nacre for fish. Made by `nacre completion fish`.\n\n";
  const std::string first = "__fish_use_subcommand";
  for (const OptionText& each : typed_options(app)) text += fish_option(first, each);
  for (const CLI::App* command : shown_commands(app)) {
    text += fmt::format("complete -c nacre -n {} -f -a {} -d {}\n", first, command->get_name(),
                        fish_text(command->get_description()));
  }
  for (const CLI::App* command : shown_commands(app)) {
    const std::string seen = "__fish_seen_subcommand_from " + command->get_name();
    for (const OptionText& each : typed_options(*command)) text += fish_option(seen, each);
    if (const auto words = positional_words(*command); !words.empty()) {
      text += fmt::format("complete -c nacre -n '{}' -f -a '{}'\n", seen, fmt::join(words, " "));
    }
  }
  return text;
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash_script(app);
  return shell == "zsh" ? zsh_script(app) : fish_script(app);
}

void add_completion(CLI::App& app, int& status) {
  CLI::App& command =
      *app.add_subcommand("completion", "Print what a shell needs to complete these commands");
  const auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "The shell")
      ->required()
      ->check(CLI::IsMember({"bash", "fish", "zsh"}))
      ->type_name("SHELL");
  command.footer(
      "An installed nacre has them where shells look for them. Else, for this session:\n"
      "  bash, zsh  source <(nacre completion bash)\n"
      "  fish       nacre completion fish | source");
  set_help(command, {{},
                     {"nacre completion bash > ~/.local/share/bash-completion/completions/nacre",
                      "nacre completion fish > ~/.config/fish/completions/nacre.fish"}});
  command.callback([&app, &status, shell] {
    fmt::print("{}", completion_script(app, *shell));
    status = status_ok;
  });
}

}  // namespace nacre::tool
