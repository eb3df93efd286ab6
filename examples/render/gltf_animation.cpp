#include "examples/render/gltf_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "runtime/near_names.h"

namespace nacre::host {

namespace {

enum Property : std::size_t { translation, rotation, scale };

/// A turn and a change of size together are no straight line.
constexpr int least_steps_of_both = 16;

std::array<double, 3> three(const GltfTrack::Value& v) { return {v[0], v[1], v[2]}; }

/// 0 'walk', 1 'run', …
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 16;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", i);
    if (!names[i].empty()) text += " '" + names[i] + "'";
  }
  return names.size() > most ? text + ", ..." : text;
}

double not_zero(double x) {
  constexpr double least = 1e-6;
  return std::abs(x) < least ? std::copysign(least, x) : x;
}

}  // namespace

std::optional<std::size_t> GltfAnimation::chosen(const std::string& wanted) const {
  const GltfValue animations = root_["animations"];
  std::vector<std::string> names;
  for (std::size_t i = 0; i < animations.size(); ++i) names.push_back(animations[i].name());
  const auto found = std::ranges::find(names, wanted);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::size_t number = 0;
  const char* const end = wanted.data() + wanted.size();
  const auto parsed = std::from_chars(wanted.data(), end, number);
  if (parsed.ec == std::errc() && parsed.ptr == end && number < names.size()) return number;
  Diagnostics& diagnostics = root_.report().diagnostics;
  diagnostics.error("unknown-animation", animations.location(),
                    "the scene has no animation of that name or number",
                    names.empty() ? "a file with animations" : listed(names), '"' + wanted + '"',
                    near_hint(diagnostics, wanted, names));
  return {};
}

bool GltfAnimation::read(const std::string& wanted) {
  const GltfValue animations = root_["animations"];
  if (animations.size() == 0 && wanted.empty()) return true;
  if (animations.size() > 1 && wanted.empty()) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < animations.size(); ++i) names.push_back(animations[i].name());
    dropped_.say("several-animations", animations, "the first animation is taken",
                 "--animation NAME or its number, " + listed(names),
                 fmt::format("{}", animations.size()));
  }
  const auto number = wanted.empty() ? std::optional<std::size_t>(0) : chosen(wanted);
  if (!number) return false;
  const GltfValue animation = animations[*number];
  const GltfValue channels = animation["channels"];
  if (!channels.need("an array of channels")) return false;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!read_channel(animation, channels[i])) return false;
  }
  return true;
}

bool GltfAnimation::read_channel(const GltfValue& animation, const GltfValue& channel) {
  const GltfValue target = channel["target"];
  const GltfValue path = target["path"];
  const auto sampler =
      channel["sampler"].need("the index of a sampler").index_of(animation["samplers"]);
  const auto name = path.need("\"translation\", \"rotation\", \"scale\" or \"weights\"").text();
  if (!sampler || !name) return false;
  // glTF 2.0, 5.3: without a node, what an extension names is animated.
  if (!target["node"]) {
    dropped_.say("animation-not-rendered", target,
                 "an animation of what is no node is not rendered", "a node");
    return true;
  }
  if (*name == "weights") return read_weights(animation, *sampler, target);
  constexpr std::array<const char*, 3> names = {"translation", "rotation", "scale"};
  const auto property = static_cast<std::size_t>(std::ranges::find(names, *name) - names.begin());
  if (property == names.size()) {
    path.error("nodes have no such property",
               "\"translation\", \"rotation\", \"scale\" or \"weights\"", path.shown());
    return false;
  }
  const auto node = target["node"].index_of(root_["nodes"]);
  if (!node) return false;
  if (root_["nodes"][*node]["matrix"]) {
    target.error("a node with a matrix is animated", "translation, rotation or scale", "a matrix");
    return false;
  }
  Tracks& tracks = nodes_[*node];
  if (tracks[property] != nullptr) {
    target.error("a property is animated twice", "one channel for each", path.shown());
    return false;
  }
  tracks[property] = track(animation["samplers"], *sampler, property == rotation);
  return tracks[property] != nullptr;
}

bool GltfAnimation::read_weights(const GltfValue& animation, std::size_t sampler,
                                 const GltfValue& target) {
  const auto node = target["node"].index_of(root_["nodes"]);
  if (!node) return false;
  const GltfValue index = root_["nodes"][*node]["mesh"];
  const auto mesh = index.index_of(root_["meshes"]);
  const GltfValue targets =
      root_["meshes"][mesh.value_or(0)]["primitives"][std::size_t{0}]["targets"];
  if (!mesh || targets.size() == 0) {
    target.error("the weights of a node without morph targets are animated", "a mesh with targets",
                 index.shown());
    return false;
  }
  auto& tracks = weights_[*node];
  if (!tracks.empty()) {
    target.error("a property is animated twice", "one channel for each", "\"weights\"");
    return false;
  }
  tracks =
      GltfTrack::read_weights(animation["samplers"][sampler], targets.size(), accessors_, budget_);
  return !tracks.empty();
}

