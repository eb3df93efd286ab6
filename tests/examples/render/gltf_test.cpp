#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "examples/render/load_scene.h"
#include "examples/render/mesh.h"
#include "tests/examples/render/scene_samples.h"
#include "tests/support/materialx_samples.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

/// Bytes 0-47: four corners; 48-79: uv; 80-91: six 16-bit indices.
std::string quad_data() {
  std::string data;
  append<float>(data, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  append<float>(data, {0, 1, 1, 1, 1, 0, 0, 0});  // glTF: v runs down
  append<std::uint16_t>(data, {0, 1, 2, 0, 2, 3});
  return data;
}

std::string quad_json(const std::string& nodes, const std::string& scene_nodes = "0",
                      const std::string& index_accessor =
                          R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"})") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + scene_nodes +
         R"(]}],"nodes":[)" + nodes + R"(],
    "materials":[{"name":"paint"}],
    "cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],
    "meshes":[{"name":"card","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},
      "indices":2,"material":0}]}],
    "buffers":[{"byteLength":92}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},
      {"buffer":0,"byteOffset":48,"byteLength":32},{"buffer":0,"byteOffset":80,"byteLength":12}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",
        "min":[0,0,0],"max":[1,1,0]},
      {"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)" +
         index_accessor + "]}";
}

constexpr const char* plain_node = R"({"name":"sign","mesh":0})";

TEST(Gltf, ReadsMeshNamesAndFlipsV) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  const Scene scene =
      load_scene(folder.write("a.glb", glb(quad_json(plain_node), quad_data())), {}, diagnostics);
  ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics.to_string();
  Mesh mesh = scene.meshes[0];
  EXPECT_TRUE(mesh.normal.empty());  // The file has none: faces are flat.
  give_flat_vertices(mesh);
  EXPECT_EQ(mesh.object_name, "sign");
  EXPECT_EQ(mesh.mesh_name, "card");
  EXPECT_EQ(mesh.material_name, "paint");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.uv[i].x, mesh.position[i].x);
    EXPECT_EQ(mesh.uv[i].y, mesh.position[i].y);
    EXPECT_EQ(mesh.normal[i].z, 1.f);
    EXPECT_EQ(mesh.tangent[i].direction.x, 1.f);
    EXPECT_EQ(mesh.tangent[i].sign, 1.f);
  }
  EXPECT_TRUE(scene.cameras.empty());
}

TEST(Gltf, TransformsMultiplyDownTheTree) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  // Rotate 90° about z, then scale by 2, then move; the child mirrors x first.
  const std::string nodes = R"({"translation":[10,0,0],"scale":[2,2,2],
      "rotation":[0,0,0.70710678,0.70710678],"children":[1,2]},
    {"name":"mirrored","mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]},
    {"camera":0,"translation":[0,0,3]})";
  const Scene scene =
      load_scene(folder.write("a.glb", glb(quad_json(nodes), quad_data())), {}, diagnostics);
  ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics.to_string();
  Mesh mesh = scene.meshes[0];
  give_flat_vertices(mesh);
  // Local (1, 1, 0) -> mirrored (-1, 1, 0) -> scaled (-2, 2, 0) -> turned (-2, -2, 0) -> moved.
  // The mirror turns the first triangle, whose second corner that is now.
  EXPECT_NEAR(mesh.position[1].x, 8.f, 1e-5f);
  EXPECT_NEAR(mesh.position[1].y, -2.f, 1e-5f);
  EXPECT_EQ(mesh.position_object[1].x, 1.f);
  // A mirror keeps the front where it was: the normal map of a plane in z stays +z.
  EXPECT_NEAR(mesh.normal[0].z, 1.f, 1e-6f);
  // u ran along +x: mirrored and turned, along -y; v along +y: turned, along -x.
  EXPECT_NEAR(mesh.tangent[0].direction.y, -1.f, 1e-5f);
  EXPECT_NEAR(mesh.tangent[0].sign * cross(mesh.normal[0], mesh.tangent[0].direction).x, -1.f,
              1e-5f);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_NEAR(scene.cameras[0].camera.position.z, 6.f, 1e-5f);
  EXPECT_NEAR(scene.cameras[0].camera.forward.z, -1.f, 1e-6f);
  EXPECT_NEAR(scene.cameras[0].camera.up.x, -1.f, 1e-6f);
  EXPECT_FLOAT_EQ(scene.cameras[0].camera.vertical_fov, 0.5f);
}

TEST(Gltf, ReadsTextFileWithEmbeddedBuffer) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  // One triangle, no indices; 36 bytes: (0,0,0) (1,0,0) (0,1,0).
  const std::string json = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
                           R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
      "min":[0,0,0],"max":[1,1,0]}]})";
  const Scene scene = load_scene(folder.write("a.gltf", json), {}, diagnostics);
  ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics.to_string();
  EXPECT_EQ(scene.meshes[0].position[1].x, 1.f);
  EXPECT_EQ(scene.meshes[0].object_name, "mesh0");
  EXPECT_TRUE(scene.meshes[0].uv.empty());
}

