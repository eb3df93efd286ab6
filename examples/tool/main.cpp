#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "examples/tool/commands.h"
#include "examples/tool/help/usage.h"
#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "examples/tool/stop.h"

namespace {

using namespace nacre::tool;

/// What is wrong with the command line itself is said in the form that it asks for.
bool asks_for_json(int argc, char** argv) {
  return std::find(argv + std::min(argc, 1), argv + argc, std::string_view("--json")) !=
         argv + argc;
}

}  // namespace

int main(int argc, char** argv) {
  prepare_process();
  const StopOnSignal signals;
  CLI::App app{"nacre: MaterialX shading on the CPU, compiled to SIMD machine code", "nacre"};
  int status = status_ok;
  add_commands(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // For help, or the version.
    app.exit(asked);
  } catch (const CLI::ParseError& error) {
    set_report_form({asks_for_json(argc, argv), false});
    report_usage(app, error);
    status = status_usage;
  }
  status = finish_output(status);
  const bool failed = stop().is_due() && status != status_ok;
  if (failed || is_stopped_early()) end_stopped();
  return status;
}
