// Images through the program: which files it reads, what it says and how it ends.
#include <OpenImageIO/imageio.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class Images : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    fs::create_directories(file("scene/textures"));
    paint("scene/textures/Wood.png", 0.25f);
    paint("outside.png", 1.0f);
  }

  /// A picture of one colour.
  void paint(std::string_view name, float value) const {
    const std::string path = file(name);
    auto out = OIIO::ImageOutput::create(path);
    const OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeDesc::UINT8);
    const std::vector<float> samples(4 * 4 * 3, value);
    ASSERT_TRUE(out && out->open(path, spec) &&
                out->write_image(OIIO::TypeDesc::FLOAT, samples.data()) && out->close());
  }

  /// The document "scene/doc.mtlx" with one image of that name, as an output and a material.
  std::string document(const std::string& image) const {
    return write("scene/doc.mtlx", R"(<materialx version="1.39">
  <nodegraph name="NG"><image name="wood" type="color3">
      <input name="file" type="filename" value=")" +
                                       image + R"("/>
      <input name="default" type="color3" value="0.5, 0.5, 0.5"/></image>
    <output name="out" type="color3" nodename="wood"/></nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="out"/></standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>)");
  }

  int bake(const std::string& image, const std::string& options = {}) {
    fs::remove_all(file("out"));
    return run("bake " + document(image) + " --no-cache --size 4 --output NG/out --out " +
               file("out") + " " + options);
  }

  int render(const std::string& options, const std::string& out = "out.png") {
    return run("render " + document("textures/Wood.png") +
               " --material M --no-cache --size 8 --spp 1 --out " + file(out) + " " + options);
  }

  bool says(std::string_view text) const { return errors_.find(text) != std::string::npos; }

  /// The first number of a file's first texel.
  static float texel(const std::string& path) {
    const auto in = OIIO::ImageInput::open(path);
    std::vector<float> texels;
    if (!in) return -1;
    texels.resize(in->spec().image_pixels() * static_cast<std::size_t>(in->spec().nchannels));
    return in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, texels.data()) ? texels[0] : -1;
  }
};

TEST_F(Images, AMissingImageIsAnErrorUnlessTheDefaultWillDo) {
  EXPECT_EQ(bake("textures/none.png"), 1);
  EXPECT_TRUE(says("doc.mtlx:2:")) << errors_;
  EXPECT_TRUE(says("error: ") && says("[missing-image]") && says("node's default")) << errors_;
  EXPECT_FLOAT_EQ(texel(file("out/NG.out.exr")), 0.5f) << "what was made is there";
  EXPECT_EQ(bake("textures/none.png", "--missing-images default"), 0) << errors_;
  EXPECT_TRUE(says("warning: ") && says("[missing-image]")) << errors_;
  EXPECT_EQ(bake("textures/Wood.png"), 0) << errors_;
  EXPECT_EQ(errors_, "");
  write("scene/textures/broken.png", "\x89PNG\r\n\x1a\nnothing more");
  EXPECT_EQ(bake("textures/broken.png"), 1);
  EXPECT_TRUE(says("[broken-image]")) << errors_;
}

TEST_F(Images, RenderingGoesOnAndEndsWithTheError) {
  EXPECT_EQ(run("render " + document("textures/none.png") +
                " --material M --no-cache --size 8 --spp 1 --out " + file("out.png")),
            1);
  EXPECT_TRUE(says("[missing-image]")) << errors_;
  EXPECT_TRUE(fs::exists(file("out.png")));
}

TEST_F(Images, ANameThatDiffersInCaseIsShown) {
  EXPECT_EQ(bake("Textures/wood.PNG"), 1);
  EXPECT_TRUE(says("scene/textures/Wood.png")) << errors_;
}

