#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "examples/tool/check/lobes.h"
#include "examples/tool/number_range.h"
#include "examples/tool/options.h"
#include "examples/tool/process.h"
#include "jit/graph/build/build.h"
#include "jit/graph/find.h"

namespace nacre::tool {

namespace {

using Json = nlohmann::ordered_json;

/// What a machine lacks is no problem of a document's.
bool is_problem(const Diagnostic& said) { return said.code != "no-worker"; }

/// What there is to say of a document, for programs.
Json answer(const CommonOptions& options, const Diagnostics& diagnostics, bool is_ok) {
  Json said = Json::array();
  for (const Diagnostic& each : diagnostics.all()) said.push_back(json_of(each));
  return {{"document", options.file},
          {"ok", is_ok},
          {"errors", diagnostics.error_count()},
          {"warnings", diagnostics.warning_count()},
          {"diagnostics", std::move(said)}};
}

/// Builds every graph of the document; kernels are compiled for their lobes alone.
int run(const CommonOptions& options, const LobeCheck& lobes) {
  Diagnostics diagnostics;
  Json found = Json::array();
  const Opened opened = open(options, diagnostics);
  if (opened) {
    opened.system->check(*opened.document, options.shader_options(), diagnostics);
    if (lobes.is_wanted() && !diagnostics.has_errors()) {
      check_lobes(options, lobes, opened, found, diagnostics);
    }
  }
  report(diagnostics);
  const bool is_ok = std::ranges::none_of(diagnostics.all(), is_problem);
  const int status = is_ok ? status_ok : status_problems;
  if (lobes.json) print_json(lobes.is_wanted() ? found : answer(options, diagnostics, is_ok));
  if (!options.quiet && !lobes.json && status == status_ok) fmt::print("{}: ok\n", options.file);
  return status;
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App& command = *app.add_subcommand("check", "Say what is wrong with a document");
  options->add_document(command);
  options->add_compile(command);
  const auto lobes = std::make_shared<LobeCheck>();
  command.add_flag(
      "--lobes", lobes->materials,
      "Also try what every closure must hold on each material, at texture coordinates 0: samples "
      "follow the density, no more light leaves than arrives, all is finite");
  command
      .add_option("--lobe", lobes->nodes,
                  "The same of these nodes, or nodedefs, whose output is a BSDF: each alone, with "
                  "its defaults, the ends of its inputs (uimin, uimax) and what lies between")
      ->delimiter(',')
      ->type_name("NODE[,...]");
  const std::vector<CLI::Option*> details{
      command.add_option("--sets", lobes->sets, "Of inputs that each --lobe is tried with")
          ->check(CLI::Range(1, 10'000))
          ->capture_default_str(),
      command.add_option("--samples", lobes->effort.samples, "Of each view of a material or lobe")
          ->check(CLI::Range(1000, 100'000'000))
          ->capture_default_str(),
      command.add_option("--most-energy", lobes->effort.most_energy, "Light that may leave of 1")
          ->check(number_within(0))
          ->capture_default_str()};
  command.add_flag("--json", lobes->json,
                   "For programs to read: an object with what is wrong; with --lobes or --lobe a "
                   "list of what was found of each");
  command.footer("A warning is a problem too, but for what this machine lacks.");
  command.callback([=, &status] {
    for (const CLI::Option* detail : details) {
      if (detail->count() == 0 || lobes->is_wanted()) continue;
      throw CLI::RequiresError(detail->get_name(), "--lobes or --lobe");
    }
    status = guarded(options->file, [&] { return run(*options, *lobes); });
  });
}

}  // namespace nacre::tool
