// Solids within one another: which there are, and scenes whose light is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/medium.h"
#include "examples/render/mesh.h"
#include "examples/render/nested_solids.h"
#include "examples/render/render.h"
#include "tests/examples/render/statistics.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

Mesh ball(Vec3 centre, float radius, int priority = 0) {
  Mesh mesh = make_sphere("ball", centre, radius, 96);
  mesh.priority = priority;
  return mesh;
}

TEST(NestedSolids, AreTwoThatLetLightInAndOverlap) {
  Scene scene;
  scene.meshes = {ball({}, 1.f), ball({1.5f, 0, 0}, 1.f), ball({0, 0, 5}, 1.f)};
  std::set<std::uint32_t> asked;
  const auto all = [&](std::uint32_t mesh) { return asked.insert(mesh).second; };
  const NestedSolids found = find_nested_solids(scene, all);
  EXPECT_EQ(found.solid, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(found.within, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(asked, (std::set<std::uint32_t>{0, 1}));  // Once, and of what is alone never.
  const auto one = [](std::uint32_t mesh) { return mesh != 1; };
  EXPECT_TRUE(find_nested_solids(scene, one).solid.empty());
}

TEST(NestedSolids, AreClosed) {
  Scene scene;
  scene.meshes = {ball({}, 1.f), ball({1.f, 0, 0}, 1.f)};
  scene.meshes[1].triangles.pop_back();
  EXPECT_TRUE(find_nested_solids(scene, [](std::uint32_t) { return true; }).solid.empty());
}

// What is opaque is none, but may be in one.
TEST(NestedSolids, SayWhatMayBeWithin) {
  Scene scene;
  scene.meshes = {ball({}, 1.f), ball({}, 0.5f), ball({0, 1.f, 0}, 0.5f), ball({0, 3, 0}, 1.f)};
  const NestedSolids found = find_nested_solids(scene, [](std::uint32_t m) { return m < 2; });
  EXPECT_EQ(found.solid, (std::vector<bool>{true, true, false, false}));
  EXPECT_EQ(found.within, (std::vector<bool>{true, true, true, false}));
}

TEST(NestedSolids, MayBeInstancesOfOneMesh) {
  Scene scene;
  scene.meshes = {ball({}, 1.f)};
  const auto at = [](float x) {
    Affine map;
    map.origin = {x, 0, 0};
    return Motion(map);
  };
  scene.meshes[0].instances = {at(0), at(3)};
  const auto all = [](std::uint32_t) { return true; };
  EXPECT_TRUE(find_nested_solids(scene, all).solid.empty());
  scene.meshes[0].instances.push_back(at(1));
  EXPECT_EQ(find_nested_solids(scene, all).solid.size(), 1u);
}

/// Smooth, of an index, full of something: Fresnel's formulas as in Born and Wolf, 1.5.2, eq. 21.
class GlassShader final : public LambertShader {
 public:
  explicit GlassShader(float index, const Medium& medium = {})
      : LambertShader({1.f, 1.f, 1.f}), index_(index), medium_(medium) {}
  Capabilities capabilities() const override {
    Capabilities c;
    c.only_delta = c.has_interior = true;
    return c;
  }
  void sample(const ShadingBatch& batch, const void*, Lanes3 u, SampleLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const Vec3 wo = load(batch.wo, i), ng = load(batch.Ng, i);
      const bool inside = dot(ng, wo) < 0.f;
      const Vec3 n = inside ? -ng : ng;
      const double before = inside ? index_ : batch.exterior_index[i];
      const double behind = inside ? batch.exterior_index[i] : index_;
      const double cos_i = std::min(1.0, double{dot(n, wo)});
      const double sin_t = before / behind * std::sqrt(1 - cos_i * cos_i);
      double reflected = 1, cos_t = 0;
      if (sin_t < 1) {
        cos_t = std::sqrt(1 - sin_t * sin_t);
        const double s = (before * cos_i - behind * cos_t) / (before * cos_i + behind * cos_t);
        const double p = (behind * cos_i - before * cos_t) / (behind * cos_i + before * cos_t);
        reflected = (s * s + p * p) / 2;
      }
      const bool reflects = double{u.x[i]} < reflected;
      const Vec3 along = float(before / behind) * (dot(n, wo) * n - wo);
      store(out.wi, i, normalize(reflects ? 2.f * dot(n, wo) * n - wo : along - float(cos_t) * n));
      store(out.weight, i, {1.f, 1.f, 1.f});
      out.pdf[i] = float(reflects ? reflected : 1 - reflected);
      out.flags[i] = sample_valid | sample_delta | (reflects ? 0u : sample_transmitted);
    }
  }
  void interior(const ShadingBatch& batch, InteriorLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.absorption, i, medium_.absorption);
      store(out.scattering, i, medium_.scattering);
      out.anisotropy[i] = medium_.anisotropy;
      out.index[i] = index_ / batch.exterior_index[i];
    }
  }

 private:
  float index_;
  Medium medium_;
};

