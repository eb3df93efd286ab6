#include "runtime/channel/channel_table.h"

#include <algorithm>
#include <array>

namespace nacre {

namespace {

constexpr std::string_view unit_vector = "unit vector";
constexpr std::string_view scene_units = "scene units";
constexpr std::string_view per_sample = "scene units per sample";
constexpr std::string_view radiance = "W/(m^2 sr), linear";

constexpr auto point = ChannelRole::point;
constexpr auto direction = ChannelRole::direction;
constexpr auto result = ChannelRole::result;
constexpr auto slot = ChannelRole::slot;
constexpr auto f32 = Scalar::f32;
constexpr auto i32 = Scalar::i32;

// The specification's names of geometric nodes are MaterialX 1.39 Standard Nodes, "Geometric
// Nodes"; which node reads which channel says runtime/node/geometry.h.
constexpr std::array groups = std::to_array<ChannelGroup>({
    {"P", point, 3, f32, scene_units, "position, world space"},
    {"N", point, 3, f32, unit_vector, "shading normal, world space, on the side of Ng"},
    {"Ng", point, 3, f32, unit_vector, "geometric normal, world space; its side is the front"},
    {"T", point, 3, f32, unit_vector, "tangent along u, world space"},
    {"B", point, 3, f32, unit_vector, "bitangent along v, world space"},
    {"wo", point, 3, f32, unit_vector, "from the point to the viewer, world space"},
    {"uv*", point, 2, f32, "", "texture coordinates of a set; (0, 0) is the lower left"},
    {"Po", point, 3, f32, scene_units, "position, object space"},
    {"No", point, 3, f32, unit_vector, "shading normal, object space"},
    {"To", point, 3, f32, unit_vector, "tangent along u, object space"},
    {"Bo", point, 3, f32, unit_vector, "bitangent along v, object space"},
    {"dPdx", point, 3, f32, per_sample, "change of P to the next sample along x"},
    {"dPdy", point, 3, f32, per_sample, "change of P to the next sample along y"},
    {"dPodx", point, 3, f32, per_sample, "change of Po to the next sample along x"},
    {"dPody", point, 3, f32, per_sample, "change of Po to the next sample along y"},
    {"duv*dx", point, 2, f32, "1 per sample", "change of uv* to the next sample along x"},
    {"duv*dy", point, 2, f32, "1 per sample", "change of uv* to the next sample along y"},
    {"color*", point, 4, f32, "", "vertex colour of a set, linear"},
    {"geomprop.*", point, 4, f32, "",
     "a geometric property by name; integers are i32, booleans b1"},
    {"exterior_index", point, 1, f32, "[0.02, 50]",
     "index of refraction outside the surface, vacuum 1; where `varying` names it"},
    {"texture_u", point, 1, f32, "[0, 1)",
     "random number by which images give one texel; where `varying` names it"},
    {"u", direction, 3, f32, "[0, 1)", "independent random numbers that choose a direction"},
    {"wi", direction, 3, f32, unit_vector, "from the point to the light, world space"},
    {"of_lobe", direction, 1, i32, "", "index of the lobe that is asked about: `lobe` of sample"},
    {"lobes_wanted", direction, 1, i32, "", "LobeKind bits of what shall scatter"},
    {"transport", direction, 1, i32, "", "what paths carry: 0 radiance, 1 importance"},
    {"state", ChannelRole::state, 1, f32, "", "what begin stores of the point for other kernels"},
    {"f", result, 3, f32, "1/sr", "scattering function times |cos(wi)|"},
    {"f.lobe*", result, 3, f32, "1/sr", "what one lobe adds to f"},
    {"pdf", result, 1, f32, "1/sr",
     "density of wi given wo; a probability where sample_delta; of emitted light, of its "
     "direction"},
    {"pdf_reverse", result, 1, f32, "1/sr", "density of wo given wi"},
    {"weight", result, 3, f32, "", "f / pdf of the chosen direction; emission |cos| / pdf"},
    {"weight.lobe*", result, 3, f32, "", "what one lobe adds to weight"},
    {"next.wi", result, 3, f32, unit_vector, "the direction that u leads to, world space"},
    {"next.weight", result, 3, f32, "", "weight of that direction"},
    {"next.weight.lobe*", result, 3, f32, "", "what one lobe adds to it"},
    {"next.pdf", result, 1, f32, "1/sr", "density of that direction; or a probability"},
    {"next.pdf_reverse", result, 1, f32, "1/sr", "density of wo given that direction"},
    {"lobe", result, 1, i32, "", "index of the chosen lobe in MaterialKernels::lobes"},
    {"flags", result, 1, i32, "", "SampleFlag bits of the chosen direction"},
    {"kinds", result, 1, i32, "", "LobeKind bits of what f is of, or of what was sampled"},
    {"next.kinds", result, 1, i32, "", "LobeKind bits of what was sampled"},
    {"albedo", result, 3, f32, "[0, 1]", "fraction of the light from wo that scatters"},
    {"emission", result, 3, f32, radiance, "towards wo; of a medium per scene unit"},
    {"emitted", result, 3, f32, unit_vector,
     "from the point, along light that leaves, world space"},
    {"opacity", result, 1, f32, "[0, 1]", "presence of the surface"},
    {"transmission", result, 3, f32, "[0, 1]", "what passes straight on where it is present"},
    {"presence", result, 1, f32, "[0, 1]", "of the surface, as opacity"},
    {"opacity_color", result, 3, f32, "[0, 1]",
     "what it holds back of straight light where present"},
    {"normal", result, 3, f32, unit_vector, "mean of the lobes' normals, towards wo"},
    {"roughness", result, 1, f32, "[0, 1]", "mean of the lobes' roughness"},
    {"eta", result, 1, f32, "", "index of refraction of the inside over the outside"},
    {"absorption", result, 3, f32, "1 per scene unit", "of a medium"},
    {"scattering", result, 3, f32, "1 per scene unit", "of a medium"},
    {"anisotropy", result, 1, f32, "(-1, 1)", "mean cosine of a medium's scattering"},
    {"offset", result, 3, f32, scene_units, "displacement, world space"},
    {"intensity", result, 3, f32, "",
     "of a light: irradiance across its direction, or radiance to wo"},
    {"direction", result, 3, f32, unit_vector, "from the point to the light"},
    {"distance", result, 1, f32, scene_units, "from the point to the light"},
    {"frame", slot, 1, f32, "frames", "number of the picture; 1 unless set"},
    {"time", slot, 1, f32, "s", "time of the picture; 0 unless set"},
    {"object_to_world", slot, 16, f32, "", "rows of a matrix for row vectors; identity unless set"},
    {"world_to_object", slot, 16, f32, "", "its inverse"},
    {"lobe_mask", slot, 1, i32, "", "LobeKind bits that count, where KernelRequest::lobe_mask"},
    {"min_alpha", slot, 1, f32, "[0, 1]", "no facets are smoother; where KernelRequest::min_alpha"},
    {"footprint_scale", slot, 1, f32, "[0, 1e6]",
     "multiplies footprints; 1 unless set; where ShaderOptions::live_footprints"},
    {"max_anisotropy", slot, 1, i32, "",
     "bounds that of look-ups of images below the one compiled; where "
     "ShaderOptions::live_footprints"},
});

/// "duv*dx" fits "duv12dx"; the star of "geomprop.*" stands for any text.
bool fits(std::string_view pattern, std::string_view group) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == group;
  const std::string_view before = pattern.substr(0, star);
  const std::string_view behind = pattern.substr(star + 1);
  if (group.size() <= before.size() + behind.size()) return false;
  if (!group.starts_with(before) || !group.ends_with(behind)) return false;
  group.remove_prefix(before.size());
  group.remove_suffix(behind.size());
  return before.ends_with('.') ||
         std::ranges::all_of(group, [](char c) { return '0' <= c && c <= '9'; });
}

}  // namespace

std::span<const ChannelGroup> channel_groups() { return groups; }

const ChannelGroup* find_channel_group(std::string_view group) {
  const auto found = std::ranges::find_if(
      groups, [&](const ChannelGroup& each) { return fits(each.name, group); });
  return found == groups.end() ? nullptr : &*found;
}

}  // namespace nacre
