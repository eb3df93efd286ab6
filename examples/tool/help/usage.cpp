#include "examples/tool/help/usage.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "examples/tool/report.h"
#include "runtime/near_names.h"

namespace nacre::tool {

namespace {

/// Of all options, without what stands before all of them.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) names.push_back(command->get_name());
  }
  return names;
}

/// Of a value that is none of those that CLI11 lists: "--format: pgn not in {exr,png,tx}".
std::string value_hint(std::string_view message) {
  constexpr std::string_view between = " not in {";
  const std::size_t list = message.rfind(between);
  const std::size_t option = message.find(": ");
  if (list == message.npos || option == message.npos || option > list) return {};
  const std::string_view value = message.substr(option + 2, list - option - 2);
  NearNames near(value.substr(0, value.find(':')));
  std::string_view known = message.substr(list + between.size());
  known = known.substr(0, known.find('}'));
  while (!known.empty()) {
    const std::size_t comma = known.find(',');
    near.offer(known.substr(0, comma));
    known = comma == known.npos ? std::string_view() : known.substr(comma + 1);
  }
  return near.hint();
}

Diagnostic fault(std::string message) {
  Diagnostic said;
  said.code = "usage";
  said.message = std::move(message);
  return said;
}

/// Of the first word that means nothing.
Diagnostic unexpected(const CLI::App& app, const CLI::App& command, const std::string& word) {
  const std::string called =
      &command == &app ? app.get_name() : app.get_name() + ' ' + command.get_name();
  const std::string name = word.substr(0, word.find('='));
  if (name.starts_with("--")) {
    Diagnostic said = fault(fmt::format("{} has no option {}", called, name));
    NearNames near(std::string_view(name).substr(2));
    for (const std::string& each : option_names(command)) near.offer(each);
    said.hint = near.hint("--");
    return said;
  }
  if (name.starts_with('-')) return fault(fmt::format("{} has no option {}", called, name));
  if (&command != &app) return fault(fmt::format("{} takes no further '{}'", called, word));
  Diagnostic said = fault(fmt::format("{} has no command '{}'", called, word));
  said.hint = near_hint({}, word, command_names(app));
  return said;
}

}  // namespace

const CLI::App& meant_command(const CLI::App& app) {
  const std::vector<CLI::App*> named = app.get_subcommands();
  return named.empty() ? app : *named.front();
}

Diagnostic usage_fault(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = meant_command(app);
  // Before what is missing because of it.
  const std::vector<std::string> extras = command.remaining();
  if (&command == &app && !extras.empty()) return unexpected(app, command, extras.front());
  for (const std::string& word : extras) {
    if (word.starts_with("--") && word.size() > 2) return unexpected(app, command, word);
  }
  if (!extras.empty() && dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    return unexpected(app, command, extras.front());
  }
  if (&command != &app) {
    Diagnostic said = fault(error.what());
    said.hint = value_hint(said.message);
    return said;
  }
  Diagnostic said = fault("a command is missing");
  said.expected = fmt::format("one of {}", fmt::join(command_names(app), ", "));
  return said;
}

void report_usage(const CLI::App& app, const CLI::ParseError& error) {
  std::string text = said_line(usage_fault(app, error));
  if (!report_form().json) {
    const CLI::App& command = meant_command(app);
    text += fmt::format("See: {}{} --help\n", app.get_name(),
                        &command == &app ? "" : ' ' + command.get_name());
  }
  std::fputs(text.c_str(), stderr);
}

}  // namespace nacre::tool
