#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/diagnostic.h"

namespace nacre {

/// One file of a set: the image for u in [u, u+1), v in [v, v+1).
struct TileFile {
  int u = 0;         ///< Of the lower left corner, an integer.
  int v = 0;         ///< Of the lower left corner, an integer.
  std::string path;  ///< Of the image file.
};

/// What a set may cost.
struct TileLimits {
  std::size_t max_folder_entries = 100'000;  ///< Of the folder that is listed.
  std::size_t max_tiles = 10'000;            ///< Files of one set.
  std::size_t max_cells = 65'536;            ///< Of the rectangle around all tiles.
};

/// True if the file name has `<UDIM>` or `<UVTILE>`.
bool has_tile_token(std::string_view path);

/// Finds the files that a name with `<UDIM>` or `<UVTILE>` stands for, by listing its folder.
/// MaterialX 1.39 Specification, Filename Substitutions:
///
///   <UDIM>    1001 + floor(u) + 10 floor(v), four digits; u from 0 to 9
///   <UVTILE>  uU_vV with U = 1 + floor(u), V = 1 + floor(v), any integers
///
/// The token may occur several times in the file name, with the same number, but not in
/// the name of a folder, and the two tokens do not mix. Numbers are written without
/// leading zeros. Files come sorted by v, then u. Nothing, and an error in `diagnostics`,
/// when no file matches, the folder cannot be listed, or a limit is exceeded.
std::optional<std::vector<TileFile>> find_tiles(const std::string& pattern,
                                                const TileLimits& limits, Diagnostics& diagnostics);

/// The directory that a sampler picks tiles from, as 32-bit words:
///
///   word   type   meaning
///   0      u32    tile_directory_magic
///   1      i32    u of the first column        2   i32   v of the first row
///   3      i32    columns                      4   i32   rows
///   5      i32    number of tiles
///   6-15   0      reserved
///   16+k   u32    cell k = (floor(v) - first row) * columns + (floor(u) - first column):
///                 number of the tile's file in the set, or no_tile
///
/// A point whose cell lies outside, or holds no_tile, takes the node's default. Inside a
/// tile the coordinates are u - floor(u), v - floor(v), and taps clamp at its edge.
inline constexpr std::uint32_t tile_directory_magic = 0x4e545301;  // "NTS" and version 1
inline constexpr std::uint32_t no_tile = 0xffffffffu;              ///< In a cell without a file.
/// Tables of kernels that say in which slot a cell's tile is, or -1, have names that begin so.
inline constexpr std::string_view tile_table_prefix = "tiles.";
inline constexpr std::size_t tile_directory_header_words = 16;  ///< Cells begin behind them.

/// `tiles` as find_tiles gives them; not empty.
std::vector<std::uint32_t> tile_directory(const std::vector<TileFile>& tiles);

}  // namespace nacre
