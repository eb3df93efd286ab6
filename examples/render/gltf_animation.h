#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "examples/render/gltf_accessor.h"
#include "examples/render/gltf_dropped.h"
#include "examples/render/gltf_track.h"
#include "examples/render/gltf_transform.h"
#include "examples/render/motion.h"
#include "examples/render/scene_budget.h"

namespace nacre::host {

/// An animation of a glTF file (2.0, 3.11): how nodes move while the shutter is open.
class GltfAnimation {
 public:
  GltfAnimation(const GltfValue& root, GltfAccessors& accessors, SceneBudget& budget,
                GltfDropped& dropped, const Shutter& shutter)
      : root_(root), accessors_(accessors), budget_(budget), dropped_(dropped), shutter_(shutter) {}

  /// `wanted`: its name, or its number from 0; "": the first, if there is one. False after an
  /// error: no such animation, a wrong channel, sampler or accessor.
  bool read(const std::string& wanted);

  /// How a node moves within its parent. A scale counts as at least 1e-6, so that what an
  /// animation hides by it can be inverted. Nothing, with an error, where that takes too much.
  std::optional<Motion> local_motion(std::size_t number, const GltfValue& node) const;

  /// The weights of a node's morph targets at a time from 0, where the shutter opens, to 1; those
  /// that are stored where they are not animated.
  std::vector<double> weights(std::size_t number, std::vector<double> stored, float time) const;
  /// Steps of time in which they may be taken to run straight; 0: they stand still.
  std::size_t weight_steps(std::size_t number) const;

 private:
  /// Of a node, those that there are: translation, rotation, scale.
  using Tracks = std::array<const GltfTrack*, 3>;

  /// Nothing, with an error, where there is no such animation.
  std::optional<std::size_t> chosen(const std::string& wanted) const;
  bool read_channel(const GltfValue& animation, const GltfValue& channel);
  bool read_weights(const GltfValue& animation, std::size_t sampler, const GltfValue& target);
  const GltfTrack* track(const GltfValue& samplers, std::size_t number, bool is_rotation);
  std::vector<double> boundaries(const Tracks& tracks) const;
  Motion::Segment segment(const Tracks& tracks, NodeTransform still, double from, double to) const;

  GltfValue root_;
  GltfAccessors& accessors_;
  SceneBudget& budget_;
  GltfDropped& dropped_;
  Shutter shutter_;
  /// By number and whether it turns: what a wrong file uses for both is looked at for both.
  std::map<std::pair<std::size_t, bool>, std::unique_ptr<GltfTrack>> samplers_;
  std::map<std::size_t, Tracks> nodes_;
  std::map<std::size_t, std::vector<std::unique_ptr<GltfTrack>>> weights_;
};

}  // namespace nacre::host
