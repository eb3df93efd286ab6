#include "examples/tool/render/denoise_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace nacre::tool {

void DenoiseOptions::add(CLI::App& command) {
  command.add_flag(
      "--denoise", is_asked,
      "Denoise the picture by Open Image Denoise; an .exr also has layers noisy, what "
      "it was, and albedo and normal, which guide it. Layers of light stay as they are");
  command
      .add_option("--denoise-library", library,
                  "Its libOpenImageDenoise.so, version 2 (default: that of the system)")
      ->envname("NACRE_OPENIMAGEDENOISE")
      ->type_name("FILE");
}

void ask_for_guides(const DenoiseOptions& options, host::PassRequest& passes) {
  if (!options.is_asked) return;
  for (const char* const name : {"albedo", "normal"}) {
    const bool is_there = std::ranges::any_of(
        passes.passes, [&](const host::Pass& pass) { return pass.name == name; });
    if (!is_there) passes.passes.push_back(*host::find_pass(name));
  }
}

}  // namespace nacre::tool