/// Half of the light comes back, half goes through, both by their cosines.
class FrostShader final : public LambertShader {
 public:
  explicit FrostShader(const Medium& medium = {})
      : LambertShader({1.f, 1.f, 1.f}), medium_(medium) {}
  Capabilities capabilities() const override {
    Capabilities c;
    c.has_interior = true;
    return c;
  }
  void sample(const ShadingBatch& batch, const void* state, Lanes3 u,
              SampleLanes out) const override {
    LambertShader::sample(batch, state, u, out);
    const auto* normals = static_cast<const Vec3*>(state);
    for (std::size_t i = 0; i < batch.count; ++i) {
      out.pdf[i] *= 0.5f;
      if (u.x[i] < 0.5f) continue;
      const Vec3 wi = load(out.wi, i);
      store(out.wi, i, wi - 2.f * dot(wi, normals[i]) * normals[i]);
      out.flags[i] |= sample_transmitted;
    }
  }
  void evaluate(const ShadingBatch& batch, const void* state, Lanes3 wi,
                EvaluateLanes out) const override {
    const auto* normals = static_cast<const Vec3*>(state);
    for (std::size_t i = 0; i < batch.count; ++i) {
      out.pdf[i] = 0.5f * std::numbers::inv_pi_v<float> * std::abs(dot(normals[i], load(wi, i)));
      store(out.value, i, {out.pdf[i], out.pdf[i], out.pdf[i]});
    }
  }
  void interior(const ShadingBatch& batch, InteriorLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.absorption, i, medium_.absorption);
      store(out.scattering, i, medium_.scattering);
      out.anisotropy[i] = medium_.anisotropy;
      out.index[i] = 1.f;
    }
  }

 private:
  Medium medium_;
};

Medium absorbing(Vec3 amount) { return {amount, {}, 0.f}; }

struct World {
  Scene scene;
  RenderInput input;
  RenderSettings settings;

  World() {
    settings.width = settings.height = 16;
    settings.samples = 64;
    settings.max_depth = 256;
    settings.roulette_depth = 1000;  // What is known exactly has no noise.
    settings.sampler = SamplerKind::independent;
    input.camera = look_at({0, 0, 8}, {}, 0.01f);
  }
  void add(Mesh mesh, const Shader& shader, bool is_solid = true) {
    scene.meshes.push_back(std::move(mesh));
    input.shaders.push_back(&shader);
    input.solids.push_back(is_solid);
  }
  Film render(const Environment& sky) {
    input.scene = &scene;
    input.environment = &sky;
    Diagnostics diagnostics;
    RenderStatistics statistics;
    auto film = host::render(input, settings, diagnostics, {}, &statistics);
    EXPECT_TRUE(film) << diagnostics.to_string();
    EXPECT_EQ(statistics.invalid_results, 0u);
    EXPECT_EQ(statistics.media_dropped, 0u);
    return film ? *std::move(film) : Film(settings.width, settings.height);
  }
};

Vec3 mean(const Film& film) {
  Vec3 sum;
  for (const Vec3 rgb : film.pixels()) sum += rgb;
  return (1.f / static_cast<float>(film.pixels().size())) * sum;
}

