#pragma once

#include <optional>

#include "examples/render/gltf_value.h"
#include "examples/render/punctual_light.h"

namespace nacre::host {

/// A light of extension KHR_lights_punctual, which stands as `world` says: along its -z. None after
/// an error.
std::optional<PunctualLight> read_light(const GltfValue& light, const Affine& world);

}  // namespace nacre::host
