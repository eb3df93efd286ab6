#pragma once

#include <string>

#include "examples/render/scene.h"

namespace nacre::tool {

/// Of all that a scene has to be seen of, in hexadecimal, as it was loaded: buffers of glTF files,
/// say, are files of their own, and what is animated stands elsewhere at another time.
std::string digest_of(const host::Scene& scene);
/// Of a camera and where it is while the shutter is open.
std::string digest_of(const host::Camera& camera, const host::Motion& motion);

}  // namespace nacre::tool