const Environment& white() {
  static const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  return sky;
}
/// Grey below, red to the left, so that where light comes from is seen.
const Environment& coloured() {
  static const Environment sky(4, 2,
                               {{2, 0, 0},
                                {0, 1, 0},
                                {1, 1, 0},
                                {0, 1, 2},
                                {1, .5f, 0},
                                {.2f, .2f, .2f},
                                {0, 0, .3f},
                                {.4f, 0, 0}});
  return sky;
}

// Two balls that share a third of their length, seen along it: the higher has all of its own, and
// the other the rest. From both ends, for light goes as it came.
TEST(Nested, TheHigherHasWhatBothHave) {
  const GlassShader red(1.f, absorbing({0.f, 0.3f, 0.3f})), blue(1.f, absorbing({0.3f, 0.3f, 0.f}));
  for (const int priority : {1, -1}) {
    for (const float side : {8.f, -8.f}) {
      World world;
      world.add(ball({0, 0, 0.6f}, 1.f, priority), red);
      world.add(ball({0, 0, -0.6f}, 1.f, 0), blue);
      world.input.camera = look_at({0, 0, side}, {}, 0.01f);
      const Vec3 light = mean(world.render(white()));
      const float of_red = priority > 0 ? 2.f : 1.2f, of_blue = priority > 0 ? 1.2f : 2.f;
      EXPECT_NEAR(light.x, std::exp(-0.3f * of_blue), 2e-3f) << side;
      EXPECT_NEAR(light.y, std::exp(-0.3f * 3.2f), 2e-3f) << side;
      EXPECT_NEAR(light.z, std::exp(-0.3f * of_red), 2e-3f) << side;
    }
  }
}

// A glass ball in a ball of drink: whatever of the drink is modelled inside of it, none is there.
TEST(Nested, ASolidDisplacesWhatIsAroundIt) {
  const GlassShader clear(1.f), drink(1.f, absorbing({0.4f, 0.2f, 0.1f}));
  for (const bool is_higher : {true, false}) {
    World world;
    world.add(ball({}, 2.f, 1), drink);
    world.add(ball({}, 1.f, is_higher ? 2 : 0), clear);
    const Vec3 light = mean(world.render(white()));
    const float length = is_higher ? 2.f : 4.f;
    EXPECT_NEAR(light.x, std::exp(-0.4f * length), 2e-3f);
    EXPECT_NEAR(light.y, std::exp(-0.2f * length), 2e-3f);
    EXPECT_NEAR(light.z, std::exp(-0.1f * length), 2e-3f);
  }
}

// At normal incidence ((n1 - n2) / (n1 + n2))^2 comes back from each of two interfaces: of a ball
// of an index, black inside, at the middle of a ball of water. The camera is in the water, or
// before it.
TEST(Nested, ReflectsWhatTheTwoIndicesSay) {
  constexpr double water = 1.333, glass = 1.9;
  const double inner = std::pow((water - glass) / (water + glass), 2.0);
  const double outer = std::pow((water - 1) / (water + 1), 2.0);
  const GlassShader of_water(1.333f);
  const GlassShader of_glass(1.9f, absorbing({1000.f, 1000.f, 1000.f}));
  for (const float distance : {4.f, 20.f}) {
    World world;
    world.add(ball({}, 10.f, 0), of_water);
    world.add(ball({}, 1.f, 0), of_glass);
    world.input.camera = look_at({0, 0, distance}, {}, 0.001f);
    world.settings.samples = 1024;
    const Film film = world.render(white());
    // Light goes to and fro between the two: from the inside of the water 1 - outer is let in.
    const double within = inner * (1 - outer) / (1 - inner * outer);
    const double expected = distance < 10.f ? within : outer + (1 - outer) * within;
    EXPECT_LT(z_score(estimate(film, 0, 0, 0, 16, 16), expected), 4.0) << distance;
  }
}

