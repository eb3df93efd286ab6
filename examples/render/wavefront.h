#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "examples/render/batch_buffer.h"
#include "examples/render/media.h"
#include "examples/render/medium_lanes.h"
#include "examples/render/passes.h"
#include "examples/render/render_context.h"
#include "examples/render/sampler.h"

namespace nacre::host {

/// One light path on its way, and its result.
struct Path {
  SampleKey key;  ///< key.event counts intersections.
  Ray ray;
  Vec3 throughput = {1.f, 1.f, 1.f};
  Vec3 radiance;        ///< What the path has brought so far.
  float alpha = 1.f;    ///< 0: it ended on a matte.
  int depth = 0;        ///< Scattering events.
  int passes = 0;       ///< Transparent surfaces passed.
  int scatterings = 0;  ///< Within media.

  int forks = 0;            ///< How often it has forked, before it forked off another, too.
  bool is_diffuse = false;  ///< One of diffuse_lobes has scattered it.
  float min_alpha = 0.f;    ///< The most that facets have had that scattered it.

  /// How the direction of `ray` was drawn, for multiple importance sampling.
  Vec3 vertex;              ///< Where.
  Vec3 normal;              ///< There, as LitPlace has it.
  float pdf = 0.f;          ///< Per solid angle.
  bool light_blind = true;  ///< By camera or Dirac lobe: light sampling cannot find it.
  bool unlit = false;       ///< From a mesh that lights do not illuminate.

  /// Footprint: exact while the path is straight from the camera, then a cone
  /// (Akenine-Möller et al. 2021, "Improved Shader and Texture Level of Detail
  /// Using Ray Cones", JCGT 10(1)).
  bool from_camera = true;
  float distance = 0.f;  ///< From `vertex` to ray.origin: not 0 behind transparent surfaces.
  float width = 0.f;     ///< Of the cone at `vertex`.
  float spread = 0.f;    ///< Radians.

  Media media;  ///< What it is inside of; last, for most paths are in nothing, and it is large.
};

/// By ScatterClass, which part of something is its; each channel adds up to 1.
using Shares = std::array<Vec3, scatter_classes>;

/// A run of a sorted index list: what belongs to one material.
struct Group {
  std::uint32_t begin = 0, end = 0;
};

/// Where a ray leaves the point of a lane in a direction: off the surface on the side that it goes
/// to. Through a fibre it goes at once: what happens inside is its material's.
Vec3 leave(const BatchBuffer& buffer, std::size_t lane, Vec3 direction);

/// Opening angle for a direction drawn with this density: the cone that holds a
/// quarter of the directions one sample stands for, at most a quarter radian.
float scattered_spread(float pdf);

/// Follows many paths at once, stage by stage, with the memory of one thread:
/// trace, sort by material, opacity, choose light samples, shade, trace shadows.
class Wavefront {
 public:
  Wavefront(const RenderContext& context, std::size_t max_paths);

  /// Follows paths (ray and key set) to their ends; results are in `radiance`.
  void trace(std::span<Path> paths);

  /// What passes need of path i of those that trace() followed.
  PathRecord record(std::size_t i) const;

  /// Of all paths since the last call.
  RenderCounts take_counts() { return std::exchange(counts_, {}); }

 private:
  struct LightSample {
    Vec3 wi;
    Vec3 radiance;
    Vec3 target;      ///< Off the light's surface; unused for the environment.
    float pdf = 0.f;  ///< Per solid angle, with all choices; 0: no sample.
    bool infinite = false;
    bool unseen = false;     ///< No ray meets it, so no other sample finds it.
    std::uint8_t group = 0;  ///< Of LightGroups.
  };
  struct LightPoint {
    std::uint32_t path;
    SurfacePoint point;
  };
  /// What draws a light, and where on it.
  struct LightNumbers {
    Uniform2 light, place;
  };
  /// A path that a light is chosen for that no ray meets, which one, and where the path is.
  struct LitPoint {
    std::uint32_t path, light;
    float probability;  ///< Of that choice.
    InnerPoint point;
  };
  struct ShadowRay {
    Ray ray;
    Vec3 contribution;
    Vec3 target;
    std::uint32_t path;
    bool infinite;
    std::uint32_t connection = 0;  ///< Of connections_, where light is split up.
  };
  /// How light of a shadow ray is split up.
  struct Connection {
    Shares shares;
    std::uint8_t group;
    bool is_direct;
  };
  /// What a path has gone through, where light is split up.
  struct Trace {
    Shares shares = {};        ///< Of the first scattering event.
    bool is_known = false;     ///< Whether that was.
    bool is_below = false;     ///< On a walk below a surface.
    std::uint32_t events = 0;  ///< A walk is one.
  };
  /// What a shadow ray is inside of: by its place in shadows_, where there are volumes.
  struct ShadowMedia {
    Media media;
    SampleKey key;
  };
  /// Where a path was scattered within volumes.
  struct Scattering {
    std::uint32_t path;
    Vec3 along;  ///< Where light went, seen from the camera; its place is Path::vertex.
    float anisotropy;
    Vec3 throughput;  ///< Before the direction was drawn.
  };

