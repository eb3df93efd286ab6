#include <algorithm>
#include <string>
#include <vector>

#include "nodes/texture2d/sampler.h"
#include "runtime/texture/tile_set.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// Tiles that one recorded look-up serves.
struct Group {
  TextureSource image;  ///< All but its slot holds for each of them.
  std::vector<std::size_t> tiles;
};

bool alike(const TextureSource& a, const TextureSource& b) {
  return a.state == TextureSource::State::resident && b.state == a.state && b.format == a.format &&
         b.channels == a.channels && b.single == a.single && b.uniform == a.uniform;
}

/// Tiles that are missing belong to no group.
std::vector<Group> group_tiles(const std::vector<TextureSource>& images) {
  std::vector<Group> groups;
  for (std::size_t tile = 0; tile < images.size(); ++tile) {
    if (images[tile].state == TextureSource::State::missing) continue;
    auto group = std::ranges::find_if(
        groups, [&](const Group& other) { return alike(other.image, images[tile]); });
    if (group == groups.end()) group = groups.insert(groups.end(), {images[tile], {}});
    group->tiles.push_back(tile);
  }
  return groups;
}

/// The cell of a directory that a point lies in.
struct Cell {
  Bool inside;
  Int index;
};

Cell find_cell(const std::vector<std::uint32_t>& directory, Float column, Float row) {
  const auto word = [&](std::size_t i) { return static_cast<std::int32_t>(directory[i]); };
  const Float x = column - static_cast<float>(word(1));
  const Float y = row - static_cast<float>(word(2));
  const auto within = [](Float k, std::int32_t count) {
    return (k >= 0.0f) & (k < static_cast<float>(count));
  };
  return {within(x, word(3)) & within(y, word(4)), to_int(y) * Int(word(3)) + to_int(x)};
}

/// The slot of each cell's tile where that is in the group, else -1.
std::vector<float> slots_of_cells(const TextureSources& sources, const Group& group) {
  std::vector<float> slots(sources.directory.size() - tile_directory_header_words, -1.0f);
  for (std::size_t cell = 0; cell < slots.size(); ++cell) {
    const std::uint32_t tile = sources.directory[tile_directory_header_words + cell];
    if (tile == no_tile || std::ranges::find(group.tiles, tile) == group.tiles.end()) continue;
    slots[cell] = static_cast<float>(sources.images[tile].slot.constant());
  }
  return slots;
}

Float4 sample_tiles(Recorder& recorder, const TextureSources& sources, ImageLookup lookup) {
  const Float2 corner{floor(lookup.uv.x), floor(lookup.uv.y)};
  const Cell cell = find_cell(sources.directory, corner.x, corner.y);
  lookup.uv = lookup.uv - corner;
  lookup.modes.u = lookup.modes.v = AddressMode::clamp;
  Float4 result = lookup.otherwise;
  for (const Group& group : group_tiles(sources.images)) {
    TextureSource image = group.image;
    const std::vector<float> slots = slots_of_cells(sources, group);
    const std::string name = std::string(tile_table_prefix) + std::to_string(image.slot.constant());
    const std::array<Ref, 1> index{cell.index.ref()};
    const Float slot(recorder.emit(Op::table, index, recorder.table(name, slots)));
    if (group.tiles.size() > 1) image.slot = to_int(slot);
    result = if_any(cell.inside & (slot >= 0.0f), result,
                    [&] { return sample_image(recorder, image, lookup); });
  }
  return result;
}

}  // namespace

Float4 sample_images(Recorder& recorder, const TextureSources& sources, ImageLookup lookup) {
  lookup.modes.max_anisotropy = sources.max_anisotropy;
  if (!sources.directory.empty()) return sample_tiles(recorder, sources, lookup);
  if (sources.images.empty()) return lookup.otherwise;
  return sample_image(recorder, sources.images.front(), lookup);
}

}  // namespace nacre
