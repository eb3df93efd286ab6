#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

namespace nacre {

struct ImageLimits;

/// Why the header of an OpenEXR file is not to be trusted; nothing if it is. OpenEXR
/// allocates what an attribute claims before it reads it, so every size is held against
/// the `file_bytes` that there are, and windows and tiles against the limits. (OpenEXR
/// File Layout; of what is inside attributes only what holds sizes of its own is read.)
std::optional<std::string> exr_header_fault(std::istream& file, std::uint64_t file_bytes,
                                            const ImageLimits& limits);

}  // namespace nacre
