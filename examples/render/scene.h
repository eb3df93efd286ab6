#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "examples/render/bounds.h"
#include "examples/render/motion.h"
#include "examples/render/punctual_light.h"
#include "examples/render/scene_material.h"
#include "examples/render/vec.h"

namespace nacre::host {

struct Triangle {
  std::uint32_t v[3] = {};
};

/// A further vertex attribute, `components` floats per vertex.
struct Primvar {
  std::string name;  ///< "texcoord1", "color0", …; see PrimvarRequest.
  int components = 1;
  std::vector<float> values;
};

struct Tangent {
  Vec3 direction;    ///< World, along +u.
  float sign = 1.f;  ///< Bitangent = sign · cross(N, T), along +v (glTF 2.0, 3.7.2.1).
};

/// Vertices of a mesh at one time.
struct MeshPose {
  std::vector<Vec3> position, normal;
  std::vector<Tangent> tangent;
};

/// What a ray is for. Bits: a mesh may be hidden from some.
enum RayKind : std::uint32_t {
  ray_camera = 1u << 0,
  ray_shadow = 1u << 1,
  ray_secondary = 1u << 2,  ///< Scattered.
  ray_any = ray_camera | ray_shadow | ray_secondary,
};

/// One drawable piece of geometry with one material, baked to world space; or, with `instances`,
/// one whose vertices are in its own space.
struct Mesh {
  std::string object_name;    ///< Node of the scene graph.
  std::string mesh_name;      ///< Data block; several objects may share it.
  std::string material_name;  ///< As the file calls it; may be empty.
  std::string path;           ///< "/parent/object"; empty: the object stands at the top.
  /// Of the scene's materials, where those were asked for; none: the file says none.
  std::optional<std::size_t> material;

  /// Part of the stage that the built-in scene and a floor are: of no material unless one
  /// is called as the mesh's is.
  bool is_stage = false;
  std::uint32_t visible_to = ray_any;  ///< RayKind bits of the rays that meet it.
  bool two_sided = true;               ///< False: camera rays pass through its back.
  /// Held out: where the camera sees it the image is black with alpha 0. Other rays
  /// meet it as it is.
  bool matte = false;
  /// False: light straight from lights and the environment does not scatter from it.
  bool illuminated = true;
  /// Where solids overlap the one of the highest is there: see Media.
  int priority = 0;

  std::vector<Triangle> triangles;  ///< Counter-clockwise seen from the front.
  /// Of fibres, at each vertex: half their thickness. Triangle i is then the piece from v[0] to
  /// v[1], which is the next vertex; v[2] is v[1].
  std::vector<float> radius;
  std::vector<Vec3> position;         ///< World, if there are no instances.
  std::vector<Vec3> position_object;  ///< Mesh-local; empty: as world.
  std::vector<Vec3> normal;           ///< World, unit; as position; empty: faces are flat.
  std::vector<Tangent> tangent;       ///< World, unit; as position; empty: by uv, of flat faces.
  /// Of what bends while the shutter is open: its vertices at equal times until it closes; what is
  /// above is as it opens. In between they run straight, as Embree has it. What bends and emits is
  /// no light that light sampling knows.
  std::vector<MeshPose> poses;
  std::vector<Vec2> uv;  ///< (0,0) lower left; empty: none.
  std::vector<Primvar> primvars;
  Affine object_to_world;  ///< Of what is baked.
  /// Drawn once for each, where that takes the vertices. An instance that emits is no light that
  /// light sampling knows: paths find it.
  std::vector<Motion> instances;

  /// Set: an area light of this radiance (rgb) that does not scatter; the
  /// material is not used. Emits from the front only unless `two_sided`.
  std::optional<Vec3> light_radiance;
  bool light_two_sided = false;

  bool is_fibres() const { return !radius.empty(); }
};

/// Pin-hole camera, or thin lens when `lens_radius` > 0. Looks from `position`
/// along `forward`; `up` and `right` complete an orthonormal frame.
struct Camera {
  Vec3 position = {0.f, 0.f, 5.f};
  Vec3 forward = {0.f, 0.f, -1.f};
  Vec3 up = {0.f, 1.f, 0.f};
  Vec3 right = {1.f, 0.f, 0.f};
  float vertical_fov = 0.7853982f;  ///< Radians, of the whole image height.
  float lens_radius = 0.f;          ///< Scene units.
  float focus_distance = 1.f;       ///< Along `forward`; scene units.
};

/// A camera that stands in a scene.
struct SceneCamera {
  std::string name;  ///< No other one of the scene has it.
  Camera camera;
  Motion motion = {};  ///< Takes it to where it is while the shutter is open.
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<PunctualLight> lights;
  std::vector<SceneCamera> cameras;  ///< In the order of the file; none: see fit_camera().
  bool is_animated = false;          ///< At another time it may stand otherwise.
  SceneMaterials materials;          ///< Where they were asked for.
};

/// World bounds of all vertices that a triangle uses, lights left out; of instances those of their
/// boxes.
Bounds bounds(const Scene& scene);

}  // namespace nacre::host
