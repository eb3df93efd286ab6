// Surfaces that are moved before they are traced.
#include "examples/render/displace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "examples/render/builtin_scene.h"
#include "examples/render/mesh.h"
#include "examples/render/tessellate.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

/// Moves each point by a function of where it is and of its normal, in the world.
class MovingShader final : public LambertShader {
 public:
  using Offset = std::function<Vec3(Vec3 P, Vec3 N)>;
  explicit MovingShader(Offset offset, std::optional<Bounds> known = {})
      : LambertShader({1.f, 1.f, 1.f}), offset_(std::move(offset)), known_(known) {}
  Capabilities capabilities() const override {
    Capabilities c;
    c.displaces = true;
    return c;
  }
  void displacement(const ShadingBatch& batch, Lanes3 offset) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(offset, i, offset_(load(batch.P, i), load(batch.N, i)));
    }
  }
  Bounds displacement_box(const ShadingBatch& corners) const override {
    return known_ ? *known_ : LambertShader::displacement_box(corners);
  }

 private:
  Offset offset_;
  std::optional<Bounds> known_;
};

Mesh finished(std::vector<Vec3> corners, std::vector<Triangle> triangles) {
  Mesh mesh;
  mesh.position = std::move(corners);
  mesh.triangles = std::move(triangles);
  Diagnostics diagnostics;
  EXPECT_TRUE(finish_mesh(mesh, {}, diagnostics, MissingNormals::flat)) << diagnostics.to_string();
  give_flat_vertices(mesh);
  return mesh;
}

/// [-1, 1]² at z = 0, seen from above.
Mesh square() {
  return finished({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{{0, 1, 2}}, {{0, 2, 3}}});
}

/// [-1, 1]³ with flat faces: three vertices at each corner that have nothing in common.
Mesh cube() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({i & 1 ? 1.f : -1.f, i & 2 ? 1.f : -1.f, i & 4 ? 1.f : -1.f});
  }
  std::vector<Triangle> triangles;
  const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    triangles.push_back({{f[0], f[1], f[2]}});
    triangles.push_back({{f[0], f[2], f[3]}});
  }
  return finished(corners, triangles);
}

float longest_edge(const Mesh& mesh) {
  float longest = 0.f;
  for (const Triangle& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      longest = std::max(longest, length(mesh.position[t.v[c]] - mesh.position[t.v[(c + 1) % 3]]));
    }
  }
  return longest;
}

float area(const Mesh& mesh) {
  float sum = 0.f;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.position[t.v[0]];
    sum += 0.5f * length(cross(mesh.position[t.v[1]] - a, mesh.position[t.v[2]] - a));
  }
  return sum;
}

const auto longer_than = [](float limit) {
  return [limit](Vec3 a, Vec3 b) { return length(b - a) > limit; };
};

TEST(Tessellate, LeavesTheSurfaceWhereItIs) {
  Mesh mesh = cube();
  EXPECT_TRUE(tessellate(mesh, longer_than(0.3f), 1'000'000));
  EXPECT_LE(longest_edge(mesh), 0.3f);
  EXPECT_NEAR(area(mesh), 24.f, 1e-3f);
  EXPECT_TRUE(is_closed(mesh));
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    EXPECT_NEAR(length(mesh.normal[i]), 1.f, 1e-6f);
    EXPECT_NEAR(dot(mesh.normal[i], mesh.position[i]), 1.f, 1e-6f);  // Of its own face.
  }
}

// Fine on one side and coarse on the other: what meets is split alike.
TEST(Tessellate, DoesNotTear) {
  Mesh mesh = cube();
  const auto finer_to_the_left = [](Vec3 a, Vec3 b) {
    return length(b - a) > (a.x + b.x < 0.f ? 0.07f : 0.5f);
  };
  EXPECT_TRUE(tessellate(mesh, finer_to_the_left, 1'000'000));
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(area(mesh), 24.f, 1e-3f);
}