  // wavefront.cpp
  void intersect();
  void add_environment();
  void group_by_material();
  void hold_out();
  SurfacePoint surface_point(std::uint32_t path) const;
  void fill(std::span<const std::uint32_t> paths, const Material& material);
  Uniform2 draw(const Path& path, Draw what) const;
  void draw(std::span<const std::uint32_t> paths, Draw what, std::vector<Uniform2>& numbers);
  float hit_weight(const Path& path, float light_pdf) const;
  float connection_weight(float light_pdf, float material_pdf) const;
  bool connects() const;

  // wavefront_passes.cpp
  void prepare_passes(std::size_t max_paths);
  void begin_passes();
  void add_found(std::uint32_t path, Vec3 found, std::uint8_t group, bool is_background = false);
  void add_connected(const ShadowRay& shadow);
  void note_connection(std::uint32_t path, std::size_t lane);
  void note_connection_inside(std::uint32_t path);
  void connect_as(const Connection& connection);
  void note_scattering(std::uint32_t path, std::size_t lane);
  void note_scattering_inside(std::uint32_t path);
  void record_hits(const Material& material, std::span<const std::uint32_t> paths);
  void record_hit(std::uint32_t path, std::size_t lane);
  Vec2 motion_of(SurfacePoint point) const;

  // wavefront_opacity.cpp
  void apply_opacity();
  std::uint32_t pass_through(const Material& material, std::span<std::uint32_t> paths);

  // wavefront_shadow.cpp
  void add_shadow(const LightSample& light, std::uint32_t path, Vec3 origin, Vec3 contribution);
  void trace_shadows();
  void trace_opaque_shadows();
  void trace_dimmed_shadows();
  SurfacePoint shadow_point(std::size_t i) const;
  void fill_shadows(std::span<const std::uint32_t> shadows, const Material& material);
  void attenuate(const Material& material, std::span<const std::uint32_t> shadows,
                 std::uint32_t met);
  void go_on(std::size_t shadow, std::size_t lane);

  // wavefront_shadow_media.cpp
  void dim_shadows();
  bool may_dim(std::uint32_t shadow);
  void dim_by_points(const Material& material, std::span<const std::uint32_t> shadows);
  void cross_border(const Material& material, std::span<const std::uint32_t> shadows);

  // wavefront_medium.cpp
  void cross_media();
  bool scatter_inside(std::uint32_t path, const Medium& medium, float distance);
  void connect_media();
  void find_media(const Material& material, std::size_t lanes);
  bool goes_within(const Material& material, const Hit& hit, std::size_t lane, Vec3 wi) const;
  bool goes_out(const Media& media, const Hit& hit, std::size_t lane, Vec3 wi) const;
  void change_medium(const Material& material, Path& path, const Hit& hit, std::size_t lane);

  // wavefront_nested.cpp
  bool is_hidden(std::uint32_t path) const;
  void pass_hidden();
  void pass_hidden(const Material& material, std::span<const std::uint32_t> paths);
  void fill_exterior(std::span<const std::uint32_t> paths);
  void ask_interior(const Material& material);
  void enter_solid(Media& media, const Hit& hit, std::size_t lane);

  // wavefront_volume.cpp
  bool may_meet(std::uint32_t path, const Medium& medium, float far);
  void enter_volumes();
  void enter_volume(const Material& material, std::span<const std::uint32_t> paths);
  void take_through(Media& media, const Material& material, const Hit& hit, std::size_t lane,
                    Vec3 direction);
  void meet_media();
  void meet_medium(const Material& material, std::span<const std::uint32_t> paths);

  // wavefront_light.cpp
  void sample_lights();
  Vec3 lit_normal(std::uint32_t path) const;
  void choose_lights();
  void choose_light(std::uint32_t path, const InnerPoint& from, Vec3 normal, LightNumbers numbers);
  void ask_lights();
  void ask_environment();
  void light_emission(const Material& material, std::span<const std::uint32_t> points);
  void light_points(const LightShader& light, std::span<const std::uint32_t> lit);

  // wavefront_techniques.cpp
  void prepare_techniques(std::size_t max_paths);
  std::span<Path> with_forks(std::span<Path> paths);
  void join_forks(std::span<Path> paths);
  bool may_fork(const Material& material, const Path& path) const;
  void fork(const Material& material, std::span<const std::uint32_t> paths);
  void clamp_roughness(std::span<const std::uint32_t> paths);
  void draw_texels(std::span<const std::uint32_t> points,
                   const std::function<std::uint32_t(std::uint32_t)>& path_of, Draw what,
                   std::uint32_t step = 0);
  void want_lobes(const Material& material, std::span<const std::uint32_t> paths,
                  std::int32_t of_forks);
  void note_lobe(Path& path, std::size_t lane) const;
  Vec3 limited(Vec3 contribution, bool is_indirect) const;
  bool survives(Path& path, Vec3 before) const;

