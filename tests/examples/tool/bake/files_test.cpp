// What baked files say of themselves, how they are called, and which images they take.
#include <OpenImageIO/imageio.h>

#include "tests/examples/tool/bake/farm_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class BakeFiles : public Farm {
 protected:
  std::string attribute(const std::string& name, const std::string& of) const {
    const auto in = OIIO::ImageInput::open(file(name));
    return in ? std::string(in->spec().get_string_attribute(of, "none")) : "no image";
  }
  std::string digest_of(const std::string& name) const {
    return to_hex(sha256(text_of(file(name))));
  }
};

TEST_F(BakeFiles, SayWhatMadeThemOfWhat) {
  const std::string document = to_hex(sha256(digest_of("a.mtlx") + digest_of("lib.mtlx")));
  for (const std::string format : {"exr", "png", "tx"}) {
    ASSERT_EQ(bake("--output G/image --out " + file("out") + " --format " + format), 0) << errors_;
    const std::string name = "out/G.image.1001." + format;
    EXPECT_TRUE(attribute(name, "Software").starts_with("nacre ")) << format;
    EXPECT_EQ(attribute(name, "nacre:output"), format == "tx" ? "none" : "G/image") << format;
    EXPECT_EQ(attribute(name, "nacre:document"), format == "tx" ? "none" : document) << format;
    EXPECT_EQ(attribute(name, "wrapmodes"), format == "png" ? "none" : "clamp,clamp") << format;
  }
  const auto in = OIIO::ImageInput::open(file("out/G.image.1001.exr"));
  ASSERT_TRUE(in);
  // Rec. ITU-R BT.709-6, 1.3 and 1.4.
  const float points[8] = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
  const auto* found = in->spec().find_attribute("chromaticities");
  ASSERT_NE(found, nullptr);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(found->get_float_indexed(i), points[i]) << i;
  ASSERT_EQ(bake("--output G/zero --out " + file("out")), 0);
  EXPECT_EQ(
      OIIO::ImageInput::open(file("out/G.zero.1001.exr"))->spec().find_attribute("chromaticities"),
      nullptr);
}

TEST_F(BakeFiles, AreCalledAsAskedFor) {
  EXPECT_EQ(bake("--output G/image --out " + file("out") + " --name 'x-{udim}_{output}.{ext}'"), 0);
  EXPECT_TRUE(fs::exists(file("out/x-1011_G.image.exr")));
  EXPECT_EQ(bake_document("two", "--name '{output}_{udim}_v2.{ext}' --format png --clip"), 0);
  EXPECT_TRUE(fs::exists(file("two/S.base_color_1002_v2.png")));
  EXPECT_NE(text_of(file("two/b.mtlx")).find("S.base_color_&lt;UDIM"), std::string::npos);
  EXPECT_EQ(run("bake " + file("a.mtlx") + " --no-cache --size 4 --output G/image --out " +
                file("three") + " --name '{output}_{udim}.{ext}'"),
            0);
  EXPECT_TRUE(fs::exists(file("three/G.image.exr")));
  for (const std::string bad : {"{output}.{ext}", "{udim}.{ext}", "{output}.{udim}",
                                "{x}{output}"
                                "{udim}.{ext}",
                                "../{output}.{udim}.{ext}"}) {
    EXPECT_EQ(bake("--output G/image --out " + file("four") + " --name '" + bad + "'"), 2) << bad;
    EXPECT_TRUE(says("--name makes no names of images")) << errors_;
  }
}