TEST_F(Images, FilesOutsideAreRefusedInTheSameWordsWhetherTheyAreThereOrNot) {
  fs::create_symlink(file("outside.png"), file("scene/textures/link.png"));
  fs::create_directory_symlink(file(""), file("scene/up"));
  std::vector<std::string> said;
  for (const std::string& name :
       {std::string("../outside.png"), std::string("../missing.png"), file("outside.png"),
        std::string("/etc/passwd"), std::string("/etc/nobody"), std::string("textures/link.png"),
        std::string("up/outside.png"), std::string("textures/../../outside.png"),
        std::string("../scene2/&lt;UDIM&gt;.png")}) {
    EXPECT_EQ(bake(name), 1) << name;
    EXPECT_TRUE(says("[image-outside]")) << errors_;
    EXPECT_FLOAT_EQ(texel(file("out/NG.out.exr")), 0.5f) << name;
    said.push_back(errors_.substr(0, errors_.find("found")));
  }
  for (const std::string& each : said) EXPECT_EQ(each, said[0]);
  EXPECT_EQ(bake("../outside.png", "--allow-outside"), 0) << errors_;
  EXPECT_FLOAT_EQ(texel(file("out/NG.out.exr")), 1.0f);
  EXPECT_EQ(bake("outside.png", "--search-path " + file("")), 0) << errors_;
  EXPECT_EQ(bake(file("outside.png"), "--search-path " + file("")), 0) << errors_;
  EXPECT_EQ(bake("textures/../textures/Wood.png"), 0) << errors_;
}

/// A tile is a file of its own.
TEST_F(Images, ATileThatIsALinkOutsideIsMissing) {
  fs::copy_file(file("scene/textures/Wood.png"), file("scene/t.1001.png"));
  fs::create_symlink(file("outside.png"), file("scene/t.1002.png"));
  EXPECT_EQ(bake("t.&lt;UDIM&gt;.png"), 1);
  EXPECT_TRUE(says("[image-outside]") && says("t.1002.png")) << errors_;
  EXPECT_FLOAT_EQ(texel(file("out/NG.out.exr")), 64.0f / 255);
}

TEST_F(Images, TilesOutsideAreNotLookedFor) {
  paint("t.1002.png", 1.0f);
  EXPECT_EQ(bake("../t.&lt;UDIM&gt;.png", "--udim auto"), 1);
  EXPECT_TRUE(says("[no-udim]")) << errors_;
  EXPECT_EQ(bake("../t.&lt;UDIM&gt;.png", "--udim auto --allow-outside"), 0) << errors_;
  EXPECT_TRUE(fs::exists(file("out/NG.out.1002.exr")));
}

TEST_F(Images, IncludesMayLieOutsideWhereThatIsAllowed) {
  write("part.mtlx", R"(<materialx version="1.39"><constant name="c" type="float"/></materialx>)");
  const std::string path =
      write("scene/includes.mtlx", R"(<materialx version="1.39"><xi:include href="../part.mtlx"/>
      <output name="o" type="float" nodename="c"/></materialx>)");
  EXPECT_EQ(run("check " + path), 1);
  EXPECT_TRUE(says("[include-outside]")) << errors_;
  EXPECT_EQ(run("check " + path + " --allow-outside"), 0) << errors_;
}

TEST_F(Images, AnEnvironmentIsReadLikeEveryImage) {
  ASSERT_EQ(::mkfifo(file("pipe.hdr").c_str(), 0600), 0);
  EXPECT_EQ(render("--environment " + file("pipe.hdr")), 1);
  EXPECT_TRUE(says("[unreadable-image]") && says("pipe.hdr")) << errors_;
  EXPECT_EQ(render("--environment " + file("none.hdr")), 1);
  EXPECT_TRUE(says("[missing-image]")) << errors_;
  write("volume.dds", "DDS |" + std::string(200, '\x40'));
  EXPECT_EQ(render("--environment " + file("volume.dds")), 1);
  EXPECT_TRUE(says("[unsupported-image]")) << errors_;
  write("a.gif", std::string("GIF89a\xff\xff\xff\xff\0\0\0,", 14) + std::string(20, '\xff'));
  EXPECT_EQ(render("--environment " + file("a.gif")), 1);
  EXPECT_TRUE(says("[image-too-large]")) << errors_;
  EXPECT_EQ(render("--environment " + file("outside.png")), 0) << errors_;
  EXPECT_EQ(render("--environment " + file("outside.png") + " --max-image-side 3"), 1);
  EXPECT_TRUE(says("[image-too-large]")) << errors_;
  EXPECT_EQ(render("--environment " + file("outside.png") + " --max-image-file-size 20"), 1);
  EXPECT_TRUE(says("[image-too-large]")) << errors_;
}

