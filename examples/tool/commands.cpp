#include "examples/tool/commands.h"

#include <CLI/CLI.hpp>

#include "examples/tool/help/completion.h"
#include "examples/tool/help/manual.h"
#include "examples/tool/help/option_text.h"
#include "examples/tool/options.h"
#include "examples/tool/report.h"

namespace nacre::tool {

namespace {

struct Command {
  const char* name;
  void (*add)(CLI::App&, int&);
  HelpTexts help;
};

std::vector<Command> commands() {
  return {
      {"bake",
       add_bake,
       {{"--output", "--material", "--document", "--size", "--format", "--samples", "--udim",
         "--window", "--scene", "--out", "--search-path", "--library", "--json", "--quiet"},
        {"nacre bake marble.mtlx --size 1024 --out textures",
         "nacre bake wood.mtlx --document baked.mtlx --size 2048 --format png",
         "nacre bake worn.mtlx --scene vase.glb --udim auto --out textures"}}},
      {"check",
       add_check,
       {{"--lobes", "--lobe", "--lenient", "--strict", "--search-path", "--library", "--json",
         "--warnings-as-errors", "--quiet"},
        {"nacre check marble.mtlx", "nacre check --strict --json marble.mtlx",
         "nacre check pack.mtlx --lobe pack_dust"}}},
      {"convert",
       add_convert,
       {{"--out", "--flatten", "--search-path", "--json", "--quiet"},
        {"nacre convert old.mtlx --out new.mtlx",
         "nacre convert look.mtlx --flatten --out alone.mtlx"}}},
      {"inspect",
       add_inspect,
       {{"--material", "--output", "--dump", "--cost", "--error", "--live", "--accuracy",
         "--search-path", "--library", "--json"},
        {"nacre inspect marble.mtlx --cost",
         "nacre inspect marble.mtlx --output NG_marble/out --dump program"}}},
      {"render",
       add_render,
       {{"--material", "--scene", "--out", "--size", "--spp", "--noise", "--time-limit",
         "--environment", "--aov", "--denoise", "--camera", "--frames", "--frame", "--time",
         "--search-path", "--library", "--json", "--quiet"},
        {"nacre render gold.mtlx --material Gold --size 512 --out gold.png",
         "nacre render look.mtlx --scene vase.glb --spp 256 --out vase.exr",
         "nacre render look.mtlx --scene vase.glb --aov albedo,normal --out vase.exr"}}},
      {"tune",
       add_tune,
       {{"--material", "--output", "--max-error", "--metric", "--recorded", "--profile", "--plot",
         "--time-limit", "--no-times", "--search-path", "--library", "--json", "--quiet"},
        {"nacre tune gold.mtlx --material Gold --max-error 0.001",
         "nacre tune gold.mtlx --recorded points.json --profile gold.json"}}},
  };
}

constexpr const char* answers =
    "With --json standard output has one JSON document and nothing else, of what failed too "
    "(status "
    "2: none), and standard error a JSON object a line for each thing said: severity, code, file, "
    "line, column, path, message, expected, found, hint as far as known, and text, all in one.";

}  // namespace

const char* const exit_statuses =
    "Exit status: 0 done, 1 problems (on standard error; with --warnings-as-errors warnings too), "
    "2 usage; stopped by SIGINT, SIGTERM or SIGHUP before all was written, death by that signal, "
    "which shells call 128 + its number.";

void add_commands(CLI::App& app, int& status) {
  app.set_help_flag("-h,--help", "Show this, with the options that are used most");
  app.set_help_all_flag("--help-all", "Show all options");
  app.set_version_flag("--version", NACRE_TOOL_VERSION, "Show the version");
  app.require_subcommand(1);
  for (const Command& each : commands()) {
    each.add(app, status);
    CLI::App& command = *app.get_subcommand(each.name);
    add_report_options(command);
    command.footer(command.get_footer() + (command.get_footer().empty() ? "" : "\n\n") + answers +
                   "\n\n" + exit_statuses);
    set_help(command, each.help);
  }
  add_completion(app, status);
  add_manual(app, status);
  app.footer(exit_statuses);
  set_help(app, {{},
                 {"nacre bake marble.mtlx --size 1024 --out textures",
                  "nacre render marble.mtlx --material Marble --spp 64 --out marble.png",
                  "nacre check marble.mtlx"}});
}

}  // namespace nacre::tool
