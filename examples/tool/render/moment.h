#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "examples/render/bvh.h"
#include "examples/render/render.h"
#include "examples/tool/render/shaders.h"

namespace nacre::tool {

/// A scene as it stands at a time, and what shades it: all of a picture but its camera.
class RenderMoment {
 public:
  /// Takes the time and frame that RenderOptions::settings has. Nothing after an error. All of
  /// these live as long.
  static std::unique_ptr<RenderMoment> create(const RenderOptions& options, const Opened& opened,
                                              host::Scene world,
                                              const host::Environment& environment,
                                              RenderShaders& shaders, Diagnostics& diagnostics);

  const host::Scene& world() const { return world_; }
  /// To make another moment of.
  host::Scene take_world() { return std::move(world_); }
  const host::RenderSettings& settings() const { return settings_; }
  const SceneShaders& shaders() const { return shaders_; }
  const std::vector<MeshAssignment>& assignments() const { return assignments_; }
  /// But for the camera, and before anything is displaced.
  const host::RenderInput& input() const { return input_; }
  /// Whether any surface is displaced, which a camera decides on.
  bool displaces() const;
  /// What rays are traced against, made when it is asked for first; null where memory runs out.
  const host::Bvh* bvh(Diagnostics& diagnostics);

 private:
  RenderMoment(host::Scene world, const host::RenderSettings& settings);
  bool assign(const RenderOptions& options, const Opened& opened, RenderShaders& shaders,
              Diagnostics& diagnostics);
  void bind(const std::string& scene_file, Diagnostics& diagnostics);
  bool complete_passes(const PassOptions& options, Diagnostics& diagnostics);

  host::Scene world_;
  host::RenderSettings settings_;
  std::vector<MeshAssignment> assignments_;
  SceneShaders shaders_;
  std::vector<host::PunctualShader> punctual_;
  host::RenderInput input_;
  std::optional<host::Bvh> bvh_;
};

}  // namespace nacre::tool
