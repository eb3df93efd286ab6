// What scenes have and the host does not render is said, once.
#include <gtest/gtest.h>

#include "examples/render/load_scene.h"
#include "examples/render/mesh.h"
#include "examples/render/surface.h"
#include "tests/examples/render/scene_samples.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

class Dropped : public ::testing::Test {
 protected:
  /// "code path" of each warning; what is drawn stays in `scene_`.
  std::vector<std::string> said(std::string_view name, std::string_view content) {
    folder_.write("card.bin", card_data());
    Diagnostics diagnostics;
    scene_ = load_scene(folder_.write(name, content), {}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.to_string();
    EXPECT_FALSE(scene_.meshes.empty());
    std::vector<std::string> list;
    for (const Diagnostic& each : diagnostics.all()) {
      list.push_back(each.code + ' ' + each.where.path);
    }
    return list;
  }

  TemporaryFolder folder_;
  Scene scene_;
};

using Lines = std::vector<std::string>;

TEST_F(Dropped, OfGltf) {
  struct Case {
    std::string_view from, to;
    Lines said;
  };
  const Case cases[] = {
      {R"("asset")", R"("asset")", {}},
      {R"({"name": "paint"})",
       R"({"name": "paint", "doubleSided": true}, {"alphaMode": "BLEND"})",
       {"scene-materials-not-rendered materials[0]"}},
      {R"("scene": 0,)", "", {}},
      {R"("scene": 0,
  "scenes": [)",
       R"("scenes": [)",
       {}},
      {R"("scene": 0,
  "scenes": [{"nodes": [0, 1]}])",
       R"("scenes": [{"nodes": [0, 1]}, {}])",
       {"several-scenes scenes"}},
      {R"("scene": 0)",
       R"("animations": [{"channels": []}, {}], "scene": 0)",
       {"several-animations animations"}},
      {R"("mesh": 0)",
       R"("mesh": 0, "extensions": {"MSFT_lod": {}})",
       {"extension-not-rendered nodes[0].extensions.MSFT_lod"}},
      {R"("scene": 0)", R"("extensionsRequired": ["KHR_mesh_quantization"], "scene": 0)", {}},
      {R"("nodes": [0, 1]}],
  "nodes": [)",
       R"("nodes": [0, 1, 2]}],
  "nodes": [)",
       {}},
      {R"("type": "perspective")",
       R"("type": "orthographic")",
       {"camera-not-rendered cameras[0].type"}},
      {R"(}]}],
  "buffers")",
       R"(}, {"attributes": {"POSITION": 0}, "mode": 1}]}],
  "buffers")",
       {"not-triangles meshes[0].primitives[1]"}},
  };
  for (const Case& each : cases) {
    std::string text = spoiled_card(each.from, each.to);
    if (each.to.find("0, 1, 2") != each.to.npos) {  // A second camera.
      const std::size_t place = text.find("\"translation\": [0.5, 0.5, 3]}]");
      text.replace(place, 30, "\"translation\": [0.5, 0.5, 3]}, {\"camera\": 0}]");
      EXPECT_EQ(said("a.gltf", text), Lines{});
      ASSERT_EQ(scene_.cameras.size(), 2u);
      EXPECT_EQ(scene_.cameras[0].camera.position.z, 3.f);
      continue;
    }
    EXPECT_EQ(said("a.gltf", text), each.said) << each.to;
  }
}

TEST_F(Dropped, OfObj) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(said("a.obj", triangle + "# s 1\n\nusemtl x\n"), Lines{});
  EXPECT_EQ(said("a.obj", "mtllib a.mtl\nmtllib b.mtl\n" + triangle),
            Lines{"scene-materials-not-rendered "});
  EXPECT_EQ(said("a.obj", triangle + "l 1 2\np 1\n"), Lines{"not-triangles "});
  EXPECT_EQ(said("a.obj", "s off\n" + triangle), Lines{"smoothing-not-rendered "});
  EXPECT_EQ(said("a.obj", triangle + "curv 0 1 1 2\n"), Lines{"not-rendered "});
  EXPECT_EQ(said("a.obj", triangle + "v 0 0 0 1 0 0\n"), Lines{"not-rendered "});
  EXPECT_EQ(said("a.obj", "vt 0.5\nvt 0 0 0\n" + triangle), Lines{});
}

// glTF 2.0, 3.7.2.1: without normals faces are flat and tangents are ignored.
TEST_F(Dropped, WithoutNormalsFacesAreFlat) {
  // A roof: the second triangle is folded up about the diagonal from 0 to 2.
  std::string data = card_data();
  const float up = 0.75f;
  data.replace(3 * 12 + 8, 4, reinterpret_cast<const char*>(&up), 4);
  const std::string text = spoiled_card(R"("NORMAL": 3)", R"("TANGENT": 4, "COLOR_0": 0)");
  EXPECT_EQ(said("a.gltf", text), Lines{});
  folder_.write("card.bin", data);
  Diagnostics diagnostics;
  scene_ = load_scene(folder_.file("a.gltf"), {}, diagnostics);
  ASSERT_EQ(scene_.meshes.size(), 1u) << diagnostics.to_string();
  Mesh& mesh = scene_.meshes[0];
  EXPECT_EQ(mesh.position.size(), 4u);
  EXPECT_TRUE(mesh.normal.empty() && mesh.tangent.empty());
  give_flat_vertices(mesh);
  ASSERT_EQ(mesh.position.size(), 6u);
  ASSERT_EQ(mesh.primvars.at(0).values.size(), 18u);
  // (0,0,0) (1,0,0) (1,1,0) is flat; (0,0,0) (1,1,0) (0,1,h) has the normal
  // (1,1,0) x (0,1,h) = (h, -h, 1), whatever the tangents in the file say.
  const float length = std::sqrt(2.f * up * up + 1.f);
  const Vec3 expected[2] = {{0.f, 0.f, 1.f}, {up / length, -up / length, 1.f / length}};
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 n = mesh.normal[mesh.triangles[i / 3].v[i % 3]];
    EXPECT_NEAR(n.x, expected[i / 3].x, 1e-6f) << i;
    EXPECT_NEAR(n.y, expected[i / 3].y, 1e-6f) << i;
    EXPECT_NEAR(n.z, expected[i / 3].z, 1e-6f) << i;
    EXPECT_NEAR(dot(mesh.tangent[i].direction, mesh.normal[i]), 0.f, 1e-6f);
    for (std::size_t c = 0; c < 3; ++c) {  // COLOR_0 is POSITION.
      const Vec3 p = mesh.position[i];
      EXPECT_EQ(mesh.primvars[0].values[3 * i + c], c == 0 ? p.x : c == 1 ? p.y : p.z);
    }
  }
}

TEST_F(Dropped, NormalsAndTangentsWithoutDirection) {
  std::string data = card_data();
  data.replace(92, 12, std::string(12, '\0'));
  EXPECT_EQ(said("a.gltf", card_json), Lines{});
  folder_.write("card.bin", data);
  Diagnostics diagnostics;
  scene_ = load_scene(folder_.file("a.gltf"), {}, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "bad-normals");
  EXPECT_EQ(scene_.meshes.at(0).normal[0].z, 1.f);
}

}  // namespace
}  // namespace nacre::host
