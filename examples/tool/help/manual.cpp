#include "examples/tool/help/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "examples/common/atomic_file.h"
#include "examples/tool/commands.h"
#include "examples/tool/help/completion.h"
#include "examples/tool/help/option_text.h"
#include "examples/tool/options.h"

namespace nacre::tool {

namespace {

/// Text as troff takes it: hyphens that are typed stay so, and no line is a request.
std::string escaped(std::string_view text) {
  std::string result;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    begins_line = c == '\n';
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

std::string section(const char* title) { return fmt::format(".SH {}\n", title); }

/// Paragraphs are apart by empty lines; lines that begin with a space stay as they are.
std::string paragraphs(const std::string& text) {
  std::string result;
  bool is_kept = false;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const bool keeps = line.starts_with(' ');
    if (keeps != is_kept) result += keeps ? ".PP\n.nf\n" : ".fi\n";
    is_kept = keeps;
    result += line.empty() ? ".PP\n" : escaped(line) + '\n';
  }
  return is_kept ? result + ".fi\n" : result;
}

std::string option_list(const CLI::App& command) {
  std::string text;
  std::string group;
  for (const OptionText& option : option_texts(command)) {
    if (option.is_positional) continue;
    if (option.group != group) text += fmt::format(".SS {}\n", escaped(option.group));
    group = option.group;
    text +=
        fmt::format(".TP\n\\fB{}\\fR", escaped(fmt::format("{}", fmt::join(option.names, ", "))));
    if (!option.value.empty()) text += fmt::format(" \\fI{}\\fR", escaped(option.value));
    text += '\n' + escaped(option.text + option.notes) + '\n';
  }
  return text;
}

std::string example_list(const CLI::App& command) {
  std::string text;
  for (const std::string& line : help_of(command).examples) {
    text += escaped(line) + '\n';
  }
  return text.empty() ? text : ".nf\n.RS 4\n" + text + ".RE\n.fi\n";
}

std::string see_also(const CLI::App& app, const CLI::App& command) {
  std::string text = &command == &app ? "" : fmt::format(".BR {} (1),\n", app.get_name());
  for (const CLI::App* each : shown_commands(app)) {
    if (each != &command) {
      text += fmt::format(".BR {}\\-{} (1),\n", app.get_name(), each->get_name());
    }
  }
  return text + fmt::format(".BR {} (3)\n", app.get_name());
}

}  // namespace

std::string manual_page(const CLI::App& app, const CLI::App& command) {
  const bool is_program = &command == &app;
  const std::string called =
      is_program ? app.get_name() : app.get_name() + '-' + command.get_name();
  std::string text =
      fmt::format(".\\\" Made by `{} manual`.\n.TH {} 1 \"\" \"{} {}\"\n", app.get_name(),
                  escaped(called), app.get_name(), NACRE_TOOL_VERSION);
  text += section("NAME") +
          fmt::format("{} \\- {}\n", escaped(called), escaped(command.get_description()));
  text += section("SYNOPSIS");
  if (is_program) {
    text += fmt::format(".B {}\n.I COMMAND\n[\\fIOPTION\\fR]...\n", app.get_name());
  } else {
    text += fmt::format(".B {} {}\n[\\fIOPTION\\fR]...", app.get_name(), command.get_name());
    for (const OptionText& each : option_texts(command)) {
      if (each.is_positional) text += fmt::format(" \\fI{}\\fR", escaped(each.names.front()));
    }
    text += '\n';
  }
  if (is_program) {
    text += section("COMMANDS");
    for (const CLI::App* each : shown_commands(app)) {
      text += fmt::format(".TP\n.BR {}\\-{} (1)\n{}\n", app.get_name(), each->get_name(),
                          escaped(each->get_description()));
    }
  }
  text += section("DESCRIPTION") +
          paragraphs(command.get_description() + ".\n\n" + command.get_footer());
  text += section("OPTIONS") + option_list(command);
  text += section("EXAMPLES") + example_list(command);
  return text + section("SEE ALSO") + see_also(app, command);
}

namespace {

/// Files below `folder`.
int write_all(const CLI::App& app, const std::filesystem::path& folder) {
  std::map<std::string, std::string> files{
      {"man/man1/nacre.1", manual_page(app, app)},
      {"bash-completion/completions/nacre", completion_script(app, "bash")},
      {"fish/vendor_completions.d/nacre.fish", completion_script(app, "fish")},
      {"zsh/site-functions/_nacre", completion_script(app, "zsh")}};
  for (const CLI::App* each : shown_commands(app)) {
    files[fmt::format("man/man1/nacre-{}.1", each->get_name())] = manual_page(app, *each);
  }
  Diagnostics diagnostics;
  for (const auto& [name, text] : files) {
    const std::string file = (folder / name).string();
    if (!host::prepare_output(file, diagnostics) ||
        !host::write_text_atomically(file, text, diagnostics)) {
      break;
    }
  }
  return report(diagnostics);
}

}  // namespace

void add_manual(CLI::App& app, int& status) {
  CLI::App& command = *app.add_subcommand("manual", "Print a page of the manual, in man(7)");
  command.group("");  // For who builds or packages the program.
  const auto name = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const CLI::App* each : shown_commands(app)) names.push_back(each->get_name());
  command.add_option("COMMAND", *name, "The command whose page it is (default: the program's)")
      ->check(CLI::IsMember(names))
      ->type_name("COMMAND");
  const auto folder = std::make_shared<std::string>();
  command.add_option("--write", *folder, "Write all pages, and completions, below this folder")
      ->type_name("DIR");
  command.callback([&app, &status, name, folder] {
    if (!folder->empty()) {
      status = write_all(app, *folder);
      return;
    }
    const CLI::App* of = &app;
    if (!name->empty()) of = app.get_subcommand(*name);
    fmt::print("{}", manual_page(app, *of));
    status = status_ok;
  });
}

}  // namespace nacre::tool
