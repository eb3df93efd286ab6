#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "examples/render/bounds.h"

/// \file
/// What the render host asks of a material. The host finds hits, sorts them by
/// material and hands over batches in structure-of-arrays layout; everything
/// that depends on the material happens behind `Shader`.
///
/// Every lane pointer is 64-byte aligned and may be read and written up to
/// `count` rounded up to `lane_padding`; the contents of the padding mean nothing.
/// All memory belongs to the host and is allocated before rendering starts.
namespace nacre::host {

inline constexpr std::uint32_t lane_padding = 16;

/// Two, three or four floats per point, one array per component.
struct Lanes2 {
  float* x = nullptr;
  float* y = nullptr;
};
struct Lanes3 {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
};

/// What a shader reads. Position, normals, `wo` and uv are always there; the
/// rest is computed when its bit is set in `Capabilities::attributes`.
enum Attribute : std::uint32_t {
  attribute_object_space = 1u << 0,  ///< P_object, N_object (T_object, dPdx_object with their bit)
  attribute_tangents = 1u << 1,      ///< T, B
  attribute_surface_derivatives = 1u << 2,  ///< dPdu, dPdv
  attribute_footprint_position = 1u << 3,   ///< dPdx, dPdy
  attribute_footprint_uv = 1u << 4,         ///< dUVdx, dUVdy
  /// `geometry_id`, `primitive_id`
  attribute_ids = 1u << 5,
  attribute_time = 1u << 6,  ///< times, frames
};

/// A vertex attribute by name, beyond the first uv set. The loaders call them
/// "texcoord1", …, "color0", …, and a glTF `_NAME` attribute "NAME".
struct PrimvarRequest {
  std::string name;
  int components = 1;  ///< 1 to 4; missing ones are 0, but 1 for the fourth of a colour.
};

struct PrimvarLanes {
  std::int32_t* present = nullptr;  ///< 1 or 0: whether the mesh of the point has it.
  float* component[4] = {};         ///< 0 where it has not.
};

/// Entries of an affine matrix, a lane of points each: entry 4 i + k is component k of where
/// axis i goes, 12 to 14 where the origin goes. Rows, then, of a matrix for row vectors.
using MatrixLanes = std::array<float*, 16>;

/// Shading points. Directions are unit length unless a name starts with d;
/// lengths are scene units.
struct ShadingBatch {
  std::uint32_t count = 0;

  Lanes3 P;         ///< World position.
  Lanes3 N;         ///< World shading normal: interpolated, on the side of Ng, not flipped to wo.
  Lanes3 Ng;        ///< World geometric normal; its side is the front.
  Lanes3 wo;        ///< World direction to the viewer, away from the surface.
  Lanes2 uv;        ///< First uv set, (0,0) the lower left of a texture; 0 when the mesh has none.
  Lanes3 T, B;      ///< World tangent along +u, and bitangent along +v: orthonormal with N.
  Lanes3 P_object;  ///< Mesh-local position.
  Lanes3 N_object;  ///< Mesh-local shading normal.
  Lanes3 T_object, B_object;  ///< Mesh-local tangent and bitangent, unit, not orthogonalised.
  Lanes3 dPdu, dPdv;          ///< World; of the triangle, so constant on it.
  /// World footprint: change of P when the image sample moves one pixel right
  /// or down, already scaled to the distance between samples.
  Lanes3 dPdx, dPdy;
  Lanes3 dPdx_object, dPdy_object;  ///< The same, mesh-local.
  Lanes2 dUVdx, dUVdy;
  const std::uint32_t* geometry_id = nullptr;              ///< Index of the mesh in the scene.
  const std::uint32_t* primitive_id = nullptr;             ///< Triangle of that mesh.
  const PrimvarLanes* primvars = nullptr;                  ///< As many as requested, in that order.
  MatrixLanes object_to_world = {}, world_to_object = {};  ///< Filled are the entries asked for.

