#pragma once

#include <string>

namespace CLI {
class App;
}

namespace nacre::tool {

/// What a shell reads to complete the program's command lines: "bash", "fish" or "zsh".
std::string completion_script(const CLI::App& app, const std::string& shell);

/// The subcommand `completion SHELL`, which prints it.
void add_completion(CLI::App& app, int& status);

}  // namespace nacre::tool
