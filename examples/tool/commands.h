#pragma once

namespace CLI {
class App;
}

namespace nacre::tool {

/// All of the program's subcommands, with what is the same of each: help, --json where there is
/// something for programs to read, --warnings-as-errors. Running one sets `status`.
void add_commands(CLI::App& app, int& status);

/// What --help, and the manual, says of exit statuses.
extern const char* const exit_statuses;

}  // namespace nacre::tool