  float time = 0.f;   ///< Seconds; of all points while the shutter is closed.
  float frame = 1.f;  ///< MaterialX `frame`, likewise.
  float *times = nullptr, *frames = nullptr;  ///< The same at the time of each point.
  float* exterior_index = nullptr;            ///< Of refraction, of what is around; 1 is vacuum.
  std::int32_t* lobes_wanted = nullptr;       ///< LobeBit bits: what sample and evaluate are of.
  float* texture_u = nullptr;                 ///< Draws the texels of images, in [0, 1).
  float* min_alpha = nullptr;                 ///< What facets have at least, in [0, 1].
};

/// Lobes, as techniques tell them apart; glossy is what is rough.
enum LobeBit : std::int32_t {
  diffuse_reflection = 1 << 0,
  glossy_reflection = 1 << 1,
  diffuse_transmission = 1 << 2,
  glossy_transmission = 1 << 3,
  delta_reflection = 1 << 4,
  delta_transmission = 1 << 5,
  diffuse_lobes = diffuse_reflection | diffuse_transmission,
  reflecting_lobes = diffuse_reflection | glossy_reflection | delta_reflection,
  transmitting_lobes = diffuse_transmission | glossy_transmission | delta_transmission,
  all_lobes = reflecting_lobes | transmitting_lobes,
};

/// What scatters light, as passes tell it apart (passes.h).
enum class ScatterClass : std::uint8_t {
  diffuse,       ///< Reflection,
  glossy,        ///< rough
  mirror,        ///< or smooth.
  transmission,  ///< To the other side of the surface, any.
  subsurface,    ///< Light comes back from below.
  volume,        ///< In media.
};
inline constexpr std::size_t scatter_classes = 6;

/// What each class gives of a result.
using PartLanes = std::array<Lanes3, scatter_classes>;

enum ScatterFlag : std::uint32_t {
  sample_valid = 1u << 0,  ///< Clear: absorbed; every other output of the lane is ignored.
  sample_delta =
      1u << 1,  ///< From a Dirac lobe: `pdf` is a probability and light sampling is blind.
  sample_transmitted = 1u << 2,
  /// Light goes on below the surface, in what subsurface() says, and leaves where it meets the
  /// surface again: see ExitShader. With sample_delta.
  sample_subsurface = 1u << 3,
};

struct SampleLanes {
  Lanes3 wi;                         ///< World, away from the surface, unit length.
  Lanes3 weight;                     ///< rgb: f·cos/pdf.
  float* pdf = nullptr;              ///< Forward, per solid angle, over all lobes.
  std::uint32_t* flags = nullptr;    ///< ScatterFlag bits.
  std::int32_t* lobe = nullptr;      ///< Which one; for subsurface().
  std::int32_t* kinds = nullptr;     ///< Its LobeBit bits, where Techniques::chooses_lobes().
  float* alpha = nullptr;            ///< Of its facets, where Techniques::clamps_roughness; or 0.
  const PartLanes* parts = nullptr;  ///< Of `weight`. Null: not wanted.
};

struct EvaluateLanes {
  Lanes3 value;                      ///< rgb: f·|cos|, Dirac lobes excluded.
  float* pdf = nullptr;              ///< Forward; 0 where sample() cannot go.
  std::int32_t* kinds = nullptr;     ///< Of what value is, where Techniques::chooses_lobes().
  const PartLanes* parts = nullptr;  ///< Of `value`. Null: not wanted.
};

/// What passes say of a point.
struct PointLanes {
  Lanes3 albedo;               ///< rgb in [0, 1]: the share that leaves, by all lobes.
  Lanes3 normal;               ///< World, unit, towards the viewer: the mean of the lobes'.
  float* roughness = nullptr;  ///< In [0, 1], likewise.
  std::vector<float*> values;  ///< PassRequest::values, a component each.
};

/// What a surface encloses: see Medium.
struct InteriorLanes {
  Lanes3 absorption, scattering;
  float* anisotropy = nullptr;
  float* index = nullptr;  ///< Of interior(): of refraction, over that outside. Else null.
};

/// What a volume is of at a point.
struct VolumeLanes {
  InteriorLanes medium;
  Lanes3 emission;  ///< Radiance (rgb) per unit of length.
};

/// Light below a surface.
struct SubsurfaceLanes {
  InteriorLanes medium;
  Lanes3 albedo;  ///< rgb in [0, 1]: the share that leaves again.
  Lanes3 normal;  ///< World, unit, on either side: what light leaves about.
};

struct Capabilities {
  bool emits = false;           ///< emission() may be non-zero.
  bool has_opacity = false;     ///< opacity() may differ from 1.
  bool has_interior = false;    ///< Light that enters is in a medium.
  bool displaces = false;       ///< displacement() moves the surface.
  bool has_subsurface = false;  ///< sample() may say sample_subsurface.
  bool is_volume = false;  ///< There is no surface: light goes straight in, and volume() is all.
  bool volume_varies = false;    ///< volume() differs from place to place.
  bool scatters = true;          ///< False: emission only; sample, evaluate are never called.
  bool only_delta = false;       ///< evaluate() is always 0: no light sampling, no call.
  std::int32_t lobes = 0;        ///< LobeBit bits of all that there are, delta ones as glossy.
  std::uint32_t attributes = 0;  ///< Attribute bits read by any of the kernels.
  /// Entries read of `object_to_world`, bits 0 to 15, and of `world_to_object`, 16 to 31.
  std::uint32_t matrix_entries = 0;
  std::vector<PrimvarRequest> primvars;
};

/// The kernels of one surface. Calls are const and come from several threads at
/// once; what a batch needs between begin() and its other kernels is in `state`,
/// memory of the calling thread. Results must not depend on a point's lane, its
/// neighbours or `count`: the host promises images that are the same for any
/// number of threads.
class Shader {
 public:
  virtual ~Shader() = default;