  // wavefront_shade.cpp
  void weigh_connections(const Material& material, std::span<const std::uint32_t> paths);
  void shade();
  void shade_batch(const Material& material, std::span<const std::uint32_t> paths);
  void add_emission(const Material& material, std::span<const std::uint32_t> paths);
  void connect_lights(const Material& material, std::span<const std::uint32_t> paths);
  void extend(const Material& material, std::span<const std::uint32_t> paths);
  void sample(const Material& material, std::span<const std::uint32_t> paths);
  void go_on(const Material& material, std::uint32_t path, std::size_t lane);
  bool scatter(Path& path, std::size_t lane, float distance);

  const RenderContext& context_;
  BatchBuffer buffer_;
  std::span<Path> paths_;
  std::vector<std::uint32_t> active_, next_;  ///< Paths that have a ray now; and after this round.
  std::vector<Ray> rays_;                     ///< Of the active paths, in their order.
  std::vector<Hit> ray_hits_;
  std::vector<Hit> hits_;           ///< By path.
  std::vector<std::uint32_t> met_;  ///< Paths that may meet something before they hit,
  std::vector<float> met_at_;       ///< by path: how far away;
  std::vector<std::uint32_t> met_order_;
  std::vector<Group> met_groups_;                 ///< by material.
  std::vector<InnerPoint> inner_points_;          ///< Of the batch at hand.
  std::vector<std::uint32_t> sorted_;             ///< Paths that hit, by material.
  std::vector<Group> groups_;                     ///< Of sorted_; one per material.
  std::vector<LightSample> light_samples_;        ///< By path.
  std::vector<std::uint32_t> asking_;             ///< Paths that a light is chosen for.
  std::vector<std::uint32_t> lit_by_sky_;         ///< Those of them that the environment is,
  std::vector<Uniform2> sky_numbers_;             ///< what draws its direction,
  std::vector<Environment::Sample> sky_samples_;  ///< and what that is.
  std::vector<std::uint32_t> missed_;             ///< Paths that end in the environment,
  std::vector<Vec3> ways_out_;                    ///< where they go,
  std::vector<Environment::Light> found_;         ///< and what they find.
  std::vector<SampleKey> keys_;                   ///< Of the numbers that are drawn,
  std::vector<Uniform2> numbers_, more_numbers_;  ///< which are these.
  std::vector<Uniform2> texel_numbers_;           ///< What draws texels of images.
  std::vector<LightPoint> light_points_;
  std::vector<std::uint32_t> light_order_;
  std::vector<Group> light_groups_;
  std::vector<LitPoint> lit_;
  std::vector<std::uint32_t> lit_order_;
  std::vector<Group> lit_groups_;        ///< By light.
  std::vector<Scattering> scatterings_;  ///< Of this round.
  std::vector<ShadowRay> shadows_;
  std::vector<ShadowMedia> shadow_media_;
  std::vector<std::uint32_t> shadow_order_;
  std::vector<Group> shadow_groups_;
  std::vector<std::uint8_t> blocked_;
  std::vector<SurfacePoint> points_;  ///< Of the batch at hand.
  std::vector<Vec3> weighed_;         ///< By lane: f |cos| of a light sample, times its weight.
  // Of Techniques; empty where none is used.
  std::size_t given_ = 0;    ///< Paths that trace() was given; those after them are forks.
  std::vector<Path> forks_;  ///< All of a call, with room for forks.
  // Of passes; empty where none needs them.
  std::vector<LightSplit> splits_;  ///< By path,
  std::vector<Trace> traces_;       ///< likewise, of PassNeed::split.
  std::vector<Connection> connections_;
  std::optional<LaneMemory> part_memory_, point_memory_;
  PartLanes sample_parts_, value_parts_;
  PointLanes point_;                                ///< Of the batch at hand.
  std::vector<FirstHit> first_hits_;                ///< By path.
  std::vector<float> values_;                       ///< By path, all of one together.
  bool asks_points_ = false, asks_motion_ = false;  ///< PassNeed::point and motion.
  RenderCounts counts_;
};

/// Counting sort, stable: `order` lists the indices 0 … count-1 by key(i), a
/// number below the size of `groups`; those with key ~0 are left out.
template <class Key>
void group_by(std::size_t count, std::vector<std::uint32_t>& order, std::vector<Group>& groups,
              Key key) {
  for (Group& g : groups) g = {};
  std::vector<std::uint32_t> keys(count);
  for (std::size_t i = 0; i < count; ++i) {
    keys[i] = key(i);
    if (keys[i] != ~0u) ++groups[keys[i]].end;
  }
  std::uint32_t total = 0;
  for (Group& g : groups) {
    const std::uint32_t size = g.end;
    g.begin = g.end = total;
    total += size;
  }
  order.resize(total);
  for (std::size_t i = 0; i < count; ++i) {
    if (keys[i] != ~0u) order[groups[keys[i]].end++] = static_cast<std::uint32_t>(i);
  }
}

/// Calls f(sub-span) on pieces of at most `size` elements.
template <class T, class F>
void for_batches(std::span<T> all, std::size_t size, F f) {
  for (std::size_t first = 0; first < all.size(); first += size) {
    f(all.subspan(first, std::min(size, all.size() - first)));
  }
}

/// Adds the time of its life to a sum of seconds.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds);
  ~Stopwatch();
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  double start_;
};

}  // namespace nacre::host