TEST(Tessellate, KeepsFlatFacesFlat) {
  Mesh mesh = square();
  mesh.normal.clear();
  mesh.tangent.clear();
  EXPECT_TRUE(tessellate(mesh, longer_than(0.3f), 1'000'000));
  EXPECT_TRUE(mesh.normal.empty());
  EXPECT_TRUE(mesh.tangent.empty());
  EXPECT_NEAR(area(mesh), 4.f, 1e-5f);
}

TEST(Tessellate, StopsAtTheMost) {
  Mesh mesh = cube();
  EXPECT_FALSE(tessellate(mesh, longer_than(1e-4f), 5000));
  EXPECT_LE(mesh.triangles.size(), 5000u);
  EXPECT_GT(mesh.triangles.size(), 1000u);
  EXPECT_TRUE(is_closed(mesh));
}

TEST(Tessellate, InterpolatesWhatVerticesCarry) {
  Mesh mesh = square();
  mesh.uv.resize(mesh.position.size());
  Primvar sum{"sum", 2, {}};
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    const Vec3 p = mesh.position[i];
    mesh.uv[i] = {p.x + 2.f * p.y, p.y};
    sum.values.insert(sum.values.end(), {p.x + p.y, p.x - p.y});
  }
  mesh.primvars.push_back(sum);
  mesh.position_object = mesh.position;
  EXPECT_TRUE(tessellate(mesh, longer_than(0.2f), 1'000'000));
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    const Vec3 p = mesh.position[i];
    EXPECT_NEAR(mesh.uv[i].x, p.x + 2.f * p.y, 1e-5f);
    EXPECT_NEAR(mesh.primvars[0].values[2 * i + 1], p.x - p.y, 1e-5f);
    EXPECT_NEAR(mesh.position_object[i].x, p.x, 1e-6f);
  }
}

struct Displaced {
  Scene scene;
  DisplaceResult result;
  const Mesh& mesh() const { return scene.meshes[0]; }
};

/// Edges of about 0.03, as a picture of 100 pixels shows it from five units away.
Displaced displaced(Mesh mesh, const MovingShader& shader, DisplaceSettings settings = {}) {
  Displaced all;
  all.scene.meshes.push_back(std::move(mesh));
  const Camera camera = look_at({0, 0, 5}, {}, 0.6f);
  all.result =
      displace(all.scene, {&shader}, PixelCamera(camera, 100, 100, 1.f), camera.position, settings);
  return all;
}

/// Where the surface was, over what a pixel sees from (0, 0, 5) where it is now.
struct Edges {
  float longest = 0.f, longest_far = 0.f;  ///< Of all; of those with x > 0.8.
};
Edges edges_in_pixels(const Mesh& mesh) {
  const Camera camera = look_at({0, 0, 5}, {}, 0.6f);
  const float angle = PixelCamera(camera, 100, 100, 1.f).sample_angle();
  Edges edges;
  for (const Triangle& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = t.v[c], b = t.v[(c + 1) % 3];
      const Vec3 now = 0.5f * (mesh.position[a] + mesh.position[b]);
      const float half = 0.3f * 0.9f * (5.f - now.z);  // Of the picture there.
      if (std::abs(now.x) > half || std::abs(now.y) > half) continue;
      const float was = length(mesh.position_object[a] - mesh.position_object[b]);
      const float pixels = was / (angle * length(now - Vec3{0, 0, 5}));
      edges.longest = std::max(edges.longest, pixels);
      if (now.x > 0.8f) edges.longest_far = std::max(edges.longest_far, pixels);
    }
  }
  return edges;
}

