// Wrong scenes, and all that is said of each.
#include <gtest/gtest.h>

#include <string_view>

#include "examples/render/load_scene.h"
#include "tests/examples/render/scene_samples.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

/// What loading a file gives: the diagnostics, one a line, without the folder.
std::string said(const TemporaryFolder& folder, const Scene& scene,
                 const Diagnostics& diagnostics) {
  EXPECT_TRUE(scene.meshes.empty() || !diagnostics.has_errors());
  std::string text = diagnostics.to_string();
  const std::string prefix = folder.path().string() + '/';
  for (std::size_t at = text.find(prefix); at != text.npos; at = text.find(prefix)) {
    text.erase(at, prefix.size());
  }
  // What is left of it is the folder itself.
  const std::size_t folder_at = text.find(folder.path().string());
  if (folder_at != text.npos) text.replace(folder_at, folder.path().string().size(), "FOLDER");
  return text;
}

std::string loaded(std::string_view name, std::string_view content) {
  const TemporaryFolder folder;
  folder.write("card.bin", card_data());
  const std::string path = folder.write(name, content);
  Diagnostics diagnostics;
  const Scene scene = load_scene(path, {}, diagnostics);
  return said(folder, scene, diagnostics);
}

struct Spoiled {
  std::string_view from, to;  ///< In the text of the card.
  std::string_view says;
};

// clang-format off
constexpr Spoiled spoiled[] = {
#include "tests/examples/render/broken_gltf.inc"
};
// clang-format on

TEST(BrokenScene, GltfSaysWhereWhatWasExpectedAndFound) {
  EXPECT_EQ(loaded("a.gltf", card_json), "");
  for (const Spoiled& each : spoiled) {
    EXPECT_EQ(loaded("a.gltf", spoiled_card(each.from, each.to)), std::string(each.says) + "\n")
        << each.from << " -> " << each.to;
  }
  EXPECT_GE(std::size(spoiled), 40u);
}

TEST(BrokenScene, GlbChunksAndLengths) {
  std::string json = spoiled_card(R"(, "uri": "card.bin")", "");
  const std::string good = glb(json, card_data());
  EXPECT_EQ(loaded("a.glb", good), "");
  const auto with = [&](std::size_t at, std::string_view bytes) {
    std::string text = good;
    return text.replace(at, bytes.size(), bytes);
  };
  const std::pair<std::string, std::string_view> cases[] = {
#include "tests/examples/render/broken_glb.inc"
  };
  for (const auto& [bytes, says] : cases) {
    EXPECT_EQ(loaded("a.glb", bytes), std::string(says) + "\n");
  }
}

TEST(BrokenScene, ObjSaysTheLine) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(loaded("a.obj", three + "f 1 2 3\n"), "");
  const std::pair<std::string, std::string_view> cases[] = {
#include "tests/examples/render/broken_obj.inc"
  };
  for (const auto& [text, says] : cases) {
    EXPECT_EQ(loaded("a.obj", text), std::string(says) + "\n") << text;
  }
}

}  // namespace
}  // namespace nacre::host