struct BadCase {
  const char* what;
  std::string file;
  std::string content;
};

TEST(Gltf, WrongFilesGiveDiagnosticsAndNoScene) {
  const std::string good = glb(quad_json(plain_node), quad_data());
  const auto index = [](const char* accessor) {
    return glb(quad_json(plain_node, "0", accessor), quad_data());
  };
  const BadCase cases[] = {
      {"truncated", "a.glb", good.substr(0, good.size() / 2)},
      {"empty", "a.glb", ""},
      {"not json", "a.gltf", "{ nodes"},
      {"no asset", "a.gltf", "{}"},
      {"nothing to draw", "a.glb", glb(quad_json(R"({"name":"empty"})"), quad_data())},
      {"node out of range", "a.glb", glb(quad_json(plain_node, "7"), quad_data())},
      {"cycle", "a.glb",
       glb(quad_json(R"({"children":[1]},{"children":[0],"mesh":0})"), quad_data())},
      {"singular", "a.glb", glb(quad_json(R"({"mesh":0,"scale":[0,1,1]})"), quad_data())},
      {"mesh out of range", "a.glb", glb(quad_json(R"({"mesh":9})"), quad_data())},
      {"indices beyond the buffer", "a.glb",
       index(R"({"bufferView":2,"componentType":5123,"count":7,"type":"SCALAR"})")},
      {"offset beyond the buffer", "a.glb",
       index(R"({"bufferView":2,"byteOffset":4000000000,"componentType":5123,)"
             R"("count":6,"type":"SCALAR"})")},
      {"huge count", "a.glb",
       index(
           R"({"bufferView":2,"componentType":5123,"count":4611686018427387904,"type":"SCALAR"})")},
      {"float indices", "a.glb",
       index(R"({"bufferView":2,"componentType":5126,"count":3,"type":"SCALAR"})")},
      {"sparse beyond its accessor", "a.glb",
       index(R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR","sparse":{"count":7,
         "indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":2}}})")},
      {"unknown format", "a.stl", "solid"},
  };
  for (const BadCase& bad : cases) {
    const TemporaryFolder folder;
    Diagnostics diagnostics;
    const std::string path = folder.write(bad.file, bad.content);
    const Scene scene = load_scene(path, {}, diagnostics);
    EXPECT_TRUE(diagnostics.has_errors()) << bad.what;
    EXPECT_TRUE(scene.meshes.empty()) << bad.what;
    if (diagnostics.has_errors()) {
      EXPECT_EQ(diagnostics.all()[0].where.file, path) << bad.what;
    }
  }
  Diagnostics diagnostics;
  load_scene("/nonexistent.glb", {}, diagnostics);
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST(Gltf, BuffersAreReadFromTheFolderOfTheFileOnly) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("scene"));
  folder.write("outside.bin", quad_data());
  folder.write("scene/inside.bin", quad_data());
  std::filesystem::create_symlink("../outside.bin", folder.file("scene/link.bin"));
  for (const auto& [uri, allowed] :
       {std::pair{"inside.bin", true}, std::pair{"../outside.bin", false},
        std::pair{"link.bin", false}, std::pair{"../scene/inside.bin", true}}) {
    std::string json = quad_json(plain_node);
    json.replace(json.find(R"("byteLength":92)"), 15,
                 std::string(R"("byteLength":92,"uri":")") + uri + '"');
    Diagnostics diagnostics;
    const Scene scene = load_scene(folder.write("scene/a.gltf", json), {}, diagnostics);
    EXPECT_EQ(scene.meshes.size(), allowed ? 1u : 0u) << uri << '\n' << diagnostics.to_string();
    EXPECT_EQ(diagnostics.has_errors(), !allowed) << uri;
  }
}

TEST(Gltf, ReadsTheShaderBall) {
  const std::filesystem::path file = materialx_sample("Geometry/shaderball.glb");
  if (file.empty()) GTEST_SKIP() << "MaterialX's sample geometry is not here";
  Diagnostics diagnostics;
  const Scene scene = load_scene(file.string(), {}, diagnostics);
  ASSERT_EQ(scene.meshes.size(), 2u) << diagnostics.to_string();
  EXPECT_EQ(scene.meshes[0].object_name, "Preview_Mesh");
  EXPECT_EQ(scene.meshes[1].object_name, "Calibration_Mesh");
  EXPECT_EQ(scene.meshes[0].material_name, "DefaultMaterial");
  // 212424 indices in the file, less a few triangles without area.
  EXPECT_NEAR(static_cast<double>(scene.meshes[0].triangles.size()), 212424 / 3, 700);
  EXPECT_FLOAT_EQ(bounds(scene).high.y, 2.0914919f);
}

}  // namespace
}  // namespace nacre::host
