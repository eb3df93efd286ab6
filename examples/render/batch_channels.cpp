#include "examples/render/batch_channels.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "runtime/channel/channel_name.h"

namespace nacre::host {

namespace {

/// A group of three lanes of the batch, and the attribute that fills it.
struct Group3 {
  std::string_view name;
  Lanes3 ShadingBatch::* lanes;
  std::uint32_t attribute;
};

constexpr std::array<Group3, 14> groups3{{
    {"P", &ShadingBatch::P, 0},
    {"N", &ShadingBatch::N, 0},
    {"Ng", &ShadingBatch::Ng, 0},
    {"wo", &ShadingBatch::wo, 0},
    {"T", &ShadingBatch::T, attribute_tangents},
    {"B", &ShadingBatch::B, attribute_tangents},
    {"Po", &ShadingBatch::P_object, attribute_object_space},
    {"No", &ShadingBatch::N_object, attribute_object_space},
    {"To", &ShadingBatch::T_object, attribute_object_space | attribute_tangents},
    {"Bo", &ShadingBatch::B_object, attribute_object_space | attribute_tangents},
    {"dPdx", &ShadingBatch::dPdx, attribute_footprint_position},
    {"dPdy", &ShadingBatch::dPdy, attribute_footprint_position},
    {"dPodx", &ShadingBatch::dPdx_object, attribute_footprint_position | attribute_object_space},
    {"dPody", &ShadingBatch::dPdy_object, attribute_footprint_position | attribute_object_space},
}};

float* component(const Lanes3& lanes, int i) {
  return i == 0 ? lanes.x : i == 1 ? lanes.y : lanes.z;
}
float* component(const Lanes2& lanes, int i) { return i == 0 ? lanes.x : lanes.y; }

/// The lanes of a standard channel; empty for others.
BatchSource standard_channel(std::string_view group, int i, std::uint32_t& attributes) {
  for (const Group3& known : groups3) {
    if (group != known.name) continue;
    attributes |= known.attribute;
    return [lanes = known.lanes, i](const ShadingBatch& b) { return component(b.*lanes, i); };
  }
  if (group == "uv0") return [i](const ShadingBatch& b) { return component(b.uv, i); };
  if (group == "duv0dx" || group == "duv0dy") {
    attributes |= attribute_footprint_uv;
    const auto lanes = group == "duv0dx" ? &ShadingBatch::dUVdx : &ShadingBatch::dUVdy;
    return [lanes, i](const ShadingBatch& b) { return component(b.*lanes, i); };
  }
  if (group == "exterior_index") return [](const ShadingBatch& b) { return b.exterior_index; };
  if (group == "texture_u") return [](const ShadingBatch& b) { return b.texture_u; };
  if (group == "min_alpha") return [](const ShadingBatch& b) { return b.min_alpha; };
  if (group == "lobes_wanted") return [](const ShadingBatch& b) { return b.lobes_wanted; };
  if (group == "time" || group == "frame") {  // Of each point: see varying_slots().
    attributes |= attribute_time;
    const auto lane = group == "time" ? &ShadingBatch::times : &ShadingBatch::frames;
    return [lane](const ShadingBatch& b) { return b.*lane; };
  }
  return {};
}

/// Which entry of a matrix "object_to_world.7" is, as a bit of Capabilities::matrix_entries.
std::optional<int> matrix_entry(std::string_view channel) {
  for (const auto& [name, first] : {std::pair{"object_to_world.", 0}, {"world_to_object.", 16}}) {
    if (!channel.starts_with(name)) continue;
    const std::string_view digits = channel.substr(std::string_view(name).size());
    int number = -1;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (number >= 0 && number < 16) return first + number;
  }
  return {};
}

/// The lane of an entry of a matrix; empty for other channels.
BatchSource matrix_channel(std::string_view channel, std::uint32_t& entries) {
  const auto entry = matrix_entry(channel);
  if (!entry) return {};
  entries |= 1u << *entry;
  const auto lanes = *entry < 16 ? &ShadingBatch::object_to_world : &ShadingBatch::world_to_object;
  return [lanes, i = static_cast<std::size_t>(*entry % 16)](const ShadingBatch& b) {
    return (b.*lanes)[i];
  };
}

}  // namespace

std::string primvar_name(std::string_view group) {
  if (group.starts_with("uv")) return "texcoord" + std::string(group.substr(2));
  if (group.starts_with("geomprop.")) return std::string(group.substr(9));
  return std::string(group);
}

int request_primvar(std::string_view name, int components, Capabilities& needs) {
  auto& list = needs.primvars;
  const auto found = std::ranges::find(list, name, &PrimvarRequest::name);
  if (found == list.end()) {
    list.push_back({std::string(name), components});
    return static_cast<int>(list.size()) - 1;
  }
  found->components = std::max(found->components, components);
  return static_cast<int>(found - list.begin());
}

BatchSource batch_channel(std::string_view name, Capabilities& needs) {
  const auto [group, i] = parse_channel(name);
  if (BatchSource source = standard_channel(group, i, needs.attributes)) return source;
  if (BatchSource source = matrix_channel(name, needs.matrix_entries)) return source;
  const bool is_presence = i < 0 && group.starts_with("geomprop.");
  if (i < 0 && !is_presence) return {};
  const int primvar = request_primvar(primvar_name(group), std::max(i, 0) + 1, needs);
  if (is_presence) {
    return [primvar](const ShadingBatch& b) { return b.primvars[primvar].present; };
  }
  // Clang 19 takes no structured binding into a lambda under its own name without a warning.
  return [primvar, component = i](const ShadingBatch& b) {
    return b.primvars[primvar].component[component];
  };
}

}  // namespace nacre::host
