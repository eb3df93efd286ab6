#include "runtime/texture/tile_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <filesystem>
#include <system_error>

#include "runtime/texture/image_format.h"

namespace nacre {

namespace {

constexpr std::string_view udim_token = "<UDIM>";
constexpr std::string_view uvtile_token = "<UVTILE>";

/// Reads a canonical decimal from the front of `text`: no sign but '-', no leading zeros.
std::optional<int> take_number(std::string_view& text) {
  int value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc()) return std::nullopt;
  const auto length = static_cast<std::size_t>(parsed.ptr - text.data());
  if (fmt::format("{}", value) != text.substr(0, length)) return std::nullopt;
  text.remove_prefix(length);
  return value;
}

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

struct Cell {
  int u = 0;
  int v = 0;
};

std::optional<Cell> take_udim(std::string_view& text) {
  const auto number = take_number(text);
  if (!number || *number < 1001 || *number > 9999) return std::nullopt;
  return Cell{(*number - 1001) % 10, (*number - 1001) / 10};
}

std::optional<Cell> take_uvtile(std::string_view& text) {
  constexpr int far = 1 << 20;  // Keeps differences of cells in an int.
  if (!take(text, "u")) return std::nullopt;
  const auto u = take_number(text);
  if (!u || !take(text, "_v")) return std::nullopt;
  const auto v = take_number(text);
  if (!v || std::abs(*u) > far || std::abs(*v) > far) return std::nullopt;
  return Cell{*u - 1, *v - 1};
}

std::vector<std::string_view> split(std::string_view text, std::string_view token) {
  std::vector<std::string_view> parts;
  for (auto at = text.find(token); at != std::string_view::npos; at = text.find(token)) {
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + token.size());
  }
  parts.push_back(text);
  return parts;
}

/// The cell a file name stands for, given the constant parts around the tokens. A UDIM is
/// followed by whatever text follows it, even digits: it takes exactly four.
std::optional<Cell> match(std::string_view name, const std::vector<std::string_view>& parts,
                          bool udim) {
  std::optional<Cell> cell;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!take(name, parts[i])) return std::nullopt;
    if (i + 1 == parts.size()) break;
    std::optional<Cell> here;
    if (udim) {
      std::string_view digits = name.substr(0, 4);
      here = take_udim(digits);
      if (here && digits.empty()) name.remove_prefix(4);
      if (!digits.empty()) return std::nullopt;
    } else {
      here = take_uvtile(name);
    }
    if (!here || (cell && (cell->u != here->u || cell->v != here->v))) return std::nullopt;
    cell = here;
  }
  return name.empty() ? cell : std::nullopt;
}

/// Columns times rows of the rectangle around all tiles.
std::size_t cells_around(const std::vector<TileFile>& tiles) {
  const auto [left, right] = std::minmax_element(
      tiles.begin(), tiles.end(), [](const auto& a, const auto& b) { return a.u < b.u; });
  return static_cast<std::size_t>(right->u - left->u + 1) *
         static_cast<std::size_t>(tiles.back().v - tiles.front().v + 1);
}

}  // namespace

bool has_tile_token(std::string_view path) {
  return path.find(udim_token) != std::string_view::npos ||
         path.find(uvtile_token) != std::string_view::npos;
}

std::optional<std::vector<TileFile>> find_tiles(const std::string& pattern,
                                                const TileLimits& limits,
                                                Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  const auto fail = [&](std::string code, std::string message, std::string expected = {},
                        std::string found = {}) {
    diagnostics.add(image_error(std::move(code), pattern, std::move(message), std::move(expected),
                                std::move(found)));
    return std::nullopt;
  };
  const auto slash = pattern.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : pattern.substr(0, slash + 1);
  const std::string name = slash == std::string::npos ? pattern : pattern.substr(slash + 1);
  const bool udim = name.find(udim_token) != std::string::npos;
  const bool uvtile = name.find(uvtile_token) != std::string::npos;
  if (udim == uvtile || has_tile_token(folder)) {
    return fail("bad-tile-pattern", "the name of a tiled image is not understood",
                "<UDIM> or <UVTILE> in the file's own name");
  }

  const std::vector<std::string_view> parts = split(name, udim ? udim_token : uvtile_token);
  std::vector<TileFile> tiles;
  std::error_code code;
  std::size_t entries = 0;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code)) {
    if (++entries > limits.max_folder_entries) {
      return fail("too-many-files", "the folder of a tiled image is too large",
                  fmt::format("at most {} entries", limits.max_folder_entries));
    }
    const std::string file = entry->path().filename().string();
    const auto cell = match(file, parts, udim);
    if (!cell) continue;
    if (tiles.size() == limits.max_tiles) {
      return fail("too-many-files", "the image has too many tiles",
                  fmt::format("at most {}", limits.max_tiles));
    }
    tiles.push_back({cell->u, cell->v, slash == std::string::npos ? file : folder + file});
  }
  if (code) {
    return fail("missing-image", "the folder of a tiled image cannot be listed", {},
                code.message());
  }
  if (tiles.empty()) return fail("missing-image", "no file matches the name of a tiled image");
  std::sort(tiles.begin(), tiles.end(), [](const TileFile& a, const TileFile& b) {
    return a.v != b.v ? a.v < b.v : a.u < b.u;
  });
  if (cells_around(tiles) > limits.max_cells) {
    return fail("too-many-files", "the tiles of an image are too far apart",
                fmt::format("at most {} cells around them", limits.max_cells),
                fmt::format("{}", cells_around(tiles)));
  }
  return tiles;
}

std::vector<std::uint32_t> tile_directory(const std::vector<TileFile>& tiles) {
  assert(!tiles.empty());
  const auto less_u = [](const TileFile& a, const TileFile& b) { return a.u < b.u; };
  const int first_u = std::min_element(tiles.begin(), tiles.end(), less_u)->u;
  const int first_v = tiles.front().v;
  const int columns = std::max_element(tiles.begin(), tiles.end(), less_u)->u - first_u + 1;
  const int rows = tiles.back().v - first_v + 1;

  std::vector<std::uint32_t> words(tile_directory_header_words + cells_around(tiles), no_tile);
  std::fill_n(words.begin(), tile_directory_header_words, 0u);
  words[0] = tile_directory_magic;
  words[1] = static_cast<std::uint32_t>(first_u);
  words[2] = static_cast<std::uint32_t>(first_v);
  words[3] = static_cast<std::uint32_t>(columns);
  words[4] = static_cast<std::uint32_t>(rows);
  words[5] = static_cast<std::uint32_t>(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int cell = (tiles[i].v - first_v) * columns + (tiles[i].u - first_u);
    words[tile_directory_header_words + static_cast<std::size_t>(cell)] =
        static_cast<std::uint32_t>(i);
  }
  return words;
}

}  // namespace nacre