// One texel of 16 is 0.25, in sRGB codes of 8 bits, read as it is.
TEST_F(BakeFiles, MeansStandForMaps) {
  ASSERT_EQ(bake_document("out", "--average --manifest " + file("m.json")), 0) << errors_;
  EXPECT_EQ(names_in(file("out")), std::set<std::string>{"b.mtlx"});
  const auto baked = read(file("out/b.mtlx"));
  ASSERT_NE(baked, nullptr);
  const std::string text = text_of(file("out/b.mtlx"));
  const std::size_t at = text.find("name=\"base_color\"");
  ASSERT_NE(at, std::string::npos);
  const std::size_t value = text.find("value=\"", at) + 7;
  EXPECT_NEAR(std::stof(text.substr(value)), 64.0f / 255.0f / 16.0f, 1e-6f) << text;
  // Maps that were not kept are baked where they are wanted.
  EXPECT_EQ(bake_document("out", "--manifest " + file("m.json")), 0) << errors_;
  EXPECT_TRUE(fs::exists(file("out/S.base_color.1001.exr")));
  EXPECT_EQ(bake("--average"), 2);
}

class BakedTileSets : public BakeFiles {
 protected:
  void SetUp() override {
    Farm::SetUp();
    for (const std::string tile : {"1001", "1002", "1003", "1011", "1012"}) {
      write_image(0.1f * static_cast<float>(tile.back() - '0') + (tile[2] == '1' ? 0.5f : 0.0f));
      fs::rename(file("t.png"), file("s." + tile + ".png"));
    }
  }

  /// The files of the set that an image needs whose coordinates are `uv`.
  std::set<std::string> tiles_of(const std::string& uv, const std::string& tile) {
    write("b.mtlx", R"(<materialx version="1.39"><nodegraph name="G"><texcoord name="t"
        type="vector2"/>)" +
                        uv + R"(<image name="i" type="color3">
        <input name="file" type="filename" value="s.&lt;UDIM&gt;.png"/>
        <input name="texcoord" type="vector2" nodename="uv"/></image>
        <output name="o" type="color3" nodename="i"/></nodegraph></materialx>)");
    const std::string common = "bake " + file("b.mtlx") + " --cache " + file("cache") +
                               " --size 16 --samples 4 --udim " + tile + " --out ";
    EXPECT_EQ(run(common + file("some") + " --manifest " + file("some.json")), 0) << errors_;
    // There all are loaded.
    EXPECT_EQ(run(common + file("all") + " --missing-images default"), 0) << errors_;
    EXPECT_EQ(baked("some"), baked("all"));
    std::set<std::string> names;
    const auto manifest = json("some.json");
    for (const auto& [name, digest] : manifest["files"].back()["images"].items()) {
      names.insert(name);
    }
    fs::remove_all(file("some"));
    fs::remove_all(file("all"));
    fs::remove(file("some.json"));
    EXPECT_EQ(names.erase("s.<UDIM>.png"), 1u);
    return names;
  }

  static std::string sum(const std::string& amount) {
    return "<add name=\"uv\" type=\"vector2\"><input name=\"in1\" type=\"vector2\" nodename=\"t\"/>"
           "<input name=\"in2\" type=\"vector2\" value=\"" +
           amount + "\"/></add>";
  }
};

TEST_F(BakedTileSets, OnlyThoseAreLoadedThatPointsMayRead) {
  using Names = std::set<std::string>;
  EXPECT_EQ(tiles_of(sum("0, 0"), "1001"), Names{"s.1001.png"});
  EXPECT_EQ(tiles_of(sum("0, 0"), "1012"), Names{"s.1012.png"});
  EXPECT_EQ(tiles_of(sum("1, 0"), "1001"), Names{"s.1002.png"});
  EXPECT_EQ(tiles_of(sum("0.5, 0"), "1002"), (Names{"s.1002.png", "s.1003.png"}));
  // From the first cell to the last, row by row: 1003 lies between.
  EXPECT_EQ(tiles_of(sum("0.5, -0.5"), "1011"),
            (Names{"s.1001.png", "s.1002.png", "s.1003.png", "s.1011.png", "s.1012.png"}));
  EXPECT_EQ(tiles_of(sum("20, 0"), "1001"), Names{});
  // Of noise nothing is known.
  EXPECT_EQ(tiles_of("<noise2d name=\"uv\" type=\"vector2\"/>", "1001").size(), 5u);
}

}  // namespace
}  // namespace nacre
