// What a bake records, and that a run takes from another what is finished and nothing else.
#include "tests/examples/tool/bake/farm_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class BakeManifest : public Farm {
 protected:
  /// Images that a run bakes, of a bake into the folder "out" with a manifest.
  std::set<std::string> baked_again(const std::string& more = "") {
    EXPECT_EQ(bake_document("out", "--manifest " + file("out/m.json") + " --json " + more), 0)
        << errors_;
    std::set<std::string> names;
    const auto all = nlohmann::json::parse(printed_);
    for (const auto& one : all["files"]) {
      if (one["state"] == "written") {
        names.insert(fs::path(one["file"].get<std::string>()).filename());
      }
    }
    EXPECT_EQ(all["written"], names.size());
    EXPECT_EQ(all["skipped"], all["files"].size() - names.size());
    return names;
  }

  const std::set<std::string> of_image_{"S.base_color.1001.exr", "S.base_color.1002.exr",
                                        "S.base_color.1011.exr"};
  const std::set<std::string> of_include_{"S.specular_color.1001.exr", "S.specular_color.1002.exr",
                                          "S.specular_color.1011.exr"};
};

TEST_F(BakeManifest, SaysWhatWasBakedFromWhat) {
  ASSERT_EQ(bake_document("out", "--manifest " + file("out/m.json")), 0) << errors_;
  const auto all = json("out/m.json");
  const auto digest = [&](const std::string& name) { return to_hex(sha256(text_of(file(name)))); };
  EXPECT_EQ(all["nacre_bake"], 1);
  EXPECT_EQ(all["inputs"]["a.mtlx"], digest("a.mtlx"));
  EXPECT_EQ(all["inputs"]["lib.mtlx"], digest("lib.mtlx"));
  EXPECT_EQ(all["options"]["accuracy"], "standard");
  EXPECT_EQ(all["document"]["sha256"], digest("out/b.mtlx"));
  ASSERT_EQ(all["files"].size(), 9u);
  const auto& first = all["files"][0];
  EXPECT_EQ(first["file"], "S.base_color.1001.exr");
  EXPECT_EQ(first["sha256"], digest("out/S.base_color.1001.exr"));
  EXPECT_EQ(first["bytes"], fs::file_size(file("out/S.base_color.1001.exr")));
  EXPECT_EQ(first["images"]["t.png"], digest("t.png"));
  EXPECT_EQ(first["settings"]["size"], "8x8");
  EXPECT_EQ(first["settings"]["udim"], "1001");
  EXPECT_EQ(first["channels"][0]["min"], 0.0);
  // What is the same everywhere has a value in the document and no file.
  EXPECT_EQ(all["files"][3]["file"], "S.metalness.1001.exr");
  EXPECT_EQ(all["files"][3]["kept"], false);
  EXPECT_FALSE(fs::exists(file("out/S.metalness.1001.exr")));
  EXPECT_EQ(all["values"][0]["output"], "S.base");
  EXPECT_EQ(all["values"][0]["value"], nlohmann::json::array({0.25}));
}