const GltfTrack* GltfAnimation::track(const GltfValue& samplers, std::size_t number,
                                      bool is_rotation) {
  const auto [slot, fresh] = samplers_.try_emplace({number, is_rotation});
  if (fresh) slot->second = GltfTrack::read(samplers[number], is_rotation, accessors_, budget_);
  return slot->second.get();
}

/// Of stretches without a key within, from 0 to 1; 0 alone while the shutter is closed.
std::vector<double> GltfAnimation::boundaries(const Tracks& tracks) const {
  std::vector<double> bounds = {0.0};
  const double span = shutter_.close - shutter_.open;
  if (!(span > 0)) return bounds;
  bounds.push_back(1.0);
  for (const GltfTrack* track : tracks) {
    if (track == nullptr) continue;
    const auto times = track->times();
    for (auto t =
             std::ranges::upper_bound(times, shutter_.open, {}, [](float x) { return double{x}; });
         t != times.end() && static_cast<double>(*t) < shutter_.close; ++t) {
      bounds.push_back((static_cast<double>(*t) - shutter_.open) / span);
    }
  }
  std::ranges::sort(bounds);
  const auto same = [](double a, double b) {
    return b - a < static_cast<double>(Motion::shortest);
  };
  bounds.erase(std::unique(bounds.begin(), bounds.end(), same), bounds.end());
  bounds.back() = 1.0;
  return bounds;
}

Motion::Segment GltfAnimation::segment(const Tracks& tracks, NodeTransform still, double from,
                                       double to) const {
  const auto seconds = [this](double share) {
    return (1 - share) * shutter_.open + share * shutter_.close;
  };
  const double within = seconds(0.5 * (from + to));
  int steps = 1;
  for (const GltfTrack* track : tracks) {
    if (track != nullptr) steps = std::max(steps, track->steps(seconds(from), seconds(to)));
  }
  if (tracks[rotation] != nullptr && tracks[scale] != nullptr) {
    steps = std::max(steps, least_steps_of_both);
  }
  std::vector<Affine> maps;
  for (int k = 0; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const double time = seconds((1 - share) * from + share * to);
    if (tracks[translation]) still.translation = three(tracks[translation]->at(time, within));
    if (tracks[rotation]) still.rotation = tracks[rotation]->at(time, within);
    if (tracks[scale]) {
      still.scale = three(tracks[scale]->at(time, within));
      for (double& s : *still.scale) s = not_zero(s);
    }
    maps.push_back(affine(still));
  }
  return {static_cast<float>(from), static_cast<float>(to), std::move(maps)};
}

std::vector<double> GltfAnimation::weights(std::size_t number, std::vector<double> stored,
                                           float time) const {
  const auto found = weights_.find(number);
  if (found == weights_.end()) return stored;
  const double share = static_cast<double>(time);
  const double seconds = (1 - share) * shutter_.open + share * shutter_.close;
  for (std::size_t i = 0; i < std::min(stored.size(), found->second.size()); ++i) {
    stored[i] = found->second[i]->at(seconds, seconds)[0];
  }
  return stored;
}

std::size_t GltfAnimation::weight_steps(std::size_t number) const {
  const auto found = weights_.find(number);
  if (found == weights_.end() || !(shutter_.close > shutter_.open)) return 0;
  const GltfTrack& track = *found->second.front();
  std::size_t within = 1;
  for (const float t : track.times()) {
    const double time = static_cast<double>(t);
    if (time > shutter_.open && time < shutter_.close) ++within;
  }
  constexpr std::size_t of_curves = 4;
  return track.interpolation() == GltfTrack::Interpolation::cubic ? of_curves * within : 2 * within;
}

std::optional<Motion> GltfAnimation::local_motion(std::size_t number, const GltfValue& node) const {
  const NodeTransform still = node_transform(node);
  const auto found = nodes_.find(number);
  if (found == nodes_.end()) return Motion(affine(still));
  const std::vector<double> bounds = boundaries(found->second);
  if (bounds.size() == 1) {
    return Motion(segment(found->second, still, 0.0, 0.0).steps.front());
  }
  // The most that the segments may take.
  const std::size_t bytes = (bounds.size() - 1) * (Motion::most_steps + 1) * sizeof(Affine);
  if (!budget_.take_bytes(node.location(), bytes)) return {};
  std::vector<Motion::Segment> segments;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    segments.push_back(segment(found->second, still, bounds[i], bounds[i + 1]));
  }
  return Motion(std::move(segments));
}

}  // namespace nacre::host