// What displacement brings near is as fine as what is there; the box of offsets need not be known.
TEST(Displace, WhatComesNearIsFine) {
  const auto lift = [](Vec3, Vec3) { return Vec3{0, 0, 3.f}; };
  const Bounds exact{{0, 0, 3.f}, {0, 0, 3.f}};
  for (const std::optional<Bounds>& known : {std::optional<Bounds>(), std::optional(exact)}) {
    const Displaced near = displaced(square(), MovingShader(lift, known));
    EXPECT_TRUE(near.result.coarse.empty());
    EXPECT_LE(edges_in_pixels(near.mesh()).longest, 1.001f);
    EXPECT_GT(edges_in_pixels(near.mesh()).longest, 0.5f);
  }
  // One end comes near, and the other stays.
  const auto ramp = [](Vec3 p, Vec3) { return Vec3{0, 0, 1.5f * (1.f - p.x)}; };
  const Displaced slope = displaced(square(), MovingShader(ramp));
  EXPECT_LE(edges_in_pixels(slope.mesh()).longest, 1.2f);
  EXPECT_GT(edges_in_pixels(slope.mesh()).longest_far, 0.4f);
  EXPECT_LT(slope.mesh().triangles.size(),
            2 * displaced(square(), MovingShader(lift)).mesh().triangles.size() / 3);
}

// What comes near beside the picture stays as fine as it was; a corner of it is seen.
TEST(Displace, WhatComesNearBesideThePictureIsLeft) {
  const auto at = [](float x) { return MovingShader([x](Vec3, Vec3) { return Vec3{x, 0, 3.f}; }); };
  const std::size_t still =
      displaced(square(), MovingShader([](Vec3, Vec3) { return Vec3{}; })).mesh().triangles.size();
  EXPECT_EQ(displaced(square(), at(4.f)).mesh().triangles.size(), still);
  EXPECT_GT(displaced(square(), at(1.f)).mesh().triangles.size(), still * 3 / 2);
  EXPECT_LT(displaced(square(), at(1.f)).mesh().triangles.size(),
            displaced(square(), at(0.f)).mesh().triangles.size());
}

// Next to the eye there is an end.
TEST(Displace, WhatComesToTheEyeIsNoFinerThanAnEighth) {
  const auto lift = [](Vec3, Vec3) { return Vec3{0, 0, 4.9999f}; };
  DisplaceSettings settings;
  settings.edge = 4.f;
  const Displaced near = displaced(square(), MovingShader(lift), settings);
  EXPECT_TRUE(near.result.coarse.empty());
  const Displaced still =
      displaced(square(), MovingShader([](Vec3, Vec3) { return Vec3{}; }), settings);
  EXPECT_LE(near.mesh().triangles.size(), 80 * still.mesh().triangles.size());
}

// What is known to be moved away need not be as fine; what is only so at a few points is.
TEST(Displace, WhatIsKnownToGoAwayIsCoarse) {
  const auto drop = [](Vec3, Vec3) { return Vec3{0, 0, -20.f}; };
  const Bounds exact{{0, 0, -20.f}, {0, 0, -20.f}}, loose{{-30, -30, -30}, {30, 30, 30}};
  const std::size_t still =
      displaced(square(), MovingShader([](Vec3, Vec3) { return Vec3{}; })).mesh().triangles.size();
  EXPECT_EQ(displaced(square(), MovingShader(drop)).mesh().triangles.size(), still);
  EXPECT_EQ(displaced(square(), MovingShader(drop, loose)).mesh().triangles.size(), still);
  const Displaced far = displaced(square(), MovingShader(drop, exact));
  EXPECT_LT(far.mesh().triangles.size(), still / 16);
  EXPECT_LE(edges_in_pixels(far.mesh()).longest, 1.001f);
}

TEST(Displace, MovesAlongTheNormal) {
  const MovingShader grow([](Vec3, Vec3 n) { return 0.5f * n; });
  const Displaced ball = displaced(make_sphere("ball", {}, 1.f, 48), grow);
  EXPECT_EQ(ball.result.invalid, 0u);
  EXPECT_TRUE(ball.result.coarse.empty());
  EXPECT_TRUE(is_closed(ball.mesh()));
  EXPECT_LT(longest_edge(ball.mesh()), 0.06f);
  for (std::size_t i = 0; i < ball.mesh().position.size(); ++i) {
    const Vec3 p = ball.mesh().position[i];
    EXPECT_NEAR(length(p), 1.5f, 1e-2f);
    if (std::abs(p.y) < 1.4f) {  // At the poles triangles are slivers.
      EXPECT_NEAR(length(p), 1.5f, 2e-3f);
      EXPECT_GT(dot(ball.mesh().normal[i], normalize(p)), 0.999f);
    }
    EXPECT_NEAR(length(ball.mesh().position_object[i]), 1.f, 5e-3f);  // Where it was.
  }
}

