#include "examples/tool/render/technique_options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "examples/tool/number_range.h"

namespace nacre::tool {

void add_techniques(CLI::App& command, host::RenderSettings& settings) {
  host::Techniques& techniques = settings.techniques;
  command.add_flag(
      "--no-caustics{false}", techniques.caustics,
      "Leave out light that mirrors, gloss and glass bring to what scatters diffusely: "
      "less noise, and darker there");
  command.add_flag("--clamp-roughness", techniques.clamps_roughness,
                   "Behind something rough show gloss at least as rough: less noise, and blurred "
                   "there");
  command.add_flag("--draw-texels", techniques.draws_texels,
                   "Images give one of the texels that their filter weighs, drawn for each point: "
                   "quicker look-ups, and noise that more samples take; what several images give "
                   "together is of one texel (not of displacement, media and light shaders, nor of "
                   "what normals are derived from)");
  const std::map<std::string, host::Roulette> kinds{{"none", host::Roulette::none},
                                                    {"throughput", host::Roulette::throughput},
                                                    {"event", host::Roulette::event}};
  command
      .add_option("--roulette", techniques.roulette,
                  "What ends paths early, by chance and with no change of the mean: what light "
                  "they still carry, the root of what one event left of that, or nothing")
      ->transform(
          CLI::CheckedTransformer(kinds, CLI::ignore_case).description("{none,throughput,event}"))
      ->default_str("throughput")
      ->type_name("KIND");
  command
      .add_option("--roulette-depth", settings.roulette_depth,
                  "Scattering events before paths may be ended")
      ->check(number_within(0, 1e9))
      ->capture_default_str();
  command
      .add_option("--split", techniques.split_events,
                  "So many scattering events follow both what is reflected and what is let "
                  "through; later ones one of both, by chance")
      ->check(number_within(0, host::max_split_events))
      ->capture_default_str();
  command
      .add_option("--clamp-indirect", techniques.indirect_limit,
                  "Scale light down to this that a path finds after more than one scattering "
                  "event: fewer bright dots, and darker (default: 0, no limit)")
      ->check(number_within(0, 1e9))
      ->type_name("X");
}

void check_techniques(const host::RenderSettings& settings, Diagnostics& diagnostics) {
  if (settings.techniques.split_events == 0 || !settings.passes.any(host::PassNeed::split)) return;
  diagnostics.error("split-with-passes", {},
                    "light that is told apart by lobes or events takes one way at each of them",
                    "no --split, or no such --aov");
}

void ask_for_techniques(const host::Techniques& techniques, ShaderOptions& shader) {
  shader.kernels.lobes_wanted = techniques.chooses_lobes();
  shader.kernels.min_alpha = techniques.clamps_roughness;
  if (techniques.clamps_roughness) shader.varying.emplace_back("min_alpha");
  if (techniques.draws_texels) shader.varying.emplace_back("texture_u");
}

}  // namespace nacre::tool
