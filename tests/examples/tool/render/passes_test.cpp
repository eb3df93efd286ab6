// Passes of `nacre render`, read by OpenImageIO.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/examples/tool/render/image_layers.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

/// A card of a document's one material.
constexpr std::string_view card = "o card\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
constexpr std::string_view positions = R"(<nodegraph name="NG">
    <position name="p" type="vector3"/><output name="out" type="vector3" nodename="p"/>
  </nodegraph>)";

class PassesOfTool : public Tool {
 protected:
  std::string document(std::string_view name) const {
    return NACRE_SOURCE_DIR "/examples/documents/" + std::string(name) + ".mtlx";
  }
};

const std::string all_light =
    "emission,background,direct,indirect,direct_diffuse,direct_glossy,direct_mirror,"
    "direct_transmission,direct_subsurface,direct_volume,indirect_diffuse,indirect_glossy,"
    "indirect_mirror,indirect_transmission,indirect_subsurface,indirect_volume";

// Of what scatters in every way: a metal, glass, wax by random walk, a volume.
TEST_F(PassesOfTool, LightAddsUpToThePicture) {
  const std::string smoke = NACRE_SOURCE_DIR "/examples/volumes/smoke.mtlx";
  for (const std::string& what :
       {document("brass"), document("glass"), document("jade"), document("velvet"), smoke}) {
    const std::string asked = "render " + what + " --size 24 --spp 8 --out " + file("a.exr");
    ASSERT_EQ(
        run(asked + " --aov " + all_light + " --light-group sky=environment --light-group key=key"),
        0)
        << errors_;
    const Layers layers = layers_of(file("a.exr"));
    for (const char* c : {".R", ".G", ".B"}) {
      const std::vector<float>& whole = layers[std::string(1, c[1])];
      std::vector<double> sum(whole.size()), parts(whole.size()), groups(whole.size());
      for (const auto& [name, plane] : layers.planes) {
        if (!name.ends_with(c)) continue;
        const std::string pass = name.substr(0, name.size() - 2);
        const bool is_part = pass.starts_with("direct_") || pass.starts_with("indirect_");
        const bool is_seen = pass == "emission" || pass == "background";
        for (std::size_t i = 0; i < plane.size(); ++i) {
          const auto x = static_cast<double>(plane[i]);
          if (is_seen || pass == "direct" || pass == "indirect") sum[i] += x;
          if (is_seen || is_part) parts[i] += x;
          if (pass.starts_with("light_")) groups[i] += x;
        }
      }
      for (std::size_t i = 0; i < whole.size(); ++i) {
        const auto x = static_cast<double>(whole[i]);
        ASSERT_NEAR(sum[i], x, 1e-5 * x) << what << c << i;
        ASSERT_NEAR(parts[i], x, 1e-5 * x) << what << c << i;
        ASSERT_NEAR(groups[i], x, 1e-5 * x) << what << c << i;
      }
    }
    // The picture does not change.
    const std::vector<float> red = layers["R"];
    ASSERT_EQ(run(asked), 0) << errors_;
    EXPECT_EQ(layers_of(file("a.exr"))["R"], red) << what;
  }
}

TEST_F(PassesOfTool, WhatAMaterialIsOfIsKnown) {
  write("a.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">
    <nodegraph name="NG"><position name="p" type="vector3"/>
      <constant name="seven" type="integer"><input name="value" type="integer" value="7"/></constant>
      <multiply name="half" type="vector3"><input name="in1" type="vector3" nodename="p"/>
        <input name="in2" type="float" value="0.5"/></multiply>
      <output name="out" type="vector3" nodename="half"/></nodegraph>
    <oren_nayar_diffuse_bsdf name="b" type="BSDF">
      <input name="color" type="color3" value="0.25, 0.5, 0.75"/></oren_nayar_diffuse_bsdf>
    <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  </materialx>)");
  write("a.obj", card);
  ASSERT_EQ(
      run("render " + file("a.mtlx") + " --scene " + file("a.obj") + " --size 8 --spp 4 --out " +
          file("a.exr") +
          " --aov albedo,C.[LO],position --aov NG/half,NG/seven,crypto_object,crypto_material"),
      0)
      << errors_;
  const Layers layers = layers_of(file("a.exr"));
  const std::size_t middle = 8 * 4 + 4;
  EXPECT_FLOAT_EQ(layers["albedo.R"][middle], 0.25f);
  EXPECT_FLOAT_EQ(layers["albedo.B"][middle], 0.75f);
  EXPECT_EQ(layers["direct.G"].size(), 64u);
  EXPECT_FLOAT_EQ(layers["NG/half.R"][middle], 0.5f * layers["position.X"][middle]);
  EXPECT_GT(std::abs(layers["NG/half.R"][middle]), 0.01f);
  EXPECT_EQ(layers["NG/seven.V"][middle], 7.0f);
  std::set<std::string> types;
  for (const auto& [name, text] : layers.texts) {
    if (name.ends_with("/name")) types.insert(text);
    if (!name.ends_with("/manifest")) continue;
    const auto manifest = nlohmann::json::parse(text);
    EXPECT_TRUE(manifest.contains("card") || manifest.contains("M")) << text;
  }
  EXPECT_EQ(types, (std::set<std::string>{"CryptoMaterial", "CryptoObject"}));
  EXPECT_FLOAT_EQ(layers["CryptoObject00.G"][middle], 1.f);
}

