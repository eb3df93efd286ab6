#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "examples/render/shader.h"
#include "examples/render/vec.h"

/// \file
/// Images beside the picture. What has to do with light adds up: emission, background and all
/// direct and indirect passes are the picture; so are all light groups.
namespace nacre::host {

/// What adds to a path's radiance, told apart by lights.
struct LightGroups {
  static constexpr std::size_t most = 8;

  std::vector<std::string> names;      ///< At most `most`; what is in none is the group after.
  std::vector<std::uint8_t> of_mesh;   ///< By mesh; empty: all in the group after.
  std::vector<std::uint8_t> of_light;  ///< By RenderInput::lights; likewise.
  std::uint8_t of_environment = 0;

  std::uint8_t mesh(std::uint32_t i) const { return i < of_mesh.size() ? of_mesh[i] : rest(); }
  std::uint8_t light(std::uint32_t i) const { return i < of_light.size() ? of_light[i] : rest(); }
  std::uint8_t rest() const { return static_cast<std::uint8_t>(names.size()); }
};

/// What a path has brought, split up.
struct LightSplit {
  Vec3 emission;    ///< Of what the camera sees itself, meshes and volumes,
  Vec3 background;  ///< and the environment behind them.
  /// By what scattered light last before the camera: after it comes from a light,
  std::array<Vec3, scatter_classes> direct;
  std::array<Vec3, scatter_classes> indirect;  ///< and after it was scattered elsewhere.
  std::array<Vec3, LightGroups::most + 1> group;
};

/// What the camera sees: of the first surface that does not let a path through.
struct FirstHit {
  bool is_there = false;
  Vec3 albedo, normal;  ///< Of all lobes; world, unit and towards the viewer: see PointLanes.
  float roughness = 0.f;
  Vec3 position;      ///< World.
  float depth = 0.f;  ///< Along the camera's axis.
  Vec2 uv;
  Vec2 motion;             ///< Pixels, right and down, while the shutter is open.
  std::uint32_t mesh = 0;  ///< Of the scene.
};

/// What is known of one path.
struct PathRecord {
  LightSplit light;
  FirstHit hit;
  std::span<const float> values;  ///< PassRequest::values, one after another; 0 where not there.
};

/// What has to be found out for a pass.
enum class PassNeed {
  group,   ///< LightSplit::group,
  split,   ///< the rest of LightSplit,
  hit,     ///< FirstHit,
  point,   ///< what kernels say of it, too,
  motion,  ///< or FirstHit::motion.
};

/// An image, or a layer of one.
struct Pass {
  enum class Mean {
    samples,  ///< Over all of a pixel.
    hits,     ///< Over those that hit something.
    first,    ///< None: that of the first sample.
  };
  std::string name;                   ///< "direct_diffuse"
  std::string path_expression;        ///< The same as a light path expression: "C<RD>[LO]"
  std::string about;                  ///< For help texts.
  std::vector<std::string> channels;  ///< Of the layer: R G B, X Y Z, V, …
  PassNeed need = PassNeed::split;
  Mean mean = Mean::samples;
  /// As many numbers as there are channels.
  void (*read)(const PathRecord& record, std::size_t which, float* to) = nullptr;
  std::size_t which = 0;  ///< Given to `read`: a scatter class, a group, the first of values.
};

/// A value of the graphs that is wanted at the first hit.
struct GraphValue {
  std::string name;  ///< As KernelRequest::with_begin has it.
  int components = 1;
};

/// What a render is asked for.
struct PassRequest {
  std::vector<Pass> passes;
  LightGroups groups;
  std::vector<GraphValue> values;
  bool object_mattes = false;  ///< Cryptomattes: see cryptomatte.h.
  bool material_mattes = false;

  /// Whether anything needs that; what needs more of a hit needs the hit.
  bool any(PassNeed need) const;
  std::size_t channels() const;
  /// Floats of all values.
  std::size_t value_floats() const;
};

/// All that can be asked for by name or path expression but groups and values of graphs.
std::span<const Pass> known_passes();

/// By either; nothing where there is none.
std::optional<Pass> find_pass(std::string_view name);

/// What the lights of a group give: LightGroups::names, or for the last "other".
Pass group_pass(const LightGroups& groups, std::size_t group);

/// A value of graphs; `first`: where it begins in PathRecord::values.
Pass value_pass(const GraphValue& value, std::size_t first);

}  // namespace nacre::host
