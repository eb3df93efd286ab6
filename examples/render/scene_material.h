#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "examples/render/vec.h"

namespace nacre::host {

/// An image of a scene file: a file of its folder, or bytes that it holds itself.
struct SceneImage {
  std::string file;                          ///< Relative to the scene's folder; of bytes "".
  std::shared_ptr<const std::string> bytes;  ///< As a file of that format has them.
  std::string extension;                     ///< Of bytes: ".png" or ".jpg".
};

/// How an image is laid on a surface: KHR_texture_transform takes uv to T R S uv.
struct SceneTexture {
  enum class Wrap { repeat, clamp, mirror };

  std::size_t image = 0;  ///< Of SceneMaterials.
  std::size_t set = 0;    ///< TEXCOORD_n.
  Vec2 offset = {0.f, 0.f}, scale = {1.f, 1.f};
  float rotation = 0.f;  ///< Radians, counter-clockwise where the picture is upright.
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool is_closest = false;  ///< Texels are squares.
};

/// A number, or three, of which a texture gives a share at each point.
template <class Value>
struct Textured {
  Value value;
  std::optional<SceneTexture> texture;  ///< Multiplies.
};

/// A material as glTF 2.0 and its extensions have it (3.9, 5.19, KHR_materials_*). Textures are of
/// the channels that those say.
struct SceneMaterial {
  enum class Alpha { opaque, mask, blend };
  using Color = std::array<float, 3>;

  std::string name;  ///< As the file calls it; may be empty.
  bool two_sided = false;
  bool is_unlit = false;
  Alpha alpha = Alpha::opaque;
  float alpha_cutoff = 0.5f;

  Textured<std::array<float, 4>> base_color{{1.f, 1.f, 1.f, 1.f}, {}};
  float metallic = 1.f, roughness = 1.f;
  std::optional<SceneTexture> metallic_roughness;
  /// KHR_materials_pbrSpecularGlossiness: base_color is the diffuse colour then, and of what is
  /// above nothing else counts.
  struct Glossy {
    Color specular = {1.f, 1.f, 1.f};
    float glossiness = 1.f;
    std::optional<SceneTexture> texture;
  };
  std::optional<Glossy> glossy;

  Textured<float> normal{1.f, {}};  ///< The value is the scale.
  Textured<Color> emissive{{0.f, 0.f, 0.f}, {}};
  float emissive_strength = 1.f;

  float ior = 1.5f;
  Textured<float> specular{1.f, {}};
  Textured<Color> specular_color{{1.f, 1.f, 1.f}, {}};
  Textured<float> transmission{0.f, {}};
  /// Of a solid; without it what is transparent is a thin wall.
  struct Volume {
    Textured<float> thickness{0.f, {}};
    std::optional<float> attenuation_distance;  ///< Scene units; none: clear.
    Color attenuation_color = {1.f, 1.f, 1.f};
  };
  std::optional<Volume> volume;
  Textured<float> clearcoat{0.f, {}}, clearcoat_roughness{0.f, {}};
  Textured<float> clearcoat_normal{1.f, {}};
  Textured<Color> sheen_color{{0.f, 0.f, 0.f}, {}};
  Textured<float> sheen_roughness{0.f, {}};
  Textured<float> iridescence{0.f, {}};
  float iridescence_ior = 1.3f;
  float iridescence_least = 100.f;                   ///< Nanometres, where the texture has 0.
  Textured<float> iridescence_thickness{400.f, {}};  ///< Where it has 1.
  Textured<float> anisotropy{0.f, {}};
  float anisotropy_rotation = 0.f;  ///< Radians.
  float dispersion = 0.f;
};

/// What a scene says of how its meshes look.
struct SceneMaterials {
  std::vector<SceneMaterial> all;  ///< Mesh::material counts these.
  std::vector<SceneImage> images;
};

}  // namespace nacre::host