// Faces that part at an edge do not: what is at one place goes to one place.
TEST(Displace, DoesNotTear) {
  const MovingShader grow([](Vec3, Vec3 n) { return 0.2f * n; });
  const Displaced box = displaced(cube(), grow);
  EXPECT_TRUE(is_closed(box.mesh()));
  float furthest = 0.f;
  for (const Vec3 p : box.mesh().position) {
    const float out = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    furthest = std::max(furthest, out);
    EXPECT_GE(out, 1.f);
  }
  EXPECT_FLOAT_EQ(furthest, 1.2f);
}

// z = sin(4 x) / 8 has the normal (-cos(4 x) / 2, 0, 1).
TEST(Displace, NormalsAreOfWhatIsThere) {
  const MovingShader waves([](Vec3 p, Vec3) { return Vec3{0, 0, 0.125f * std::sin(4.f * p.x)}; });
  const Displaced sea = displaced(square(), waves);
  for (std::size_t i = 0; i < sea.mesh().position.size(); ++i) {
    const Vec3 p = sea.mesh().position[i];
    if (std::abs(p.x) > 0.95f) continue;
    const Vec3 exact = normalize({-0.5f * std::cos(4.f * p.x), 0.f, 1.f});
    EXPECT_NEAR(p.z, 0.125f * std::sin(4.f * p.x), 1e-6f);
    EXPECT_GT(dot(sea.mesh().normal[i], exact), 0.998f) << p.x;
    EXPECT_NEAR(dot(sea.mesh().normal[i], sea.mesh().tangent[i].direction), 0.f, 1e-5f);
  }
}

// What is drawn by instances is moved as far as the next one to the camera says.
TEST(Displace, OffsetsAreOfTheWorld) {
  Mesh mesh = square();
  mesh.instances = {Motion(Affine{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0, 0, 1}}),
                    Motion(Affine{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -50}})};
  const MovingShader lift([](Vec3 p, Vec3) { return Vec3{0, 0, p.z == 1.f ? 0.5f : 100.f}; });
  const Displaced lifted = displaced(std::move(mesh), lift);
  for (const Vec3 p : lifted.mesh().position) EXPECT_NEAR(p.z, 0.25f, 1e-6f);
}

TEST(Displace, WhatGoesNowhereStays) {
  const MovingShader wild([](Vec3 p, Vec3) {
    return Vec3{0, 0, p.x < 0.f ? std::nanf("") : p.y < 0.f ? 1e30f : 1.f};
  });
  const Displaced sheet = displaced(square(), wild);
  EXPECT_GT(sheet.result.invalid, 1000u);
  for (const Vec3 p : sheet.mesh().position) {
    EXPECT_TRUE(is_finite(p));
    if (p.x > 0.f && p.y > 0.f) {
      EXPECT_EQ(p.z, 1.f);
    }
  }
}

TEST(Displace, SaysWhatIsCoarse) {
  const MovingShader grow([](Vec3, Vec3 n) { return 0.2f * n; });
  DisplaceSettings settings;
  settings.most_triangles = 1000;
  const Displaced box = displaced(cube(), grow, settings);
  EXPECT_EQ(box.result.coarse, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(is_closed(box.mesh()));
  EXPECT_LE(box.mesh().triangles.size(), 1012u);

  // All meshes together.
  Scene two;
  two.meshes = {cube(), cube()};
  const Camera camera = look_at({0, 0, 5}, {}, 0.6f);
  const DisplaceResult result =
      displace(two, {&grow, &grow}, PixelCamera(camera, 100, 100, 1.f), camera.position, settings);
  EXPECT_EQ(result.coarse.size(), 2u);
  EXPECT_LE(two.meshes[0].triangles.size() + two.meshes[1].triangles.size(), 1024u);
}

}  // namespace
}  // namespace nacre::host
