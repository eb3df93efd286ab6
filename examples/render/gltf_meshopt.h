#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "examples/render/gltf_value.h"

namespace nacre::host {

/// What a buffer view of EXT_meshopt_compression unpacks to; nothing after an error. `packed`: the
/// bytes that `extension`, the object of that name, is of.
std::optional<std::string> unpack_meshopt(const GltfValue& extension, std::string_view packed,
                                          std::size_t most_bytes);

}  // namespace nacre::host
