#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "examples/render/scene_limits.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// The two parts of a glTF file (2.0, chapters 3 and 4).
struct GltfFile {
  nlohmann::json root;
  std::optional<std::string> binary;  ///< The BIN chunk of a .glb.
};

/// Takes a .gltf or .glb apart; nothing, with an error, if it is no JSON, holds more
/// values than the limits, is no version of 2, or is a .glb with wrong lengths.
std::optional<GltfFile> parse_gltf_file(const std::string& file, std::string bytes,
                                        const SceneLimits& limits, Diagnostics& diagnostics);

}  // namespace nacre::host
