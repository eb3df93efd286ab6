#pragma once

#include <string>

namespace nacre::fuzz {

/// Reads a scene and renders it in a few pixels, by its own camera and by one that fits;
/// fails where it is refused without a reason or read with an error.
void render_scene(const std::string& path);

}  // namespace nacre::fuzz
