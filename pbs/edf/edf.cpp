#include "pbs/edf.h"

#include <optional>
#include <unordered_map>
#include <vector>

namespace nacre {

// Of the parts first, without recursion: chains are as long as documents make them.
Color3 radiance(const EdfPtr& edf, const View& view) {
  if (edf == nullptr) return Color3(0.0f);
  std::unordered_map<const Edf*, Color3> known;
  std::vector<const Edf*> wanted{edf.get()};
  while (!wanted.empty()) {
    const Edf* at = wanted.back();
    Color3 of_part[2] = {Color3(0.0f), Color3(0.0f)};
    bool waits = false;
    for (std::size_t i = 0; i < Edf::Parts::count; ++i) {
      const Edf* part = at->parts()[i].get();
      if (part == nullptr) continue;
      if (const auto found = known.find(part); found != known.end()) {
        of_part[i] = found->second;
      } else {
        wanted.push_back(part);
        waits = true;
      }
    }
    if (waits) continue;
    wanted.pop_back();
    if (!known.contains(at)) known.emplace(at, at->radiance(view, of_part[0], of_part[1]));
  }
  return finite_light(known.at(edf.get()));
}

Color3 Edf::part_power(std::size_t, Color3 power) const { return power; }

Color3 power_seen(Color3 power, Color3 factor) {
  const auto one = [](Float x, Float y) {
    if (x.is_constant(0.0f) || y.is_constant(0.0f)) return Float(0.0f);
    return select((x > 0.0f) & (y > 0.0f), clamp(x * y, 1e-20f, 1e20f), 0.0f);
  };
  return {one(power.x, factor.x), one(power.y, factor.y), one(power.z, factor.z)};
}

EdfPtr as_edf(const ClosurePtr& closure) { return std::dynamic_pointer_cast<const Edf>(closure); }

}  // namespace nacre