// uv runs from 0 to 1; the vector from -1 to 1, the colour from 0 to 2.
constexpr std::string_view ramps = R"(<materialx version="1.39">
  <nodegraph name="NG">
    <texcoord name="uv" type="vector2"/>
    <convert name="uvw" type="vector3"><input name="in" type="vector2" nodename="uv"/></convert>
    <remap name="v" type="vector3"><input name="in" type="vector3" nodename="uvw"/>
      <input name="outlow" type="vector3" value="-1, -1, -1"/></remap>
    <convert name="rgb" type="color3"><input name="in" type="vector3" nodename="uvw"/></convert>
    <multiply name="c" type="color3"><input name="in1" type="color3" nodename="rgb"/>
      <input name="in2" type="color3" value="2, 1, 1"/></multiply>
    <output name="vector" type="vector3" nodename="v"/>
    <output name="color" type="color3" nodename="c"/>
  </nodegraph></materialx>)";

class Written : public Images {
 protected:
  int bake_ramp(const std::string& output, const std::string& options,
                const std::string& out = "out") {
    return run("bake " + write("ramps.mtlx", ramps) + " --no-cache --size 16 --output NG/" +
               output + " --out " + file(out) + " " + options);
  }
};

TEST_F(Written, VectorsArePackedOnlyWhereTheyFit) {
  EXPECT_EQ(bake_ramp("vector", "--format png"), 1);
  EXPECT_TRUE(says("[out-of-range]") && says("NG/vector") && says("--vectors encoded")) << errors_;
  EXPECT_FALSE(fs::exists(file("out/NG.vector.png")));
  ASSERT_EQ(bake_ramp("vector", "--format png --vectors encoded"), 0) << errors_;
  // The top left texel: u = 1/32, so -15/16 in x.
  EXPECT_NEAR(texel(file("out/NG.vector.png")), (1 - 15.0f / 16) / 2, 0.5f / 255);
  ASSERT_EQ(bake_ramp("vector", "--format exr"), 0) << errors_;
  EXPECT_FLOAT_EQ(texel(file("out/NG.vector.exr")), -15.0f / 16);
}

TEST_F(Written, ColoursAboveOneAreSaid) {
  EXPECT_EQ(bake_ramp("color", "--format png"), 0);
  EXPECT_TRUE(says("warning: ") && says("[out-of-range]") && says("NG/color")) << errors_;
  EXPECT_TRUE(says("128 of 768")) << errors_;  // Half of the reds.
  EXPECT_TRUE(fs::exists(file("out/NG.color.png")));
  EXPECT_EQ(bake_ramp("color", "--format exr"), 0);
  EXPECT_EQ(errors_, "");
}

TEST_F(Written, TexturesHaveTheBitsThatWereAskedForAndRepeat) {
  for (const auto& [bits, type] :
       {std::pair{"16", OIIO::TypeDesc::HALF}, {"32", OIIO::TypeDesc::FLOAT}}) {
    ASSERT_EQ(bake_ramp("color", "--format tx --bitdepth " + std::string(bits)), 0) << errors_;
    const auto in = OIIO::ImageInput::open(file("out/NG.color.tx"));
    ASSERT_TRUE(in);
    EXPECT_EQ(in->spec().format, type);
    EXPECT_EQ(in->spec().get_string_attribute("wrapmodes"), "periodic,periodic");
  }
  ASSERT_EQ(bake_ramp("color", "--format tx --udim 1001"), 0) << errors_;
  const auto in = OIIO::ImageInput::open(file("out/NG.color.1001.tx"));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().get_string_attribute("wrapmodes"), "clamp,clamp");
}

TEST_F(Written, EqualBakesAreEqualFiles) {
  for (const char* out : {"first", "second"}) {
    for (const char* format : {"png", "exr", "tx"}) {
      ASSERT_EQ(bake_ramp("color", "--format " + std::string(format), out), 0) << errors_;
    }
    ASSERT_EQ(render("-q", std::string(out) + "/r.exr"), 0) << errors_;
    ASSERT_EQ(render("-q", std::string(out) + "/r.png"), 0) << errors_;
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  }
  for (const char* name : {"NG.color.png", "NG.color.exr", "NG.color.tx", "r.exr", "r.png"}) {
    const std::string first = text_of(file("first/" + std::string(name)));
    EXPECT_FALSE(first.empty()) << name;
    EXPECT_TRUE(first == text_of(file("second/" + std::string(name)))) << name;
  }
}

}  // namespace
}  // namespace nacre
