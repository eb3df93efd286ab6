#include <CLI/CLI.hpp>

#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "examples/tool/stop.h"

namespace {

constexpr const char* footer =
    R"(Exit status: 0 done, 1 problems (on standard error), 2 usage; stopped by SIGINT, SIGTERM or
SIGHUP before all was written, death by that signal, which shells call 128 + its number.

Examples:
  nacre bake marble.mtlx --size 1024 --out textures
  nacre render marble.mtlx --material Marble_3D --spp 64 --size 512x512 --out marble.png
  nacre check marble.mtlx)";

}  // namespace

int main(int argc, char** argv) {
  nacre::tool::prepare_process();
  const nacre::tool::StopOnSignal signals;
  CLI::App app{"nacre: MaterialX shading on the CPU, compiled to SIMD machine code", "nacre"};
  app.set_version_flag("--version", NACRE_TOOL_VERSION);
  app.require_subcommand(1);
  app.footer(footer);
  int status = nacre::tool::status_ok;
  nacre::tool::add_bake(app, status);
  nacre::tool::add_check(app, status);
  nacre::tool::add_convert(app, status);
  nacre::tool::add_inspect(app, status);
  nacre::tool::add_render(app, status);
  nacre::tool::add_tune(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    status = app.exit(error) == 0 ? nacre::tool::status_ok : nacre::tool::status_usage;
  }
  status = nacre::tool::finish_output(status);
  const bool failed = nacre::tool::stop().is_due() && status != nacre::tool::status_ok;
  if (failed || nacre::tool::is_stopped_early()) nacre::tool::end_stopped();
  return status;
}
