// Types that no image node gives, and tiles: what a baked document reads back is what the
// first one computes.
#include <cmath>
#include <filesystem>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

// A surface with an input of each such type, fed by functions of uv.
constexpr std::string_view types = R"(<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <nodedef name="ND_strange" node="strange">
    <input name="flag" type="boolean" value="false" />
    <input name="count" type="integer" value="1" />
    <input name="turn" type="matrix33" value="1, 0, 0, 0, 1, 0, 0, 0, 1" />
    <input name="place" type="matrix44" value="1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1" />
    <input name="fixed" type="integer" value="1" />
    <output name="out" type="surfaceshader" />
  </nodedef>
  <nodegraph name="NG_strange" nodedef="ND_strange">
    <surface_unlit name="glow" type="surfaceshader" />
    <output name="out" type="surfaceshader" nodename="glow" />
  </nodegraph>
  <nodegraph name="NG">
    <texcoord name="uv" type="vector2" />
    <separate2 name="xy" type="multioutput"><input name="in" type="vector2" nodename="uv" /></separate2>
    <ifgreater name="flag" type="boolean">
      <input name="value1" type="float" nodename="xy" output="outx" />
      <input name="value2" type="float" nodename="xy" output="outy" />
    </ifgreater>
    <multiply name="many" type="float">
      <input name="in1" type="float" nodename="xy" output="outx" />
      <input name="in2" type="float" value="-5000" />
    </multiply>
    <floor name="count" type="integer"><input name="in" type="float" nodename="many" /></floor>
    <noise2d name="noise" type="vector3" />
    <noise2d name="noise4" type="vector4" />
    <creatematrix name="turn" type="matrix33">
      <input name="in1" type="vector3" nodename="noise" />
      <input name="in3" type="vector3" value="7, 8, 9" />
    </creatematrix>
    <creatematrix name="place" type="matrix44">
      <input name="in2" type="vector4" nodename="noise4" />
      <input name="in4" type="vector4" value="4, 5, 6, 1" />
    </creatematrix>
    <floor name="three" type="integer"><input name="in" type="float" value="3.5" /></floor>
    <output name="flag_out" type="boolean" nodename="flag" />
    <output name="count_out" type="integer" nodename="count" />
    <output name="turn_out" type="matrix33" nodename="turn" />
    <output name="place_out" type="matrix44" nodename="place" />
    <output name="three_out" type="integer" nodename="three" />
  </nodegraph>
  <strange name="S" type="surfaceshader">
    <input name="flag" type="boolean" nodegraph="NG" output="flag_out" />
    <input name="count" type="integer" nodegraph="NG" output="count_out" />
    <input name="turn" type="matrix33" nodegraph="NG" output="turn_out" />
    <input name="place" type="matrix44" nodegraph="NG" output="place_out" />
    <input name="fixed" type="integer" nodegraph="NG" output="three_out" />
  </strange>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S" />
  </surfacematerial>
</materialx>
)";

class BakeTypes : public Tool {
 protected:
  int bake(std::string_view text, const std::string& options) {
    return run("bake " + write("from.mtlx", text) + " --no-cache --document " + file("baked.mtlx") +
               " --out " + file("textures") + " " + options);
  }
};

TEST_F(BakeTypes, BooleansIntegersAndMatricesComeBack) {
  for (const std::string_view format : {"exr", "tx"}) {
    ASSERT_EQ(bake(types, "--size 16 --format " + std::string(format)), 0) << errors_;
    const auto before = read(file("from.mtlx"));
    const auto after = read(file("baked.mtlx"));
    for (const std::string name : {"flag", "count", "turn", "place"}) {
      const std::vector<float> wanted = values(*before, "NG/" + name + "_out", 16);
      EXPECT_EQ(values(*after, "NG_baked_S/" + name + "_output", 16), wanted) << name;
      EXPECT_NE(wanted, std::vector<float>(wanted.size(), wanted.at(0))) << name;
    }
    EXPECT_EQ(after->root().child("S")->child("fixed")->attribute("value"), "3");
    run("check " + file("baked.mtlx"));
    EXPECT_EQ(errors_, "");
  }
}

/// Four times as many points see four of each value: nothing lies between texels.
TEST_F(BakeTypes, BooleansAndIntegersHaveNoValuesBetween) {
  ASSERT_EQ(bake(types, "--size 8"), 0) << errors_;
  const auto after = read(file("baked.mtlx"));
  for (const std::string name : {"flag", "count"}) {
    const std::vector<float> texels = values(*after, "NG_baked_S/" + name + "_output", 8);
    const std::vector<float> points = values(*after, "NG_baked_S/" + name + "_output", 16);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(points[i], texels[i / 32 * 8 + i % 16 / 2]) << name << ' ' << i;
    }
  }
}

TEST_F(BakeTypes, BooleansFitIntoBytes) {
  std::string text(types);
  const std::size_t count = text.find("<input name=\"count\" type=\"integer\" nodegraph");
  text.erase(count, text.find("<input name=\"fixed\" type=\"integer\" nodegraph") - count);
  ASSERT_EQ(bake(text, "--size 16 --format png"), 0) << errors_;
  const auto before = read(file("from.mtlx"));
  const auto after = read(file("baked.mtlx"));
  EXPECT_EQ(values(*after, "NG_baked_S/flag_output", 16), values(*before, "NG/flag_out", 16));
}

TEST_F(BakeTypes, IntegersThatAFileCannotHoldAreAnError) {
  EXPECT_EQ(bake(types, "--size 16 --bitdepth 16"), 1);  // Half floats: whole up to 2048.
  EXPECT_NE(errors_.find("out-of-range"), std::string::npos) << errors_;
  EXPECT_NE(errors_.find("-2048 to 2048"), std::string::npos) << errors_;
  EXPECT_FALSE(fs::exists(file("baked.mtlx")));
}

