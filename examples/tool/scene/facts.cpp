#include "examples/tool/scene/facts.h"

#include <algorithm>

namespace nacre::tool {

namespace {

bool is_in_unit_square(const host::Mesh& mesh) {
  const auto is_share = [](float x) { return x >= 0.0f && x <= 1.0f; };
  return std::ranges::all_of(mesh.uv,
                             [&](host::Vec2 at) { return is_share(at.x) && is_share(at.y); });
}

}  // namespace

std::vector<Fact> scene_facts(const std::vector<const host::Mesh*>& meshes) {
  // Below 1, as the sampler has them.
  std::vector<Fact> facts{{"u", 0, 1 - 0x1p-24}};
  for (const char* direction : {"N", "Ng", "T", "B", "wo", "wi"}) {
    facts.push_back({"dot(" + std::string(direction) + ',' + direction + ')', 0.999, 1.001});
  }
  // Interpolated between corners numbers may round beyond them.
  constexpr double rounding = 1e-6;
  if (std::ranges::all_of(meshes, [](const auto* mesh) { return is_in_unit_square(*mesh); })) {
    facts.push_back({"uv0", -rounding, 1 + rounding});
  }
  return facts;
}

}  // namespace nacre::tool
