#include <gtest/gtest.h>

#include <array>
#include <random>

#include "examples/render/builtin_scene.h"
#include "examples/render/bvh.h"
#include "examples/render/mesh.h"
#include "examples/render/offset.h"
#include "examples/render/surface.h"

namespace nacre::host {
namespace {

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return normalize({normal(random), normal(random), normal(random)});
}

// Far from the origin, where a fixed epsilon is either too small or leaks.
TEST(Bvh, RaysFromInsideAClosedMeshNeverEscape) {
  const Vec3 centre = {148376.f, 1234.f, -223423.f};
  Scene scene;
  scene.meshes.push_back(make_sphere("shell", centre, 50.f, 64));
  Diagnostics diagnostics;
  const Bvh bvh(scene, diagnostics);
  ASSERT_TRUE(bvh.ok());
  std::mt19937 random(1);
  std::vector<Ray> rays(20000);
  for (Ray& ray : rays) ray = {centre, random_direction(random)};
  std::vector<Hit> hits(rays.size());
  for (const bool coherent : {false, true}) {
    bvh.intersect(rays, hits, coherent);
    int missed = 0;
    for (const Hit& hit : hits) missed += hit.missed();
    EXPECT_EQ(missed, 0);
  }
}

TEST(Bvh, OcclusionAgreesWithTheNearestHit) {
  Scene scene = make_builtin_scene();
  Diagnostics diagnostics;
  const Bvh bvh(scene, diagnostics);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> far(0.1f, 8.f);
  std::vector<Ray> rays(5000);
  for (Ray& ray : rays) ray = {{0.f, 3.f, 2.f}, random_direction(random), far(random)};
  std::vector<Hit> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  bvh.intersect(rays, hits, false);
  bvh.occluded(rays, blocked);
  int hit_count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(blocked[i] != 0, !hits[i].missed());
    hit_count += blocked[i];
  }
  EXPECT_GT(hit_count, 500);
}

TEST(Bvh, RaysPassThroughMeshesThatAreHiddenFromThem) {
  Scene scene;
  scene.meshes.push_back(make_sphere("far", {0.f, 0.f, -9.f}, 1.f, 16));
  scene.meshes.push_back(make_sphere("near", {0.f, 0.f, -4.f}, 1.f, 16));
  scene.meshes[1].visible_to = ray_shadow | ray_secondary;
  Diagnostics diagnostics;
  const Bvh bvh(scene, diagnostics);
  std::vector<Ray> rays(3, Ray{{0.f, 0.f, 0.f}, {0.f, 0.f, -1.f}});
  rays[0].kind = ray_camera, rays[1].kind = ray_secondary, rays[2].kind = ray_any;
  std::vector<Hit> hits(rays.size());
  bvh.intersect(rays, hits, false);
  EXPECT_EQ(hits[0].mesh, 0u);
  EXPECT_EQ(hits[1].mesh, 1u);
  EXPECT_EQ(hits[2].mesh, 1u);
  for (Ray& ray : rays) ray.far = 6.f;
  std::vector<std::uint8_t> blocked(rays.size());
  rays[1].kind = ray_shadow;
  bvh.occluded(rays, blocked);
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{0, 1, 1}));
}

TEST(Offset, LeavingRaysDoNotMeetTheirOwnTriangle) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0.f, 1.f);
  for (const float scale : {1e-3f, 1.f, 1e4f}) {
    for (const float distance : {0.f, 10.f, 1000.f}) {
      int met = 0;
      for (int k = 0; k < 100; ++k) {
        Scene scene;
        Mesh& mesh = scene.meshes.emplace_back();
        const Vec3 base = (scale * distance) * random_direction(random);
        for (int c = 0; c < 3; ++c) {
          mesh.position.push_back(base + scale * random_direction(random));
        }
        mesh.triangles = {{{0, 1, 2}}};
        Diagnostics diagnostics;
        ASSERT_TRUE(finish_mesh(mesh, {}, diagnostics));
        const Bvh bvh(scene, diagnostics);
        const Vec3 ng = surface_normal(scene, {});
        std::vector<Ray> rays;
        for (int i = 0; i < 50; ++i) {
          const float u = std::sqrt(unit(random)), v = unit(random);
          const Vec3 p = surface_position(scene, {.u = 1.f - u, .v = u * v});
          const Vec3 d = random_direction(random);
          rays.push_back({offset_point(p, dot(d, ng) < 0.f ? -ng : ng), d});
        }
        std::vector<Hit> hits(rays.size());
        bvh.intersect(rays, hits, false);
        for (const Hit& hit : hits) met += !hit.missed();
      }
      EXPECT_EQ(met, 0) << "scale " << scale << " distance " << distance;
    }
  }
}

}  // namespace
}  // namespace nacre::host
