#include <OpenImageIO/imagebuf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "tests/examples/image_input/image_fixture.h"

namespace graph_image {
namespace {

using GraphImageInput = GraphImages;

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && !a.empty() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(GraphImageInput, SaysThatItIsATexture) {
  const auto image = open(marble_ + "?output=NG_marble/base_color&size=300x100");
  ASSERT_NE(image, nullptr);
  EXPECT_STREQ(image->format_name(), "mtlx");
  const OIIO::ImageSpec& spec = image->spec();
  EXPECT_EQ(spec.width, 300);
  EXPECT_EQ(spec.full_height, 100);
  EXPECT_EQ(spec.tile_width, 64);
  EXPECT_EQ(spec.tile_height, 64);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(spec.channelnames, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(spec.get_string_attribute("textureformat"), "Plain Texture");
  EXPECT_EQ(spec.get_string_attribute("wrapmodes"), "periodic,periodic");
  EXPECT_EQ(spec.get_string_attribute("oiio:ColorSpace"), "Linear");
  EXPECT_EQ(spec.get_string_attribute("mtlx:output"), "NG_marble/base_color");
  int levels = 1;
  while (image->seek_subimage(0, levels)) ++levels;
  EXPECT_EQ(levels, 9);
  EXPECT_EQ(image->spec().width, 1);
  EXPECT_FALSE(image->seek_subimage(1, 0));
  EXPECT_FALSE(image->seek_subimage(0, -1));
}

TEST_F(GraphImageInput, DataIsOfNoColourSpace) {
  const auto image = open(marble_ + "?output=NG_marble/roughness");
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->spec().width, 1024);
  EXPECT_EQ(image->spec().channelnames, std::vector<std::string>{"Y"});
  EXPECT_EQ(image->spec().find_attribute("oiio:ColorSpace"), nullptr);
}

TEST_F(GraphImageInput, TheDocumentSaysHowLargeATextureIs) {
  std::string text = ramp();
  text.replace(text.find("<output "), 8, "<output width=\"48\" height=\"20\" ");
  const std::string file = write("sized.mtlx", text);
  const auto image = open(file);
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->spec().width, 48);
  EXPECT_EQ(image->spec().height, 20);
  const auto larger = open(file + "?size=64");
  ASSERT_NE(larger, nullptr);
  EXPECT_EQ(larger->spec().height, 64);
}

TEST_F(GraphImageInput, TexelsAreThoseThatTheToolBakes) {
  for (const char* output : {"base_color", "roughness"}) {
    const std::string command = std::string(NACRE_TOOL) + " bake '" + marble_ +
                                "' -q --format exr --size 200x150 --output NG_marble/" + output +
                                " --out '" + folder_.path().string() + "' 2> /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::vector<float> baked =
        read(folder_.file("NG_marble." + std::string(output) + ".exr"));
    EXPECT_TRUE(same_bits(baked, read(marble_ + "?size=200x150&output=NG_marble/" + output)));
  }
}

TEST_F(GraphImageInput, TilesOfASetAreThoseThatTheToolBakes) {
  const std::string file = write("ramp.mtlx", ramp());
  const std::string command = std::string(NACRE_TOOL) + " bake '" + file +
                              "' -q --format exr --size 32 --udim 1013 --out '" +
                              folder_.path().string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(same_bits(read(folder_.file("G.out.1013.exr")), read(file + "?size=32&udim=1013")));
}

TEST_F(GraphImageInput, RowsBeginAtTheTopAndColumnsAtTheLeft) {
  const std::vector<float> texels = read(write("ramp.mtlx", ramp()) + "?size=4x2");
  EXPECT_EQ(texels,
            (std::vector<float>{0.125f, 0.75f, 0.375f, 0.75f, 0.625f, 0.75f, 0.875f, 0.75f, 0.125f,
                                0.25f, 0.375f, 0.25f, 0.625f, 0.25f, 0.875f, 0.25f}));
}

TEST_F(GraphImageInput, TimeAndFrameAreThoseAskedFor) {
  const std::string file = write("time.mtlx", document_of(R"(<time name="t" type="float" />
<frame name="f" type="float" />
<combine2 name="both" type="vector2">
  <input name="in1" type="float" nodename="t" /><input name="in2" type="float" nodename="f" />
</combine2>
<output name="out" type="vector2" nodename="both" />)"));
  EXPECT_EQ(read(file + "?size=1"), (std::vector<float>{0.0f, 1.0f}));
  EXPECT_EQ(read(file + "?size=1&time=0.25&frame=12.5"), (std::vector<float>{0.25f, 12.5f}));
}

TEST_F(GraphImageInput, IntegersAndMatricesAreNumbers) {
  const std::string file = write("types.mtlx", document_of(R"(<constant name="i" type="integer">
  <input name="value" type="integer" value="-7" />
</constant>
<constant name="m" type="matrix33">
  <input name="value" type="matrix33" value="1, 2, 3, 4, 5, 6, 7, 8, 9" />
</constant>
<constant name="c" type="color4"><input name="value" type="color4" value="1, 2, 3, 0.5" /></constant>
<output name="integer" type="integer" nodename="i" />
<output name="matrix" type="matrix33" nodename="m" />
<output name="rgba" type="color4" nodename="c" />)"));
  EXPECT_EQ(read(file + "?size=1&output=G/integer"), std::vector<float>{-7.0f});
  EXPECT_EQ(read(file + "?size=1&output=G/matrix"),
            (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(read(file + "?size=1&output=G/rgba"), (std::vector<float>{1, 2, 3, 0.5f}));
  const auto rgba = open(file + "?size=1&output=G/rgba");
  ASSERT_NE(rgba, nullptr);
  EXPECT_EQ(rgba->spec().alpha_channel, 3);
  EXPECT_EQ(rgba->spec().get_int_attribute("oiio:UnassociatedAlpha"), 1);
}

TEST_F(GraphImageInput, HalvesAreTheNearestOnes) {
  const std::string name = marble_ + "?output=NG_marble/base_color&size=64";
  const auto image = open(name + "&format=half");
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->spec().format, OIIO::TypeDesc::HALF);
  const std::vector<float> halves = read(*image), floats = read(name);
  ASSERT_EQ(halves.size(), floats.size());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    ASSERT_NEAR(halves[i], floats[i], floats[i] * 0x1p-11f);
  }
}

TEST_F(GraphImageInput, ATileBeyondTheEdgeIsZero) {
  const auto image = open(write("grey.mtlx", grey("0.5")) + "?size=70x10");
  ASSERT_NE(image, nullptr);
  std::vector<float> tile(64 * 64, -1.0f);
  ASSERT_TRUE(image->read_tile(64, 0, 0, OIIO::TypeDesc::FLOAT, tile.data())) << image->geterror();
  for (std::size_t i = 0; i < tile.size(); ++i) {
    ASSERT_EQ(tile[i], i % 64 < 6 && i / 64 < 10 ? 0.5f : 0.0f) << i;
  }
  EXPECT_FALSE(image->read_native_tile(0, 0, 13, 0, 0, tile.data()));
  EXPECT_NE(image->geterror(), "");
  EXPECT_FALSE(image->read_native_tile(0, 9, 0, 0, 0, tile.data()));
}

TEST_F(GraphImageInput, RowsCanBeReadToo) {
  const auto image = open(write("ramp.mtlx", ramp()) + "?size=100");
  ASSERT_NE(image, nullptr);
  const std::vector<float> all = read(*image);
  std::vector<float> row(200);
  ASSERT_TRUE(image->read_scanline(37, 0, OIIO::TypeDesc::FLOAT, row.data()));
  EXPECT_TRUE(std::equal(row.begin(), row.end(), all.begin() + 37 * 200));
  EXPECT_FALSE(image->read_native_scanline(0, 0, 100, 0, row.data()));
  EXPECT_FALSE(image->read_native_scanline(0, 0, -1, 0, row.data()));
  EXPECT_NE(image->geterror(), "");
}

TEST_F(GraphImageInput, BuffersReadAnyChannelsOfAnyLevel) {
  const std::string name = write("ramp.mtlx", ramp()) + "?size=100";
  OIIO::ImageBuf buffer(name, 0, 1);
  ASSERT_TRUE(buffer.read(0, 1, 1, 2, true, OIIO::TypeDesc::FLOAT)) << buffer.geterror();
  EXPECT_EQ(buffer.nmiplevels(), 7);
  ASSERT_EQ(buffer.nchannels(), 1);
  EXPECT_NEAR(buffer.getchannel(3, 0, 0, 0), 0.99f, 1e-6f);  // v of 50 rows, from the top.
  EXPECT_NEAR(buffer.getchannel(3, 49, 0, 0), 0.01f, 1e-6f);
}

TEST_F(GraphImageInput, AConfigurationSaysTheSame) {
  OIIO::ImageSpec config;
  config.attribute("mtlx:output", "NG_marble/roughness");
  config.attribute("mtlx:size", "32x16");
  const auto image = OIIO::ImageInput::open(marble_, &config);
  ASSERT_NE(image, nullptr) << OIIO::geterror();
  EXPECT_EQ(read(*image), read(marble_ + "?output=NG_marble/roughness&size=32x16"));
}

TEST_F(GraphImageInput, SaysWhatIsWrong) {
  EXPECT_EQ(complaint(marble_),
            marble_ +
                ": error: the document has several outputs; expected '?output=' and one of "
                "NG_marble/base_color, NG_marble/roughness [no-output]");
  EXPECT_NE(complaint(marble_ + "?output=NG_marble/none").find("[unknown-request]"),
            std::string::npos);
  EXPECT_NE(complaint(marble_ + "?output=Marble").find(marble_), std::string::npos);
  EXPECT_NE(complaint(folder_.file("none.mtlx")).find("[cannot-read]"), std::string::npos);
  EXPECT_NE(complaint(marble_ + "?output=NG_marble/base_color&profile=none.json")
                .find("the profile cannot be read"),
            std::string::npos);
  const std::string broken = write("broken.mtlx", "<materialx version=\"1.39\">\n<nodegraph");
  EXPECT_EQ(complaint(broken).find(broken + ":2:"), 0u) << complaint(broken);
  const std::string unknown = write("unknown.mtlx", document_of(R"(<nonesuch name="x" type="float"/>
<output name="out" type="float" nodename="x" />)"));
  EXPECT_EQ(complaint(unknown).find(unknown + ":4:"), 0u) << complaint(unknown);
  EXPECT_NE(complaint(unknown).find("(G/x)"), std::string::npos) << complaint(unknown);
  EXPECT_NE(
      complaint(write("empty.mtlx", "<materialx version=\"1.39\"/>")).find("no numeric output"),
      std::string::npos);
}

TEST_F(GraphImageInput, OneThatCannotBeOpenedDoesNothing) {
  const auto image = OIIO::ImageInput::create("mtlx");
  ASSERT_NE(image, nullptr);
  std::array<float, 64 * 64> tile{};
  EXPECT_FALSE(image->read_native_tile(0, 0, 0, 0, 0, tile.data()));
  OIIO::ImageSpec spec;
  EXPECT_FALSE(image->open(folder_.file("none.exr"), spec));
  EXPECT_NE(image->geterror(), "");
  EXPECT_FALSE(image->seek_subimage(0, 0));
  EXPECT_TRUE(image->open(write("grey.mtlx", grey("0.5")), spec));
  EXPECT_FALSE(image->open(marble_ + "?output=none", spec));
  EXPECT_FALSE(image->read_native_tile(0, 0, 0, 0, 0, tile.data()));
  EXPECT_TRUE(image->close());
}

TEST_F(GraphImageInput, FilesOfOthersAreLeftToThem) {
  const auto image = OIIO::ImageInput::create("mtlx");
  ASSERT_NE(image, nullptr);
  EXPECT_TRUE(image->valid_file(marble_));
  EXPECT_TRUE(image->valid_file(marble_ + "?output=a"));
  EXPECT_FALSE(image->valid_file(folder_.file("none.mtlx")));
  EXPECT_FALSE(image->valid_file(write("image.bin", "nothing")));
  EXPECT_NE(complaint(folder_.file("image.bin")), "");
}

TEST_F(GraphImageInput, AGraphThatDoesNotEndIsAnErrorOfTheTile) {
  const auto pack = write("endless.glsl",
                          "void endless(out float x) { x = 0.0; "
                          "for (int i = 0; i < 2; i += 0) { x += 1.0; } }");
  const std::string file = write("endless.mtlx", R"(<?xml version="1.0"?>
<materialx version="1.39">
<nodedef name="ND_endless" node="endless"><output name="out" type="float" /></nodedef>
<implementation name="IM_endless" nodedef="ND_endless" target="genglsl" file="endless.glsl" function="endless" />
<nodegraph name="G"><endless name="e" type="float" /><output name="out" type="float" nodename="e" /></nodegraph>
</materialx>)");
  OIIO::ImageSpec spec;
  const auto image = OIIO::ImageInput::create("mtlx");
  ASSERT_NE(image, nullptr);
  // Known before the first point, or found by it.
  if (image->open(file + "?size=8", spec)) {
    std::vector<float> tile(64 * 64);
    EXPECT_FALSE(image->read_tile(0, 0, 0, OIIO::TypeDesc::FLOAT, tile.data()));
  }
  EXPECT_NE(image->geterror(), "");
}

}  // namespace
}  // namespace graph_image
