// Scenes that ask for more than they weigh.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>

#include "examples/render/load_scene.h"
#include "examples/render/scene_budget.h"
#include "tests/examples/render/scene_samples.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

class SceneLimitsTest : public ::testing::Test {
 protected:
  /// The first thing said of a file; "" where it is read.
  std::string loaded(std::string_view name, std::string_view content,
                     const SceneLimits& limits = {}) {
    folder_.write("card.bin", card_data());
    return loaded(folder_.write(name, content), limits);
  }
  std::string loaded(const std::string& path, const SceneLimits& limits = {}) {
    const auto start = std::chrono::steady_clock::now();
    Diagnostics diagnostics;
    const Scene scene = load_scene(path, limits, diagnostics);
    EXPECT_EQ(scene.meshes.empty(), diagnostics.has_errors());
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    return diagnostics.all().empty() ? "" : diagnostics.all().front().code;
  }

  /// `count` nodes that all show the card, below one another or side by side.
  static std::string nodes(int count, bool nested, const std::string& name) {
    std::string list, roots;
    for (int i = 0; i < count; ++i) {
      const std::string child =
          nested && i + 1 < count ? R"(,"children":[)" + std::to_string(i + 1) + "]" : "";
      list += (i == 0 ? "" : ",") + (R"({"mesh":0,"name":")" + name + '"' + child + '}');
      if (i == 0 || !nested) roots += (i == 0 ? "" : ",") + std::to_string(i);
    }
    std::string text = spoiled_card(R"([{"nodes": [0, 1]}])", R"([{"nodes": [)" + roots + "]}]");
    const std::size_t start = text.find(R"([{"name": "sign")"), end = text.find("  \"materials\"");
    return text.replace(start, end - start, '[' + list + "],\n");
  }

  TemporaryFolder folder_;
};

TEST_F(SceneLimitsTest, OnlyRegularFilesAreOpened) {
  for (const char* name : {"pipe.gltf", "pipe.glb", "pipe.obj"}) {
    ASSERT_EQ(::mkfifo(folder_.file(name).c_str(), 0600), 0);
    EXPECT_EQ(loaded(folder_.file(name)), "cannot-read") << name;
  }
  ASSERT_EQ(::mkfifo(folder_.file("card.pipe").c_str(), 0600), 0);
  EXPECT_EQ(loaded("a.gltf", spoiled_card("card.bin", "card.pipe")), "cannot-read");
  ASSERT_EQ(::mkdir(folder_.file("folder.obj").c_str(), 0700), 0);
  EXPECT_EQ(loaded(folder_.file("folder.obj")), "cannot-read");
}

TEST_F(SceneLimitsTest, FilesCountTogether) {
  const SceneLimits exact{.file_bytes = card_json.size() + card_data().size()};
  EXPECT_EQ(loaded("a.gltf", card_json, exact), "");
  EXPECT_EQ(loaded("a.gltf", card_json, {.file_bytes = exact.file_bytes - 1}), "file-too-large");
  EXPECT_EQ(loaded("a.gltf", card_json, {.file_bytes = 10}), "file-too-large");
  EXPECT_EQ(loaded("a.obj", "v 0 0 0\n", {.file_bytes = 7}), "file-too-large");
}

