#pragma once

#include <cstdint>
#include <vector>

#include "examples/render/light_tree.h"
#include "examples/render/sampler.h"

namespace nacre::host {

class RenderContext;

/// All that light sampling knows of a scene, and which of it is asked for a place.
///
/// The environment, lights nobody knows the place of, and all that are somewhere (triangles that
/// emit, points and spots) have the same chance each, if there are any. Of those that are somewhere
/// a LightTree draws one by what may arrive; the others are drawn by what probes found of them.
class SceneLights {
 public:
  enum class Kind {
    none,         ///< No sample.
    environment,  ///< Which has densities of its own.
    unmet,        ///< A light that no ray meets.
    triangle,
  };
  struct Choice {
    Kind kind = Kind::none;
    float probability = 0.f;               ///< Of all choices together.
    std::uint32_t light = 0;               ///< Of `unmet`: index of RenderContext::point_lights.
    std::uint32_t mesh = 0, triangle = 0;  ///< Of `triangle`,
    float area = 0.f;                      ///< how large it is,
    bool front = false, back = false;      ///< and the sides that are asked.
  };

  SceneLights() = default;
  /// Of what else the context holds.
  explicit SceneLights(const RenderContext& context);

  bool empty() const;
  /// Whether choose() and area_pdf() depend on where; otherwise all is the environment's.
  bool asks_where() const { return environment_chance_ < 1.f; }
  Choice choose(const LitPlace& from, Uniform2 u) const;
  /// Density per area with which choose() finds points of a side of a triangle from there, if they
  /// are drawn evenly over it. 0 where paths alone find it: of what is closed the inside, sides
  /// that probes saw nothing of at all, and all that moves.
  float area_pdf(const LitPlace& from, std::uint32_t mesh, std::uint32_t triangle, bool back) const;
  /// Chance of the environment.
  float environment_chance() const { return environment_chance_; }

 private:
  /// What is somewhere; its mesh is none for one that no ray meets.
  struct Entry {
    static constexpr std::uint32_t none = ~0u;
    std::uint32_t mesh = none, index = 0;  ///< Triangle, or light.
    float area = 0.f;
    bool front = false, back = false;
  };
  struct Gathering;

  LightTree tree_;
  std::vector<Entry> entries_;        ///< By the tree's numbers.
  std::vector<std::uint32_t> first_;  ///< By mesh: of its entries, or none.
  std::vector<std::uint32_t> far_;    ///< Lights without a known place.
  std::vector<double> far_cdf_;       ///< Their number and 1.
  float environment_chance_ = 0.f, far_chance_ = 0.f, tree_chance_ = 0.f;
};

}  // namespace nacre::host
