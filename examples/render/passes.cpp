#include "examples/render/passes.h"

#include <algorithm>
#include <numeric>

namespace nacre::host {

namespace {

constexpr std::array<std::string_view, scatter_classes> class_names{
    "diffuse", "glossy", "mirror", "transmission", "subsurface", "volume"};
/// As light path expressions have them; the walk below a surface is an event of its own.
constexpr std::array<std::string_view, scatter_classes> class_events{
    "<RD>", "<RG>", "<RS>", "<T.>", "<R'subsurface'>", "<V.>"};
constexpr std::array<std::string_view, scatter_classes> class_abouts{
    "diffuse reflection",
    "rough reflection",
    "mirrors",
    "what light goes through",
    "what light comes back from below",
    "volumes"};

const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"}, xy{"X", "Y"}, one{"V"};

void put(Vec3 v, float* to) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }
void put(Vec2 v, float* to) { to[0] = v.x, to[1] = v.y; }

Vec3 sum(std::span<const Vec3> all) { return std::accumulate(all.begin(), all.end(), Vec3{}); }

using Read = void (*)(const PathRecord&, std::size_t, float*);

Pass light_pass(std::string name, std::string path_expression, std::string about, Read read,
                std::size_t which = 0) {
  return {std::move(name),
          std::move(path_expression),
          std::move(about),
          rgb,
          PassNeed::split,
          Pass::Mean::samples,
          read,
          which};
}

std::vector<Pass> light_passes() {
  std::vector<Pass> passes{
      light_pass("emission", "CL", "what the camera sees shine",
                 [](const PathRecord& r, std::size_t, float* to) { put(r.light.emission, to); }),
      light_pass("background", "CO", "the environment behind everything",
                 [](const PathRecord& r, std::size_t, float* to) { put(r.light.background, to); }),
      light_pass("direct", "C.[LO]", "light that is scattered once",
                 [](const PathRecord& r, std::size_t, float* to) { put(sum(r.light.direct), to); }),
      light_pass(
          "indirect", "C..+[LO]", "light that is scattered more often",
          [](const PathRecord& r, std::size_t, float* to) { put(sum(r.light.indirect), to); })};
  for (std::size_t c = 0; c < scatter_classes; ++c) {
    const std::string name(class_names[c]), event(class_events[c]), about(class_abouts[c]);
    passes.push_back(light_pass(
        "direct_" + name, "C" + event + "[LO]", "direct, by " + about,
        [](const PathRecord& r, std::size_t k, float* to) { put(r.light.direct[k], to); }, c));
    passes.push_back(light_pass(
        "indirect_" + name, "C" + event + ".+[LO]", "indirect, by " + about,
        [](const PathRecord& r, std::size_t k, float* to) { put(r.light.indirect[k], to); }, c));
  }
  return passes;
}

std::vector<Pass> hit_passes() {
  using Mean = Pass::Mean;
  return {
      {"albedo", "", "share of light that leaves, of all lobes", rgb, PassNeed::point,
       Mean::samples, [](const PathRecord& r, std::size_t, float* to) { put(r.hit.albedo, to); }},
      {"normal", "", "world, bumped, towards the viewer", xyz, PassNeed::point, Mean::samples,
       [](const PathRecord& r, std::size_t, float* to) { put(r.hit.normal, to); }},
      {"roughness", "", "mean of all lobes", one, PassNeed::point, Mean::hits,
       [](const PathRecord& r, std::size_t, float* to) { *to = r.hit.roughness; }},
      {"position", "", "world", xyz, PassNeed::hit, Mean::hits,
       [](const PathRecord& r, std::size_t, float* to) { put(r.hit.position, to); }},
      {"depth", "", "along the camera's axis; 0 where there is nothing",
       std::vector<std::string>{"Z"}, PassNeed::hit, Mean::hits,
       [](const PathRecord& r, std::size_t, float* to) { *to = r.hit.depth; }},
      {"uv", "", "first uv set", xy, PassNeed::hit, Mean::hits,
       [](const PathRecord& r, std::size_t, float* to) { put(r.hit.uv, to); }},
      {"motion", "", "pixels, right and down, while the shutter is open", xy, PassNeed::motion,
       Mean::hits, [](const PathRecord& r, std::size_t, float* to) { put(r.hit.motion, to); }},
      {"mesh_id", "", "number of the mesh from 1, of the first sample; 0: none", one, PassNeed::hit,
       Mean::first, [](const PathRecord& r, std::size_t, float* to) {
         *to = r.hit.is_there ? static_cast<float>(r.hit.mesh + 1) : 0.f;
       }}};
}

std::vector<Pass> all_passes() {
  std::vector<Pass> all = light_passes();
  const std::vector<Pass> hits = hit_passes();
  all.insert(all.end(), hits.begin(), hits.end());
  return all;
}

template <int count>
void read_values(const PathRecord& record, std::size_t first, float* to) {
  std::copy_n(record.values.begin() + static_cast<std::ptrdiff_t>(first), count, to);
}

}  // namespace

bool PassRequest::any(PassNeed need) const {
  if (need == PassNeed::hit && (object_mattes || material_mattes)) return true;
  return std::ranges::any_of(passes, [&](const Pass& pass) {
    const bool is_of_hit = pass.need != PassNeed::group && pass.need != PassNeed::split;
    return pass.need == need || (need == PassNeed::hit && is_of_hit);
  });
}

std::size_t PassRequest::channels() const {
  std::size_t count = 0;
  for (const Pass& pass : passes) count += pass.channels.size();
  return count;
}

std::size_t PassRequest::value_floats() const {
  std::size_t count = 0;
  for (const GraphValue& value : values) count += static_cast<std::size_t>(value.components);
  return count;
}

std::span<const Pass> known_passes() {
  static const std::vector<Pass> all = all_passes();
  return all;
}

std::optional<Pass> find_pass(std::string_view name) {
  const auto known = known_passes();
  const auto found = std::ranges::find_if(known, [&](const Pass& pass) {
    return pass.name == name || (!name.empty() && pass.path_expression == name);
  });
  return found == known.end() ? std::nullopt : std::optional(*found);
}

Pass group_pass(const LightGroups& groups, std::size_t group) {
  const std::string name = group < groups.names.size() ? groups.names[group] : "other";
  Pass pass = light_pass(
      "light_" + name, "C.*<[LO]'" + name + "'>", "light of the group",
      [](const PathRecord& r, std::size_t k, float* to) { put(r.light.group[k], to); }, group);
  pass.need = PassNeed::group;
  return pass;
}

Pass value_pass(const GraphValue& value, std::size_t first) {
  Pass pass{value.name,     "",   "value of graphs", one, PassNeed::point, Pass::Mean::hits,
            read_values<1>, first};
  if (value.components == 2) pass.channels = xy, pass.read = read_values<2>;
  if (value.components == 3) pass.channels = rgb, pass.read = read_values<3>;
  if (value.components == 4) pass.channels = {"R", "G", "B", "A"}, pass.read = read_values<4>;
  return pass;
}

}  // namespace nacre::host