  /// Constant during a render; asked once.
  virtual Capabilities capabilities() const = 0;

  /// Bytes of state for a batch of up to `capacity` points; 64-byte aligned.
  virtual std::size_t state_bytes(std::uint32_t capacity) const = 0;

  /// Fills `state` from the points. The other two only see states so filled,
  /// with the same batch.
  virtual void begin(const ShadingBatch& batch, void* state) const = 0;

  /// Draws one direction per point; `u` holds three numbers in [0, 1) per
  /// point: u.x chooses the lobe, (u.y, u.z) the direction.
  virtual void sample(const ShadingBatch& batch, const void* state, Lanes3 u,
                      SampleLanes out) const = 0;

  /// Value and density for one given direction per point.
  virtual void evaluate(const ShadingBatch& batch, const void* state, Lanes3 wi,
                        EvaluateLanes out) const = 0;

  /// Called when passes ask for it. What is not known is left as it is: 0, N for the normal.
  virtual void point(const ShadingBatch& batch, const void* state, const PointLanes& out) const {
    (void)batch, (void)state, (void)out;
  }

  /// Radiance (rgb) towards `wo`. Needs no state. Called when `emits`.
  virtual void emission(const ShadingBatch& batch, Lanes3 radiance) const = 0;

  /// rgb in [0, 1]: what is not let through unbent. Scales scattering and
  /// emission. Needs no state. Called when `has_opacity`.
  virtual void opacity(const ShadingBatch& batch, Lanes3 rgb) const = 0;

  /// What light is in behind the surface. Needs no state. Called when `has_interior`.
  virtual void interior(const ShadingBatch& batch, InteriorLanes out) const {
    (void)batch, (void)out;
  }

  /// What there is at points within, which have a position, the ray's wo, and no more. Needs no
  /// state. Called when `is_volume`.
  virtual void volume(const ShadingBatch& batch, VolumeLanes out) const { (void)batch, (void)out; }

  /// By how much the surface moves there, in world space, before anything is traced. Needs no
  /// state. Called when `displaces`.
  virtual void displacement(const ShadingBatch& batch, Lanes3 offset) const {
    (void)batch, (void)offset;
  }

  /// A box of what displacement() gives at all points of triangles whose corners are the lanes,
  /// infinite where nothing is known. Called when `displaces`.
  virtual Bounds displacement_box(const ShadingBatch& corners) const {
    (void)corners;
    return {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
  }

  /// What light is in below the surface, by SampleLanes::lobe. Needs no state. Called when
  /// `has_subsurface`.
  virtual void subsurface(const ShadingBatch& batch, const std::int32_t* lobe,
                          SubsurfaceLanes out) const {
    (void)batch, (void)lobe, (void)out;
  }
};

}  // namespace nacre::host
