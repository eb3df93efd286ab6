#include "examples/tool/bake/udim.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

#include "jit/document/file_roots.h"
#include "jit/document/nodedef.h"
#include "runtime/texture/tile_set.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

std::optional<UdimTile> parse_tile(std::string_view text) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || last != end || number < 1001 || number > 9999) return {};
  return UdimTile{(number - 1001) % 10, (number - 1001) / 10};
}

void add_tile(std::vector<UdimTile>& tiles, UdimTile tile) {
  if (std::find(tiles.begin(), tiles.end(), tile) == tiles.end()) tiles.push_back(tile);
}

std::string numbers_of(const std::vector<UdimTile>& tiles) {
  std::string text;
  for (const UdimTile& tile : tiles) text += (text.empty() ? "" : ",") + tile.number();
  return text;
}

/// Adds the tiles of a list; false after an error.
bool add_list(std::string_view text, const SourceLocation& where, std::vector<UdimTile>& tiles,
              Diagnostics& diagnostics) {
  for (const std::string_view number : split_list(text)) {
    const auto tile = parse_tile(number);
    if (!tile) {
      diagnostics.error("bad-udim", where, "this is not the number of a tile", "1001 to 9999",
                        fmt::format("'{}'", number));
      return false;
    }
    add_tile(tiles, *tile);
  }
  return true;
}

bool add_udim_sets(const Document& document, std::vector<UdimTile>& tiles,
                   Diagnostics& diagnostics) {
  for (const Element& info : document.root().children()) {
    if (info.category() != "geominfo") continue;
    for (const Element& property : info.children()) {
      if (property.name() != "udimset") continue;
      if (!add_list(property.attribute("value"), location(property), tiles, diagnostics)) {
        return false;
      }
    }
  }
  return true;
}

/// The tiles of an image's set; nothing where there is no file of it.
std::optional<std::vector<UdimTile>> tiles_of_set(const Element& input,
                                                  const std::vector<std::string>& search_paths,
                                                  const FileRoots& roots) {
  const std::string name =
      std::string(input.inherited_attribute("fileprefix")) + std::string(input.attribute("value"));
  std::vector<fs::path> folders{fs::path(input.document().file_of(input)).parent_path()};
  folders.insert(folders.end(), search_paths.begin(), search_paths.end());
  for (const fs::path& folder : folders) {
    const fs::path place = (folder / name).lexically_normal();
    if (!roots.empty() && !roots.hold(place)) continue;
    Diagnostics ignored;
    const auto files = find_tiles(place.string(), {}, ignored);
    if (!files) continue;
    std::vector<UdimTile> tiles;
    for (const TileFile& file : *files) {
      const bool has_number = file.u >= 0 && file.u <= 9 && file.v >= 0 && file.v <= 899;
      if (has_number) add_tile(tiles, {file.u, file.v});
    }
    return tiles;
  }
  return std::nullopt;
}

/// see(input, tiles) for each image of which there are files.
template <class See>
void each_set(const Element& element, const std::vector<std::string>& search_paths,
              const FileRoots& roots, const See& see) {
  for (const Element& child : element.children()) {
    if (child.attribute("type") == "filename" && has_tile_token(child.attribute("value"))) {
      if (const auto tiles = tiles_of_set(child, search_paths, roots)) see(child, *tiles);
    }
    each_set(child, search_paths, roots, see);
  }
}

FileRoots roots_of(const Document& document, const std::vector<std::string>& search_paths,
                   bool anywhere) {
  FileRoots roots;
  if (anywhere) return roots;
  roots.add(fs::path(document.files().front()).parent_path());
  for (const std::string& path : search_paths) roots.add(path);
  return roots;
}

/// Images that lack a tile which is asked for: their nodes' defaults stand there.
void report_lacking(const Document& document, const std::vector<std::string>& search_paths,
                    const FileRoots& roots, const std::vector<UdimTile>& asked,
                    Diagnostics& diagnostics) {
  each_set(document.root(), search_paths, roots,
           [&](const Element& input, const std::vector<UdimTile>& tiles) {
             std::vector<UdimTile> lacking;
             for (const UdimTile& tile : asked) {
               if (std::ranges::find(tiles, tile) == tiles.end()) lacking.push_back(tile);
             }
             if (lacking.empty()) return;
             diagnostics.warning("missing-tile", location(input),
                                 "the image has no such tile: there it is its node's default",
                                 numbers_of(tiles), numbers_of(lacking));
           });
}

}  // namespace

std::string UdimTile::number() const { return std::to_string(1001 + u + 10 * v); }

std::vector<UdimTile> parse_tiles(std::string_view text, const SourceLocation& where,
                                  Diagnostics& diagnostics) {
  std::vector<UdimTile> tiles;
  if (!add_list(text, where, tiles, diagnostics)) return {};
  return tiles;
}

std::vector<UdimTile> read_tiles(std::string_view text, const Document& document,
                                 const std::vector<std::string>& search_paths,
                                 Diagnostics& diagnostics, bool anywhere) {
  const FileRoots roots = roots_of(document, search_paths, anywhere);
  if (text == "auto") {
    std::vector<UdimTile> tiles = tiles_of(document, search_paths, diagnostics, anywhere);
    report_lacking(document, search_paths, roots, tiles, diagnostics);
    return tiles;
  }
  const SourceLocation where{document.files().front(), 0, 0, {}};
  Diagnostics ignored;
  const std::vector<UdimTile> known = tiles_of(document, search_paths, ignored, anywhere);
  if (text.empty()) {
    std::vector<UdimTile> tiles;
    if (known.empty() || known == std::vector<UdimTile>(1)) return tiles;
    diagnostics.warning("udim-not-baked", where,
                        "the document has tiles, but one image of uv from 0 to 1 is baked",
                        "--udim auto", numbers_of(known));
    return tiles;
  }
  SourceLocation flag = where;
  flag.path = "--udim";
  std::vector<UdimTile> tiles = parse_tiles(text, flag, diagnostics);
  if (tiles.empty()) return {};
  if (known.empty()) {
    diagnostics.warning("no-udim", where,
                        "the document says nothing of tiles: each is what its graphs make of uv",
                        "a udimset, or files of a name with <UDIM>");
    return tiles;
  }
  for (const UdimTile& tile : tiles) {
    if (std::find(known.begin(), known.end(), tile) != known.end()) continue;
    diagnostics.error("no-such-tile", where, "the document has no such tile", numbers_of(known),
                      tile.number());
  }
  if (!diagnostics.has_errors()) {
    report_lacking(document, search_paths, roots, tiles, diagnostics);
  }
  return tiles;
}

std::vector<UdimTile> tiles_of(const Document& document,
                               const std::vector<std::string>& search_paths,
                               Diagnostics& diagnostics, bool anywhere) {
  std::vector<UdimTile> tiles;
  if (!add_udim_sets(document, tiles, diagnostics)) return {};
  if (tiles.empty()) {
    each_set(document.root(), search_paths, roots_of(document, search_paths, anywhere),
             [&](const Element&, const std::vector<UdimTile>& more) {
               for (const UdimTile& tile : more) add_tile(tiles, tile);
             });
  }
  if (tiles.empty()) {
    diagnostics.error("no-udim", {document.files().front(), 0, 0, {}},
                      "the document says nothing of tiles",
                      "a udimset, or files of a name with <UDIM>");
  }
  return tiles;
}

}  // namespace nacre::tool