// Options take one word each: what stands behind them is not theirs.
TEST_F(PassesOfTool, OptionsMayStandBeforeTheDocument) {
  EXPECT_EQ(run("render --aov depth --light-group sky=environment " + document("brass") +
                " --size 8 --spp 1 --out " + file("a.exr")),
            0)
      << errors_;
  const Layers layers = layers_of(file("a.exr"));
  EXPECT_TRUE(layers.planes.contains("depth.Z"));
  for (const char* c : {"R", "G", "B"}) {
    const std::string tail = std::string(".") + c;
    for (std::size_t i = 0; i < 64; ++i) {
      EXPECT_NEAR(layers["light_sky" + tail][i] + layers["light_other" + tail][i], layers[c][i],
                  1e-5f * layers[c][i]);
    }
  }
}

TEST_F(PassesOfTool, WhatOnlyShinesHasValuesToo) {
  write("a.mtlx", "<materialx version=\"1.39\" colorspace=\"lin_rec709\">" +
                      std::string(positions) +
                      R"(<surface_unlit name="s" type="surfaceshader"/>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  </materialx>)");
  write("a.obj", card);
  ASSERT_EQ(run("render " + file("a.mtlx") + " --scene " + file("a.obj") +
                " --size 8 --spp 4 --aov NG/p,position,emission --out " + file("a.exr")),
            0)
      << errors_;
  const Layers layers = layers_of(file("a.exr"));
  const std::size_t middle = 8 * 4 + 4;
  EXPECT_EQ(layers["NG/p.R"][middle], layers["position.X"][middle]);
  EXPECT_NE(layers["NG/p.R"][middle], 0.0f);
  EXPECT_EQ(layers["emission.R"][middle], 1.0f);
}

TEST_F(PassesOfTool, WhatThereIsNotIsAnError) {
  const std::string asked = "render " + document("brass") + " --size 8 --spp 1 --out ";
  EXPECT_EQ(run(asked + file("a.exr") + " --aov depht"), 2);
  EXPECT_TRUE(says("unknown-aov") && says("'depht'")) << errors_;
  EXPECT_EQ(run(asked + file("a.png") + " --aov depth"), 2);
  EXPECT_TRUE(says("passes-need-exr")) << errors_;
  EXPECT_EQ(run(asked + file("a.exr") + " --half --aov crypto_object"), 2);
  EXPECT_TRUE(says("mattes-need-floats")) << errors_;
  EXPECT_EQ(run(asked + file("a.exr") + " --light-group fill=nobody"), 1);
  EXPECT_TRUE(says("unmatched-light") && says("'nobody'")) << errors_;
  EXPECT_EQ(run(asked + file("a.exr") + " --light-group fill=enviroment"), 1);
  EXPECT_TRUE(says("unmatched-light") && says("did you mean 'environment'?")) << errors_;
  EXPECT_EQ(run(asked + file("a.exr") + " --aov NG_brushed/nothing"), 1);
  EXPECT_TRUE(says("NG_brushed/nothing")) << errors_;
  EXPECT_FALSE(std::filesystem::exists(file("a.exr")));
}

}  // namespace
}  // namespace nacre