TEST_F(BakeManifest, OnlyWhatHasChangedIsBakedAgain) {
  std::set<std::string> all = of_image_;
  all.insert(of_include_.begin(), of_include_.end());
  EXPECT_EQ(baked_again(), all);
  const auto right = baked("out");
  EXPECT_EQ(baked_again(), std::set<std::string>{});
  EXPECT_TRUE(says("9 of 12 images are there already and were not baked")) << errors_;
  EXPECT_EQ(baked("out"), right);

  fs::remove(file("out/S.base_color.1002.exr"));
  write("out/S.specular_color.1011.exr", "x");
  EXPECT_EQ(baked_again(),
            (std::set<std::string>{"S.base_color.1002.exr", "S.specular_color.1011.exr"}));
  EXPECT_TRUE(says("found it is gone [baked-again]")) << errors_;
  EXPECT_TRUE(says("found it is not as it was written [baked-again]")) << errors_;
  EXPECT_EQ(baked("out"), right);

  write_image(0.75);
  EXPECT_EQ(baked_again(), of_image_);
  EXPECT_TRUE(says("t.png has changed [baked-again]")) << errors_;
  write_include(0.25);
  EXPECT_EQ(baked_again(), all);
  EXPECT_TRUE(says("lib.mtlx has changed [baked-again]")) << errors_;
  EXPECT_EQ(baked_again("--accuracy precise"), all);
  EXPECT_TRUE(says("accuracy was standard, not precise [baked-again]")) << errors_;
  EXPECT_EQ(baked_again("--accuracy precise --size 16"), all);
  EXPECT_TRUE(says("size was 8x8, not 16x16 [baked-again]")) << errors_;

  ASSERT_EQ(bake_document("fresh", "--accuracy precise --size 16"), 0) << errors_;
  EXPECT_EQ(baked("fresh"), baked("out"));
}

TEST_F(BakeManifest, OutputsOfSeveralRunsStandInOne) {
  const std::string into = "--out " + file("out") + " --manifest " + file("m.json");
  EXPECT_EQ(bake(into + " --output G/image"), 0) << errors_;
  EXPECT_EQ(bake(into + " --output H/o"), 0) << errors_;
  EXPECT_EQ(json("m.json")["files"].size(), 6u);
  EXPECT_EQ(bake(into + " --output G/image --output H/o"), 0) << errors_;
  EXPECT_EQ(printed_, "");
  EXPECT_TRUE(says("6 of 6 images")) << errors_;
}

// The texels are the default's, so the next run, which may have the image, has to bake them.
TEST_F(BakeManifest, WhatLacksAnImageIsNotFinished) {
  fs::remove(file("t.png"));
  const std::string manifest = " --manifest " + file("m.json");
  EXPECT_EQ(bake_document("out", manifest), 1);
  EXPECT_EQ(bake_document("out", manifest), 1);
  EXPECT_EQ(bake("--out " + file("two") + manifest + " --output G/image"), 1);
  EXPECT_EQ(bake("--out " + file("two") + manifest + " --output G/image"), 1);
  EXPECT_TRUE(says("[missing-image]")) << errors_;
  write_image(0.25);
  EXPECT_EQ(bake_document("out", manifest), 0) << errors_;
  EXPECT_EQ(bake_document("fresh"), 0) << errors_;
  EXPECT_EQ(baked("out"), baked("fresh"));
  // With a warning it may be missing; then that it is there is a change.
  fs::remove(file("t.png"));
  const std::string defaults = " --missing-images default --output G/image --out " + file("three");
  EXPECT_EQ(bake(manifest + defaults), 0) << errors_;
  EXPECT_EQ(bake(manifest + defaults), 0) << errors_;
  EXPECT_EQ(printed_, "");
  write_image(0.25);
  EXPECT_EQ(bake(manifest + defaults), 0) << errors_;
  EXPECT_TRUE(says("t.png has changed [baked-again]")) << errors_;
}

TEST_F(BakeManifest, OtherFilesAreNotReplaced) {
  for (const std::string text : {"", "{}", "[1]", "{\"nacre_bake\": 1, \"nacre\": 7}"}) {
    write("m.json", text);
    EXPECT_EQ(bake_document("out", "--manifest " + file("m.json")), 1) << text;
    EXPECT_TRUE(says("[bad-manifest]")) << errors_;
    EXPECT_EQ(text_of(file("m.json")), text);
  }
  EXPECT_TRUE(names_in(file("out")).empty());
  // One of another format says nothing that can be trusted.
  write("m.json", R"({"nacre_bake": 2, "nacre": "9.9", "files": 7})");
  EXPECT_EQ(bake_document("out", "--manifest " + file("m.json")), 0) << errors_;
}

}  // namespace
}  // namespace nacre
