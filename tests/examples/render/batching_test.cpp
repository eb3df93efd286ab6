// What one kernel call shades: points of all meshes that a material is on.
#include <gtest/gtest.h>

#include <set>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/mesh.h"
#include "examples/render/render.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

/// Asks for all that differs from mesh to mesh, and notes what it is given.
class NotingShader final : public LambertShader {
 public:
  NotingShader() : LambertShader({0.5f, 0.5f, 0.5f}) {}

  Capabilities capabilities() const override {
    Capabilities c = LambertShader::capabilities();
    c.attributes = attribute_object_space;
    c.matrix_entries = ~0u;
    c.primvars = {{"color0", 3}};
    return c;
  }
  void begin(const ShadingBatch& batch, void* state) const override {
    LambertShader::begin(batch, state);
    ++calls;
    for (std::size_t i = 0; i < batch.count; ++i) {
      meshes.insert(batch.geometry_id[i]);
      coloured += batch.primvars[0].present[i];
      const auto moved = [&](std::size_t k) {
        const MatrixLanes& m = batch.object_to_world;
        return batch.P_object.x[i] * m[k][i] + batch.P_object.y[i] * m[4 + k][i] +
               batch.P_object.z[i] * m[8 + k][i] + m[12 + k][i];
      };
      const Vec3 far = load(batch.P, i) - Vec3{moved(0), moved(1), moved(2)};
      largest_error = std::max(largest_error, length(far));
      // Each card has the colour of its mesh, or none.
      const float expected = batch.geometry_id[i] % 2 == 0 ? 0.f : 1.f;
      wrong_colours += std::abs(batch.primvars[0].component[1][i] - expected) > 1e-6f;
    }
  }

  mutable int calls = 0, coloured = 0, wrong_colours = 0;
  mutable std::set<std::uint32_t> meshes;
  mutable float largest_error = 0.f;
};

TEST(Batching, OneCallAMaterialAndWave) {
  Scene scene;
  Diagnostics diagnostics;
  for (int i = 0; i < 6; ++i) {  // Two by three cards, every second with a colour.
    Mesh mesh = make_quad("card", {}, {1.f, 0.f, 0.f}, {0.f, 1.f, 0.f});
    if (i % 2 == 1) mesh.primvars.push_back({"color0", 3, std::vector<float>(12, 1.f)});
    const auto x = static_cast<float>(i % 2), y = static_cast<float>(i / 2);
    bake_transform(mesh, {{0.f, 0.8f, 0.f}, {-0.8f, 0.f, 0.f}, {0.f, 0.f, 1.f}, {x, y, 0.1f * y}});
    ASSERT_TRUE(finish_mesh(mesh, {}, diagnostics));
    scene.meshes.push_back(std::move(mesh));
  }
  const NotingShader shader;
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = 4;
  s.max_depth = 1;  // What is met after one event is not shaded.
  s.threads = 1;
  s.batch_size = 1024;
  RenderStatistics statistics;
  const auto film = render({&scene, std::vector<const Shader*>(6, &shader), &sky,
                            look_at({0.5f, 1.5f, 5.f}, {0.5f, 1.5f, 0.f}, 0.7f)},
                           s, diagnostics, {}, &statistics);
  ASSERT_TRUE(film) << diagnostics.to_string();
  EXPECT_EQ(statistics.paths, 1024u);
  EXPECT_EQ(shader.calls, 1);  // One wave, one material.
  EXPECT_EQ(shader.meshes.size(), 6u);
  EXPECT_GT(shader.coloured, 100);
  EXPECT_EQ(shader.wrong_colours, 0);
  EXPECT_LT(shader.largest_error, 1e-5f);
}

}  // namespace
}  // namespace nacre::host
