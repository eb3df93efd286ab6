#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nacre {

/// The chunks of a PNG file that its pixels need (IHDR, PLTE, tRNS, IDAT, IEND), in order,
/// after checking that the file is whole and every chunk's checksum right (PNG
/// Specification, Third Edition, 5). Nothing, and a reason, for a damaged file.
///
/// libpng writes its complaints to stderr, which a library must not: damaged files are
/// sorted out before it sees them, and so are the profiles and comments it warns about.
std::optional<std::string> essential_png(std::string_view file, std::string& reason);

}  // namespace nacre
