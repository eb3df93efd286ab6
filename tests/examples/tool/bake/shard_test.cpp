// Bakes shared among runs: what they make together is what one run makes, byte by byte, and
// nothing is put together that does not belong together.
#include "tests/examples/tool/bake/farm_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class BakeShard : public Farm {
 protected:
  void shard(const std::string& folder, int index, int count, const std::string& more = "") {
    const std::string which = std::to_string(index) + "/" + std::to_string(count);
    EXPECT_EQ(bake_document(folder, "--shard " + which + " " + more), 0) << errors_;
  }
  int merge(const std::string& folder, int count, const std::string& more = "") {
    return bake_document(folder, "--merge " + std::to_string(count) + " " + more);
  }
};

TEST_F(BakeShard, TogetherTheyAreOneRun) {
  ASSERT_EQ(bake_document("one"), 0) << errors_;
  const auto right = baked("one");
  EXPECT_EQ(right.size(), 7u);
  for (const int count : {1, 2, 5, 20}) {
    const std::string folder = "of" + std::to_string(count);
    std::map<std::string, std::string> before;
    for (int index = count; index >= 1; --index) {
      shard(folder, index, count);
      EXPECT_FALSE(fs::exists(file(folder + "/b.mtlx")));
      // Nobody writes what another has written.
      for (const auto& [name, digest] : before) EXPECT_EQ(baked(folder)[name], digest);
      before = baked(folder);
    }
    EXPECT_EQ(merge(folder, count), 0) << errors_;
    EXPECT_EQ(baked(folder), right) << count;
    // Again, with what it has made in place.
    EXPECT_EQ(merge(folder, count, "--json"), 0) << errors_;
    EXPECT_EQ(nlohmann::json::parse(printed_)["merged"], 6);
    EXPECT_EQ(baked(folder), right) << count;
  }
}

TEST_F(BakeShard, OutputsWithoutADocumentAreShared) {
  ASSERT_EQ(bake("--out " + file("one")), 0) << errors_;
  for (const std::string index : {"1", "2"}) {
    EXPECT_EQ(bake("--out " + file("two") + " --shard " + index + "/2"), 0) << errors_;
  }
  EXPECT_EQ(bake("--out " + file("two") + " --merge 2"), 0) << errors_;
  EXPECT_EQ(baked("one"), baked("two"));
  EXPECT_EQ(json("two/nacre-bake.json")["files"].size(), 12u);
  EXPECT_FALSE(json("two/nacre-bake.json").contains("shard"));
}

TEST_F(BakeShard, AShardThatRunsAgainBakesWhatIsMissing) {
  shard("out", 1, 2);
  fs::remove(file("out/S.base_color.1001.exr"));
  EXPECT_EQ(bake_document("out", "--shard 1/2 --json"), 0) << errors_;
  EXPECT_EQ(nlohmann::json::parse(printed_)["written"], 1);
  EXPECT_TRUE(fs::exists(file("out/S.base_color.1001.exr")));
}

TEST_F(BakeShard, WhatIsMissingIsNamed) {
  shard("out", 1, 3);
  shard("out", 3, 3);
  EXPECT_EQ(merge("out", 3), 1);
  EXPECT_TRUE(says("shard 2 of 3") && says("nacre-bake.2-of-3.json")) << errors_;
  EXPECT_TRUE(says("S.base_color.1002.exr") && says("[missing-part]")) << errors_;
  EXPECT_FALSE(says("shard 1 of 3") || says("shard 3 of 3")) << errors_;
  EXPECT_FALSE(fs::exists(file("out/b.mtlx")) || fs::exists(file("out/nacre-bake.json")));
  shard("out", 2, 3);
  EXPECT_EQ(merge("out", 3), 0) << errors_;

  fs::remove(file("out/nacre-bake.json"));
  fs::remove(file("out/S.base_color.1011.exr"));
  write("out/S.specular_color.1001.exr", text_of(file("out/S.specular_color.1002.exr")));
  EXPECT_EQ(merge("out", 3), 1);
  EXPECT_TRUE(says("S.base_color.1011.exr (it is gone)")) << errors_;
  EXPECT_TRUE(says("S.specular_color.1001.exr (it is not as it was written)")) << errors_;
  EXPECT_TRUE(says("[missing-image-file]")) << errors_;
}

TEST_F(BakeShard, WhatIsOfAnotherBakeIsRefused) {
  const auto is_refused = [&](const std::string& why, const std::string& code) {
    EXPECT_EQ(merge("out", 2), 1) << why;
    EXPECT_TRUE(says(why) && says(code)) << why << "\n" << errors_;
    EXPECT_FALSE(fs::exists(file("out/b.mtlx")));
  };
  shard("out", 1, 2);
  shard("out", 2, 2, "--accuracy precise");
  is_refused("accuracy was precise, not standard", "[foreign-part]");
  shard("out", 2, 2, "--size 16");
  is_refused("size was 16x16, not 8x8", "[missing-image-file]");
  shard("out", 2, 2);
  // Another shard's record under this one's name.
  fs::copy_file(file("out/nacre-bake.1-of-2.json"), file("out/nacre-bake.2-of-2.json"),
                fs::copy_options::overwrite_existing);
  is_refused("it is of another shard", "[foreign-part]");
  fs::remove(file("out/nacre-bake.2-of-2.json"));
  write_image(0.75);
  shard("out", 2, 2);
  is_refused("t.png has changed", "[missing-image-file]");
  shard("out", 1, 2);
  write_include(0.125);
  shard("out", 2, 2);
  is_refused("lib.mtlx has changed", "[foreign-part]");
  shard("out", 1, 2);
  EXPECT_EQ(merge("out", 2), 0) << errors_;
}

TEST_F(BakeShard, NumbersThatMeanNothingAreSaid) {
  for (const std::string bad : {"0/2", "3/2", "1", "1/", "/2", "1/2/3", "a/b", "-1/2", "1/0"}) {
    EXPECT_EQ(bake_document("out", "--shard " + bad), 2) << bad;
    EXPECT_TRUE(says("--shard cannot be understood")) << errors_;
  }
  EXPECT_EQ(bake_document("out", "--merge 0"), 2);
  EXPECT_EQ(bake_document("out", "--shard 1/2 --merge 2"), 2);
}

// Threads, shards and what is there already make no difference, in any format.
TEST_F(BakeShard, BytesDependOnNothingButTheBake) {
  for (const std::string format : {"exr", "png --bitdepth 16", "tx", "exr --bitdepth 16"}) {
    const std::string same =
        "--size 150x70 --samples 2 --output G/image --format " + format + " --out ";
    const std::string stem = format.substr(0, 2) + std::to_string(format.size());
    ASSERT_EQ(bake(same + file(stem + "one") + " --threads 1"), 0) << errors_;
    ASSERT_EQ(bake(same + file(stem + "many") + " --threads 7 --no-cache --wait-for-code"), 0);
    EXPECT_EQ(baked(stem + "one"), baked(stem + "many")) << format;
    ASSERT_EQ(bake(same + file(stem + "lanes") + " --lanes 4 --threads 2"), 0) << errors_;
    EXPECT_EQ(baked(stem + "one"), baked(stem + "lanes")) << format;
    for (const std::string index : {"3", "1", "2"}) {
      ASSERT_EQ(bake(same + file(stem + "parts") + " --shard " + index + "/3"), 0) << errors_;
    }
    ASSERT_EQ(bake(same + file(stem + "parts") + " --merge 3"), 0) << errors_;
    EXPECT_EQ(baked(stem + "one"), baked(stem + "parts")) << format;
  }
}

}  // namespace
}  // namespace nacre
