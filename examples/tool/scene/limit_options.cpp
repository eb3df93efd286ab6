#include "examples/tool/scene/limit_options.h"

#include <CLI/CLI.hpp>

#include "examples/tool/number_range.h"

namespace nacre::tool {

void add_scene_limits(CLI::App& command, host::SceneLimits& limits) {
  const auto add = [&](const char* flag, auto& value, const char* what) {
    return command.add_option(flag, value, what)
        ->capture_default_str()
        ->group("Limits, beyond which a scene is refused (sizes: 64MB, 2GB)");
  };
  const auto size = as_size();
  add("--max-scene-file-size", limits.file_bytes, "Bytes of the scene's files together")
      ->transform(size)
      ->type_name("SIZE");
  add("--max-scene-size", limits.bytes, "Bytes of its geometry in memory, with all instances")
      ->transform(size)
      ->type_name("SIZE");
  add("--max-meshes", limits.meshes, "Meshes with all instances")
      ->check(number_within(0, 1e9))
      ->type_name("N");
  add("--max-scene-values", limits.values, "Values of the JSON of a glTF file")
      ->check(number_within(0, 1e9))
      ->type_name("N");
  add("--max-node-depth", limits.node_depth, "Nodes within nodes")
      ->check(number_within(1, 10'000))
      ->type_name("N");
}

}  // namespace nacre::tool
