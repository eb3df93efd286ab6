// Where texture coordinates lay meshes out, and what is said of those that do not.
#include <gtest/gtest.h>

#include <limits>

#include "examples/bake_mesh/mesh_surface.h"
#include "tests/examples/bake_mesh/mesh_samples.h"

namespace nacre::host {
namespace {

std::unique_ptr<MeshSurface> surface_of(Mesh mesh, Diagnostics& diagnostics, int uv_set = 0) {
  return MeshSurface::make(scene_of(std::move(mesh)), {.file = "a.obj", .uv_set = uv_set},
                           diagnostics);
}

bool says(const Diagnostics& diagnostics, const std::string& code) {
  return diagnostics.to_string().find('[' + code + ']') != std::string::npos;
}

TEST(Layout, TilesAreThoseThatTrianglesHavePartOf) {
  Mesh quad = make_quad("quad", {}, {1, 0, 0}, {0, 1, 0});
  Diagnostics diagnostics;
  const std::vector<UvTile> first{{0, 0}};
  EXPECT_EQ(surface_of(quad, diagnostics)->tiles(diagnostics), first);
  // To the corner of the tile (2, 1), but no farther.
  for (Vec2& uv : quad.uv) uv = {1.5f + 0.5f * uv.x, 0.5f + 0.5f * uv.y};
  const std::vector<UvTile> second{{1, 0}};
  EXPECT_EQ(surface_of(quad, diagnostics)->tiles(diagnostics), second);
  for (Vec2& uv : quad.uv) uv = uv + Vec2{0.25f, 0.25f};
  const std::vector<UvTile> four{{1, 0}, {2, 0}, {1, 1}, {2, 1}};
  EXPECT_EQ(surface_of(quad, diagnostics)->tiles(diagnostics), four);
  // A strip across tiles is not in the corners of its box.
  quad.uv = {{0.0f, 0.0f}, {0.2f, 0.0f}, {2.0f, 1.9f}, {1.9f, 1.9f}};
  const std::vector<UvTile> strip{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const auto tiles = surface_of(quad, diagnostics)->tiles(diagnostics);
  EXPECT_EQ(tiles.size(), 3u);
  for (const UvTile& tile : tiles) EXPECT_NE(std::ranges::find(strip, tile), strip.end());
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.to_string();
}

TEST(Layout, SaysWhatCannotBeLaidOut) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const Mesh quad = make_quad("quad", {}, {1, 0, 0}, {0, 1, 0});
  Diagnostics none;
  Mesh bare = quad;
  bare.uv.clear();
  EXPECT_EQ(surface_of(bare, none), nullptr);
  EXPECT_TRUE(says(none, "no-uv")) << none.to_string();
  Diagnostics second;
  EXPECT_EQ(surface_of(quad, second, 1), nullptr);
  EXPECT_TRUE(says(second, "no-uv")) << second.to_string();
  Diagnostics line;
  Mesh flat = quad;
  for (Vec2& uv : flat.uv) uv.y = uv.x;
  EXPECT_EQ(surface_of(flat, line), nullptr);
  EXPECT_TRUE(says(line, "no-uv")) << line.to_string();
  Diagnostics half;
  Mesh broken = quad;
  broken.uv[1].x = nan;  // Of one of the triangles.
  EXPECT_NE(surface_of(broken, half), nullptr);
  EXPECT_TRUE(says(half, "flat-uv")) << half.to_string();
  Diagnostics far;
  Mesh huge = quad;
  for (Vec2& uv : huge.uv) uv = {3e37f * (uv.x + 1.0f), uv.y};
  const auto away = surface_of(huge, far);
  ASSERT_NE(away, nullptr);
  EXPECT_TRUE(away->tiles(far).empty());
  EXPECT_TRUE(says(far, "no-udim")) << far.to_string();
  EXPECT_FALSE(away->lay_out({64, 64, {}}, far));
  EXPECT_TRUE(says(far, "nothing-to-bake")) << far.to_string();
}

TEST(Layout, RefusesWhatIsNoSetOfTiles) {
  Mesh quad = make_quad("quad", {}, {1, 0, 0}, {0, 1, 0});
  for (Vec2& uv : quad.uv) uv = {10.0f * uv.x, 200.0f * uv.y};
  Diagnostics diagnostics;
  EXPECT_TRUE(surface_of(quad, diagnostics)->tiles(diagnostics).empty());
  EXPECT_TRUE(says(diagnostics, "too-many-tiles")) << diagnostics.to_string();
}

TEST(Layout, RefusesWhatIsNoMap) {
  Mesh mesh = make_quad("quad", {}, {1, 0, 0}, {0, 1, 0});
  const std::vector<Triangle> once = mesh.triangles;
  for (int i = 0; i < 300; ++i) {
    mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  }
  Diagnostics diagnostics;
  const auto surface = surface_of(mesh, diagnostics);
  ASSERT_NE(surface, nullptr);
  EXPECT_FALSE(surface->lay_out({16, 16, {}}, diagnostics));
  EXPECT_TRUE(says(diagnostics, "too-many-overlaps")) << diagnostics.to_string();
}

}  // namespace
}  // namespace nacre::host
