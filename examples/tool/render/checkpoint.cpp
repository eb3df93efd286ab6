#include "examples/tool/render/checkpoint.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "examples/tool/bake/inputs.h"
#include "examples/tool/scene/digest.h"
#include "examples/tool/scene/materials.h"
#include "jit/document/write.h"

namespace nacre::tool {

std::string asked_of(const CLI::App& command) {
  // What a picture of a series is of is in its key by itself.
  constexpr std::string_view others[] = {
      "out",      "threads",      "time-limit",         "checkpoint", "quiet",
      "no-cache", "compile-here", "checkpoint-every",   "cache",      "wait-for-code",
      "json",     "lenient",      "warnings-as-errors", "camera",     "frames",
      "time",     "frame",        "skip-existing"};
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || std::ranges::any_of(others, [&](auto name) {
          return option->check_lname(std::string(name));
        })) {
      continue;
    }
    text += option->get_name() + '=';
    for (const std::string& each : option->results()) text += each + ' ';
    text += '\n';
  }
  return text;
}

std::optional<std::string> render_key(const RenderOptions& options, const Opened& opened,
                                      const host::RenderInput& input,
                                      const host::RenderSettings& settings,
                                      const std::vector<const BoundKernel*>& kernels,
                                      Diagnostics& diagnostics) {
  BakeManifest inputs;
  if (!describe_inputs(options.common, opened, inputs, diagnostics)) return {};
  InputDigests digests;
  Facts images;
  for (const BoundKernel* kernel : kernels) {
    for (const auto& [path, then] : kernel->files()) {
      FileIdentity now;
      images[path] = digests.of(path, &now);
      if (now == then) continue;
      diagnostics.error("input-changed", {path, 0, 0, {}}, "the file was written while it was used",
                        "the same file to the end");
      return {};
    }
  }
  if (!options.environment.empty()) images[options.environment] = digests.of(options.environment);
  std::string key = options.asked + inputs.version + '\n' + digest_of(*input.scene) + '\n';
  key += digest_of(input.camera, input.camera_motion);
  key += fmt::format("\n{} {}\n", settings.time, settings.frame);
  // What was made of the scene is in no file.
  if (has_own_materials(options)) key += write_document(*opened.document);
  for (const Facts* facts : {&inputs.inputs, &inputs.options, &images}) {
    for (const auto& [name, text] : *facts) key += name + '=' + text + '\n';
  }
  return key;
}

}  // namespace nacre::tool