// floor(u) + 10 floor(v) is the number of a tile; u + v tells its texels apart.
constexpr std::string_view tiled = R"(<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <nodegraph name="NG">
    <texcoord name="uv" type="vector2" />
    <floor name="cell" type="vector2"><input name="in" type="vector2" nodename="uv" /></floor>
    <dotproduct name="tile" type="float">
      <input name="in1" type="vector2" nodename="cell" />
      <input name="in2" type="vector2" value="1, 10" />
    </dotproduct>
    <dotproduct name="sum" type="float">
      <input name="in1" type="vector2" nodename="uv" />
      <input name="in2" type="vector2" value="1, 1" />
    </dotproduct>
    <combine3 name="both" type="color3">
      <input name="in1" type="float" nodename="tile" />
      <input name="in2" type="float" nodename="sum" />
    </combine3>
    <floor name="number" type="integer"><input name="in" type="float" nodename="tile" /></floor>
    <output name="both_out" type="color3" nodename="both" />
    <output name="number_out" type="integer" nodename="number" />
  </nodegraph>
  <standard_surface name="SS" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="both_out" />
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SS" />
  </surfacematerial>
</materialx>
)";

class BakeTiles : public BakeTypes {
 protected:
  static constexpr int size = 8;

  /// An output over one tile.
  std::vector<float> tile_values(const Document& document, const std::string& name, int u, int v) {
    Diagnostics diagnostics;
    const auto kernel = system_->compile_outputs(document, {name}, {}, diagnostics);
    EXPECT_NE(kernel, nullptr) << diagnostics.to_string();
    if (kernel == nullptr) return {};
    return host::bake_image(
        *kernel, 0, {.width = size, .height = size, .corner_u = u, .corner_v = v, .threads = 1});
  }
};

TEST_F(BakeTiles, EveryTileHasItsOwnValues) {
  ASSERT_EQ(bake(tiled, "--size 8 --udim 1001,1002,1013"), 0) << errors_;
  for (const char* name : {"1001", "1002", "1013"}) {
    EXPECT_TRUE(fs::exists(file("textures/SS.base_color." + std::string(name) + ".exr")));
  }
  const auto after = read(file("baked.mtlx"));
  const Element& name =
      *after->root().child("NG_baked_SS")->child("base_color_image")->child("file");
  EXPECT_EQ(name.attribute("value"), "textures/SS.base_color.<UDIM>.exr");
  for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {2, 1}}) {
    const auto texels = tile_values(*after, "NG_baked_SS/base_color_output", u, v);
    ASSERT_EQ(texels.size(), std::size_t{size * size * 3});
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        const float* rgb = &texels[static_cast<std::size_t>((j * size + i) * 3)];
        EXPECT_EQ(rgb[0], u + 10 * v);
        EXPECT_EQ(double{rgb[1]}, u + (i + 0.5) / size + v + 1 - (j + 0.5) / size);
      }
    }
  }
  // Where there is no tile the image gives its default, black.
  for (const float x : tile_values(*after, "NG_baked_SS/base_color_output", 5, 0)) EXPECT_EQ(x, 0);
  run("check " + file("baked.mtlx"));
  EXPECT_EQ(errors_, "");
}

TEST_F(BakeTiles, OutputsAreWrittenTileByTile) {
  ASSERT_EQ(run("bake " + write("t.mtlx", tiled) + " --no-cache --size 4 --output NG/number_out " +
                "--udim 1001,1024 --out " + file("out")),
            0)
      << errors_;
  const auto document = read(write("read.mtlx", R"(<materialx version="1.39">
    <image name="i" type="float"><input name="file" type="filename" value="out/NG.number_out.&lt;UDIM&gt;.exr"/>
    </image><output name="o" type="float" nodename="i"/></materialx>)"));
  EXPECT_EQ(tile_values(*document, "o", 0, 0), std::vector<float>(size * size, 0.0f));
  EXPECT_EQ(tile_values(*document, "o", 3, 2), std::vector<float>(size * size, 23.0f));
}

TEST_F(BakeTiles, AutoIsWhatTheDocumentSays) {
  ASSERT_EQ(bake(tiled, "--size 8 --udim 1001,1013"), 0) << errors_;
  // The baked document has a udimset; without it there are the files.
  for (const bool has_set : {true, false}) {
    std::string text = text_of(file("baked.mtlx"));
    const std::size_t set = text.find("udimset");
    ASSERT_NE(set, std::string::npos);
    if (!has_set) text.replace(set, 7, "another");
    write("again.mtlx", text);
    fs::remove_all(file("more"));
    ASSERT_EQ(run("bake " + file("again.mtlx") + " --no-cache --size 8 --udim auto --document " +
                  file("twice.mtlx") + " --out " + file("more")),
              0)
        << errors_;
    EXPECT_TRUE(fs::exists(file("more/SS.base_color.1013.exr")));
    EXPECT_FALSE(fs::exists(file("more/SS.base_color.1002.exr")));
    const auto once = read(file("baked.mtlx")), twice = read(file("twice.mtlx"));
    EXPECT_EQ(tile_values(*twice, "NG_baked_SS/base_color_output", 2, 1),
              tile_values(*once, "NG_baked_SS/base_color_output", 2, 1));
  }
}

TEST_F(BakeTiles, WrongTilesAreErrors) {
  for (const std::string tiles : {"1000", "10011", "a", "1001,,1002", "auto"}) {
    EXPECT_EQ(bake(tiled, "--size 4 --udim " + tiles), tiles == "1001,,1002" ? 0 : 1) << tiles;
  }
  EXPECT_NE(errors_.find("no-udim"), std::string::npos) << errors_;
}

}  // namespace
}  // namespace nacre
