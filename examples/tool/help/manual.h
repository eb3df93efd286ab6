#pragma once

#include <string>

namespace CLI {
class App;
}

namespace nacre::tool {

/// The page nacre-COMMAND(1) of a subcommand, or nacre(1) of the program, in man(7).
std::string manual_page(const CLI::App& app, const CLI::App& command);

/// The subcommand `manual [COMMAND]`, which prints one, or writes all, and what shells complete,
/// below a folder as they lie below share; it is not listed.
void add_manual(CLI::App& app, int& status);

}  // namespace nacre::tool
