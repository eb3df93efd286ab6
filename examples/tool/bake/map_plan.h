#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "examples/tool/bake/item.h"
#include "examples/tool/bake/ledger.h"

namespace nacre::tool {

/// One image of the map of an input.
struct PlannedImage {
  BakeItem item;
  BakeStep step = BakeStep::bake;
  int row = 0;
  UdimTile tile;
};

/// The images that an input of a baked document gets: one for every tile, of a matrix so many for
/// each of its rows, because textures have at most four channels.
struct MapPlan {
  TextureSettings texture;  ///< But for the channels of a row.
  int rows = 1;
  std::vector<PlannedImage> images;  ///< Row by row.
  std::vector<std::string> names;    ///< Of each row, from the document's folder, with <UDIM>.

  bool has(BakeStep step) const;
  /// That of an image of a row.
  TextureSettings texture_of(int row) const;
};

/// Where they are to lie, and how they are called.
struct MapPlaces {
  std::filesystem::path images;    ///< Folder, absolute.
  std::filesystem::path document;  ///< The same of the document.
  std::string name;                ///< Of images: see file_name.h.
};

/// Each image an item of the ledger; their steps are still to be asked for. `output`: what the
/// ledger calls it. `stem`: of the files. No tiles: one image of uv from 0 to 1.
MapPlan plan_map(const std::string& output, Type type, const std::string& stem,
                 const TextureSettings& texture, const host::BakeSettings& settings,
                 const std::vector<UdimTile>& tiles, const MapPlaces& places, BakeLedger& ledger);

}  // namespace nacre::tool
