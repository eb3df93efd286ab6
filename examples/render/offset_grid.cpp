#include "examples/render/offset_grid.h"

#include <algorithm>
#include <cmath>

namespace nacre::host {

OffsetGrid::OffsetGrid(const Bounds& all) : all_(all), offsets_(cells * cells * cells) {}

/// Outside is the cell next to it.
int OffsetGrid::cell(float place, float low, float size) const {
  if (!(size > 0.f)) return 0;
  return static_cast<int>(std::clamp(cells * (place - low) / size, 0.f, cells - 1.f));
}

void OffsetGrid::add(const Bounds& places, const Bounds& offsets) {
  const Vec3 size = all_.high - all_.low;
  const auto first = [&](float p, float low, float s) { return cell(p - 1e-5f * s, low, s); };
  const auto last = [&](float p, float low, float s) { return cell(p + 1e-5f * s, low, s); };
  const Vec3 low = all_.low;
  for (int z = first(places.low.z, low.z, size.z); z <= last(places.high.z, low.z, size.z); ++z) {
    for (int y = first(places.low.y, low.y, size.y); y <= last(places.high.y, low.y, size.y); ++y) {
      for (int x = first(places.low.x, low.x, size.x); x <= last(places.high.x, low.x, size.x);
           ++x) {
        Bounds& known = offsets_[static_cast<std::size_t>((z * cells + y) * cells + x)];
        known.add(offsets.low), known.add(offsets.high);
      }
    }
  }
}

const Bounds& OffsetGrid::at(Vec3 place) const {
  const Vec3 size = all_.high - all_.low;
  const int x = cell(place.x, all_.low.x, size.x), y = cell(place.y, all_.low.y, size.y);
  const int z = cell(place.z, all_.low.z, size.z);
  return offsets_[static_cast<std::size_t>((z * cells + y) * cells + x)];
}

float distance_to_moved(Vec3 point, Vec3 place, const Bounds& offsets) {
  const Vec3 low = place + offsets.low - point, high = place + offsets.high - point;
  // How far 0 is from each side of the box.
  const auto away = [](float l, float h) { return std::max({l, -h, 0.f}); };
  return length(Vec3{away(low.x, high.x), away(low.y, high.y), away(low.z, high.z)});
}

}  // namespace nacre::host
