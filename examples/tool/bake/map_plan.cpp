#include "examples/tool/bake/map_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "examples/tool/paths.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

int matrix_rows(Type type) {
  if (type == Type::matrix33) return 3;
  return type == Type::matrix44 ? 4 : 1;
}

}  // namespace

bool MapPlan::has(BakeStep step) const {
  return std::ranges::any_of(images, [&](const PlannedImage& one) { return one.step == step; });
}

TextureSettings MapPlan::texture_of(int row) const {
  TextureSettings settings = texture;
  settings.encoding.first_channel = row * rows;
  settings.encoding.channels = rows == 1 ? 0 : rows;
  return settings;
}

MapPlan plan_map(const std::string& output, Type type, const std::string& stem,
                 const TextureSettings& texture, const host::BakeSettings& settings,
                 const std::vector<UdimTile>& tiles, const MapPlaces& places, BakeLedger& ledger) {
  MapPlan plan{texture, matrix_rows(type), {}, {}};
  for (int row = 0; row < plan.rows; ++row) {
    const std::string row_stem = plan.rows == 1 ? stem : fmt::format("{}.row{}", stem, row + 1);
    const auto file_of = [&](const std::string& tile) {
      return places.images / file_name(places.name, row_stem, tile, texture.extension);
    };
    const auto add = [&](const std::string& number, const UdimTile& tile) {
      Facts facts = settings_of(output, plan.texture_of(row), settings, tile);
      plan.images.push_back({.item = ledger.item(file_of(number).string(), std::move(facts)),
                             .step = BakeStep::bake,
                             .row = row,
                             .tile = tile});
    };
    if (tiles.empty()) add("", {});
    for (const UdimTile& tile : tiles) add(tile.number(), tile);
    plan.names.push_back(from_folder(file_of(tiles.empty() ? "" : "<UDIM>"), places.document));
  }
  return plan;
}

}  // namespace nacre::tool
