#include <gtest/gtest.h>

#include "examples/render/load_scene.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

TEST(Obj, ReadsPolygonsGroupsAndNegativeIndices) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  const Scene scene = load_scene(folder.write("a.obj", R"(# a comment
o thing
g left
usemtl red
v 0 0 0
v 1 0 0
v 1 1 0
v 0 +1 0
vt 0 0
vt 1 0
vt 1 1
f 1/1 2/2 3/3 4/1
g right
usemtl blue
v 2 0 0
vn 0 0 1
f -1//1 3//1 2//-1
)"),
                                 {}, diagnostics);
  ASSERT_EQ(scene.meshes.size(), 2u) << diagnostics.to_string();
  EXPECT_EQ(scene.meshes[0].object_name, "thing");
  EXPECT_EQ(scene.meshes[0].mesh_name, "left");
  EXPECT_EQ(scene.meshes[0].material_name, "red");
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
  EXPECT_EQ(scene.meshes[0].uv.size(), 4u);
  EXPECT_EQ(scene.meshes[0].normal[0].z, 1.f);  // made
  EXPECT_EQ(scene.meshes[1].material_name, "blue");
  EXPECT_TRUE(scene.meshes[1].uv.empty());
  EXPECT_EQ(scene.meshes[1].position[0].x, 2.f);
  EXPECT_EQ(scene.meshes[1].normal[0].z, 1.f);
}

TEST(Obj, ErrorsNameTheLine) {
  const std::pair<const char*, int> cases[] = {
      {"v 0 0 0\nv 1 0\n", 2},
      {"v 0 0 0\nv 1 x 0\n", 2},
      {"v 0 0 0\n\nf 1 2 3\n", 3},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", 4},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", 4},
      {"v 0 0 0\nv 1 0 0\nf 1 2\n", 3},
      {"v 0 0 0\nf /1 1 1\n", 2},
      {"v 0 0 0\nf 99999999999999999999 1 1\n", 2},
  };
  for (const auto& [text, line] : cases) {
    const TemporaryFolder folder;
    Diagnostics diagnostics;
    EXPECT_TRUE(load_scene(folder.write("a.obj", text), {}, diagnostics).meshes.empty());
    ASSERT_TRUE(diagnostics.has_errors()) << text;
    EXPECT_EQ(diagnostics.all()[0].where.line, line) << text;
  }
}

TEST(Obj, EmptyAndMissingFilesAreErrors) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  EXPECT_TRUE(load_scene(folder.write("a.obj", "# nothing\n"), {}, diagnostics).meshes.empty());
  EXPECT_EQ(diagnostics.error_count(), 1u);
  load_scene(folder.file("none.obj"), {}, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 2u);
}

}  // namespace
}  // namespace nacre::host
