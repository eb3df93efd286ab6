#pragma once

#include "runtime/diagnostic.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace nacre::tool {

/// The subcommand that the command line names, or the program itself.
const CLI::App& meant_command(const CLI::App& app);

/// What is wrong with a command line, with the commands and options that will have been meant by
/// those that there are not.
Diagnostic usage_fault(const CLI::App& app, const CLI::ParseError& error);

/// Says it on standard error; also, for people, where the options are listed.
void report_usage(const CLI::App& app, const CLI::ParseError& error);

}  // namespace nacre::tool