// White furnace: a glass of a drink with ice, modelled one over the other, loses no light.
TEST(Nested, FurnaceOfManySolids) {
  const GlassShader glass(1.5f), drink(1.33f), ice(1.31f), air(1.f);
  World world;
  world.add(ball({}, 2.f, 3), glass);
  world.add(ball({}, 1.9f, 4), air);               // What makes the glass hollow,
  world.add(ball({0, -0.5f, 0}, 1.6f, 5), drink);  // which is filled, over its wall,
  world.add(ball({0, 0.6f, 0}, 0.7f, 6), ice);     // with ice that floats,
  world.add(ball({0.2f, 0.6f, 0}, 0.1f, 7), air);  // in which there is a bubble.
  world.input.camera = look_at({0, 1, 8}, {}, 0.55f);
  world.settings.max_depth = 1000;
  world.settings.max_transparent = 1000;
  const Film film = world.render(white());
  const Vec3 light = mean(film);
  EXPECT_NEAR(light.x, 1.f, 5e-3f);
  EXPECT_NEAR(light.z, 1.f, 5e-3f);
}

// Within its like a solid is not seen, whoever is the higher.
TEST(Nested, EqualIndicesAreOneSolid) {
  const GlassShader glass(1.5f);
  const auto picture = [&](const std::vector<Mesh>& more) {
    World world;
    world.add(ball({}, 2.f), glass);
    for (const Mesh& each : more) world.add(each, glass);
    world.input.camera = look_at({0, 1, 8}, {}, 0.55f);
    world.settings.samples = 400;
    world.settings.seed = static_cast<std::uint32_t>(more.size());
    return world.render(coloured());
  };
  const Film alone = picture({});
  const Film nested = picture({ball({0.3f, 0, 0.4f}, 1.f, 0), ball({-0.8f, 0, 0}, 1.f, 2),
                               ball({0, -0.9f, 0.2f}, 0.9f, -2)});
  for (int y = 0; y < 16; y += 4) {
    for (int x = 0; x < 16; x += 4) {
      for (int c = 0; c < 3; ++c) {
        const auto block = [&](const Film& film) { return estimate(film, c, x, y, x + 4, y + 4); };
        // 48 comparisons at 1 % together: 3.7 sigma.
        EXPECT_LT(z_score(block(alone), block(nested)), 3.7) << x << ' ' << y << ' ' << c;
      }
    }
  }
}

// Solids with rough borders, an opaque one in them, a lamp and a sky: as much light however it is
// found.
TEST(Nested, StrategiesConvergeToTheSameImage) {
  const FrostShader outer(absorbing({0.1f, 0.2f, 0.4f})),
      inner(Medium{{}, {0.5f, 0.5f, 1.f}, 0.3f});
  const LambertShader paper({0.8f, 0.6f, 0.4f});
  const auto picture = [&](Strategy strategy, int samples) {
    World world;
    world.add(ball({}, 1.f, 1), outer);
    world.add(ball({0.5f, 0, 0.3f}, 0.8f, 2), inner);
    world.add(ball({-0.6f, 0, 0.2f}, 0.3f), paper, false);
    world.add(make_quad("floor", {-4, -1, -4}, {0, 0, 8}, {8, 0, 0}), paper, false);
    Mesh lamp = make_quad_light("lamp", {-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, {6, 5, 4});
    lamp.light_two_sided = true;
    world.add(std::move(lamp), paper, false);
    world.input.camera = look_at({0, 1, 8}, {}, 0.4f);
    world.settings.max_depth = 12;
    world.settings.samples = samples;
    world.settings.strategy = strategy;
    world.settings.seed = static_cast<std::uint32_t>(strategy);
    return world.render(coloured());
  };
  const Film both = picture(Strategy::multiple_importance, 256);
  const Film light = picture(Strategy::light_only, 256);
  const Film bsdf = picture(Strategy::bsdf_only, 1024);
  for (int y = 0; y < 16; y += 8) {
    for (int x = 0; x < 16; x += 8) {
      for (int c = 0; c < 3; ++c) {
        const auto block = [&](const Film& film) { return estimate(film, c, x, y, x + 8, y + 8); };
        // 24 comparisons at 1 % together: 3.53 sigma.
        EXPECT_LT(z_score(block(both), block(light)), 3.53) << x << ' ' << y << ' ' << c;
        EXPECT_LT(z_score(block(both), block(bsdf)), 3.53) << x << ' ' << y << ' ' << c;
      }
    }
  }
}

}  // namespace
}  // namespace nacre::host