TEST_F(SceneLimitsTest, EveryInstanceCounts) {
  EXPECT_EQ(loaded("a.gltf", nodes(30, false, "n")), "");
  EXPECT_EQ(loaded("a.gltf", nodes(30, false, "n"), {.meshes = 30}), "");
  EXPECT_EQ(loaded("a.gltf", nodes(30, false, "n"), {.meshes = 29}), "scene-too-large");
  EXPECT_EQ(loaded("a.gltf", nodes(30, false, "n"), {.bytes = 60'000}), "scene-too-large");
}

TEST_F(SceneLimitsTest, AMillionInstancesThatStandAreWithinTheDefault) {
  Diagnostics diagnostics;
  SceneBudget budget({.meshes = 1'000'000}, diagnostics);
  ASSERT_TRUE(budget.take({}, 8, 12, 0));
  for (int i = 0; i < 1'000'000; ++i) ASSERT_TRUE(budget.take_instance({}, i == 0, 1, 1));
  EXPECT_FALSE(budget.take_instance({}, false, 1, 1));
}

// They share them as others do.
TEST_F(SceneLimitsTest, FlatFacesTakeNoMoreVertices) {
  std::size_t bytes = 1000;
  while (loaded("a.gltf", card_json, {.bytes = bytes}) == "scene-too-large") bytes += 50;
  EXPECT_EQ(loaded("a.gltf", spoiled_card(R"(, "NORMAL": 3)", ""), {.bytes = bytes}), "");
}

TEST_F(SceneLimitsTest, PathsDoNotMultiply) {
  // Each path repeats all names above it: 250 nodes of 1,000 bytes make 31 MB of paths,
  // and 250,000 that share them a thousand times as much.
  const std::string name(1000, 'n');
  EXPECT_EQ(loaded("a.gltf", nodes(250, true, name)), "");
  EXPECT_EQ(loaded("a.gltf", nodes(250, true, name), {.bytes = 20'000'000}), "scene-too-large");
  EXPECT_EQ(loaded("a.gltf", nodes(2, true, std::string(1025, 'n'))), "bad-gltf");
  EXPECT_EQ(loaded("a.gltf", nodes(256, true, "n")), "");
  EXPECT_EQ(loaded("a.gltf", nodes(257, true, "n")), "bad-gltf");
  EXPECT_EQ(loaded("a.gltf", nodes(60'000, true, "n")), "bad-gltf");
}

TEST_F(SceneLimitsTest, NodesOfOneLongNameOverManyMeshes) {
  // One node of a megabyte over thousands of meshes took 6 GB.
  std::string text = nodes(4000, false, "m");
  const std::size_t roots = text.find(R"({"nodes": [)") + 11;
  const std::string list = text.substr(roots, text.find(']', roots) - roots);
  text.replace(roots, list.size(), "4000");
  const std::size_t end = text.find("],\n  \"materials\"");
  text.insert(end, R"(,{"name":")" + std::string(1 << 20, 'n') + R"(","children":[)" + list + "]}");
  EXPECT_EQ(loaded("a.gltf", text), "bad-gltf");
}

TEST_F(SceneLimitsTest, JsonIsCountedWhileItIsRead) {
  EXPECT_EQ(loaded("a.gltf", card_json, {.values = 50}), "scene-too-large");
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_EQ(loaded("a.gltf", R"({"extras":)" + deep + "}"), "scene-too-large");
  std::string many = "[0";
  for (std::size_t i = 0; i < SceneLimits{}.values; ++i) many += ",0";
  EXPECT_EQ(loaded("a.gltf", R"({"extras":)" + many + "]}"), "scene-too-large");
}

TEST_F(SceneLimitsTest, LongListsTakeTimeInProportion) {
  std::string nodes;
  for (int i = 0; i < 500'000; ++i) nodes += "{},";
  std::string text(card_json);
  const std::size_t place = text.find("{\"camera\": 0");
  EXPECT_EQ(loaded("a.gltf", text.insert(place, nodes)), "");
}

TEST_F(SceneLimitsTest, FacesOfAnObjCountWhileTheyAreRead) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 1000; ++i) text += "f 1 2 3\n";
  EXPECT_EQ(loaded("a.obj", text), "");
  EXPECT_EQ(loaded("a.obj", text, {.bytes = 100'000}), "scene-too-large");
  std::string groups = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 20; ++i) groups += "g " + std::to_string(i) + "\nf 1 2 3\n";
  EXPECT_EQ(loaded("a.obj", groups, {.meshes = 20}), "");
  EXPECT_EQ(loaded("a.obj", groups, {.meshes = 19}), "scene-too-large");
}

}  // namespace
}  // namespace nacre::host
