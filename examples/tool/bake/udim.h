#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// A tile of a texture: uv from (u, v) to (u + 1, v + 1).
struct UdimTile {
  int u = 0;  ///< 0 to 9.
  int v = 0;  ///< 0 to 899.

  /// 1001 + u + 10 v (MaterialX 1.39 Specification, "Filename Substitutions").
  std::string number() const;
  bool operator==(const UdimTile&) const = default;
};

/// What --udim says, without what is said twice: numbers with commas between them, or
/// "auto" for what the document says (below). Nothing for "", with a warning where the
/// document has tiles; empty, and an error, for what cannot be understood. Tiles that the
/// document does not have are an error; a warning where it says nothing of any.
std::vector<UdimTile> read_tiles(std::string_view text, const Document& document,
                                 const std::vector<std::string>& search_paths,
                                 Diagnostics& diagnostics, bool anywhere = false);

/// Numbers with commas between them, without what is said twice; empty, and an error at `where`,
/// for what cannot be understood.
std::vector<UdimTile> parse_tiles(std::string_view text, const SourceLocation& where,
                                  Diagnostics& diagnostics);

/// The tiles that a document is made of: the udimset of its geometries (MaterialX 1.39
/// Geometry Extensions, "Reserved GeomProp Names"), and without one the files that its
/// names with <UDIM> or <UVTILE> stand for, beside it or on the search paths, and below
/// those folders unless files may lie `anywhere`.
std::vector<UdimTile> tiles_of(const Document& document,
                               const std::vector<std::string>& search_paths,
                               Diagnostics& diagnostics, bool anywhere = false);

}  // namespace nacre::tool
