#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "jit/graph/build/build.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

/// Builds every graph of the document; kernels are not compiled.
int run(const CommonOptions& options) {
  Diagnostics diagnostics;
  const Opened opened = open(options, diagnostics);
  if (opened) {
    opened.system->check(*opened.document, options.shader_options(), diagnostics);
  }
  report(diagnostics);
  const int status = diagnostics.all().empty() ? status_ok : status_problems;
  if (!options.quiet && status == status_ok) fmt::print("{}: ok\n", options.file);
  return status;
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App& command = *app.add_subcommand("check", "Say what is wrong with a document");
  options->add_document(command);
  command.footer("Exit status: 0 clean, 1 problems, 2 usage.");
  command.callback(
      [options, &status] { status = guarded(options->file, [&] { return run(*options); }); });
}

}  // namespace nacre::tool
