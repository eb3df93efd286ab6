#pragma once

#include <string>

namespace nacre::host {

/// Writes a tiled, mip-mapped texture again, `from` one file `to` another, without a date
/// and with zeros in tiles beyond the image's edges: there the writer of levels leaves what
/// the memory held, and equal textures would differ. "", or what went wrong.
std::string copy_levels(const std::string& from, const std::string& to);

}  // namespace nacre::host
