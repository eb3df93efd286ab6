// What `bake` takes for what feeds an input is what the library computes of it.
#include <OpenImageIO/imageio.h>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

// A surface in a graph, and a closure and a number in others.
constexpr std::string_view nested = R"(<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <nodegraph name="NG">
    <noise2d name="n" type="color3" />
    <oren_nayar_diffuse_bsdf name="bsdf" type="BSDF">
      <input name="color" type="color3" nodename="n" />
    </oren_nayar_diffuse_bsdf>
    <output name="color_out" type="color3" nodename="n" width="4" height="2" />
    <output name="bsdf_out" type="BSDF" nodename="bsdf" />
  </nodegraph>
  <nodegraph name="G">
    <input name="amount" type="float" />
    <standard_surface name="general" type="surfaceshader">
      <input name="coat" type="float" value="0.25" />
      <input name="metalness" type="float" value="0.75" />
    </standard_surface>
    <standard_surface name="special" type="surfaceshader" inherit="general">
      <input name="base" type="float" interfacename="amount" />
      <input name="base_color" type="color3" nodegraph="NG" output="color_out" />
      <input name="coat" type="float" />
      <input name="specular" type="float" interfacename="nothing" value="0.5" />
    </standard_surface>
    <surface name="made" type="surfaceshader">
      <input name="bsdf" type="BSDF" nodegraph="NG" output="bsdf_out" />
    </surface>
    <output name="special_out" type="surfaceshader" nodename="special" />
    <output name="made_out" type="surfaceshader" nodename="made" />
  </nodegraph>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodegraph="G" output="special_out" />
    <input name="backsurfaceshader" type="surfaceshader" nodegraph="G" output="made_out" />
  </surfacematerial>
</materialx>
)";

class BakeFeeds : public Tool {
 protected:
  int bake(const std::string& options = {}) {
    return run("bake " + write("from.mtlx", nested) + " --no-cache --bitdepth 32 --document " +
               file("baked.mtlx") + " --out " + file("textures") + " " + options);
  }
};

TEST_F(BakeFeeds, TheBakedDocumentSaysWhatTheLibraryComputes) {
  ASSERT_EQ(bake(), 0) << errors_;
  const auto after = read(file("baked.mtlx"));
  const auto& special = *after->root().child("G_special");
  // A graph's input that says nothing is 0, whatever the node has as its default.
  EXPECT_EQ(special.child("base")->attribute("value"), "0");
  // An input that says nothing does not hide the one that is inherited.
  EXPECT_EQ(special.child("coat")->attribute("value"), "0.25");
  EXPECT_EQ(special.child("metalness")->attribute("value"), "0.75");
  // An interface that there is not leaves the value, and is said.
  EXPECT_EQ(special.child("specular")->attribute("value"), "0.5");
  EXPECT_TRUE(says("unknown-interface")) << errors_;
}

TEST_F(BakeFeeds, GraphsAreFoundAtTheRoot) {
  ASSERT_EQ(bake(), 0) << errors_;
  const auto after = read(file("baked.mtlx"));
  EXPECT_EQ(after->root().child("G_made")->child("bsdf")->attribute("nodename"), "NG_bsdf");
  // The size that the <output> says.
  const auto image = OIIO::ImageInput::open(file("textures/G_special.base_color.exr"));
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->spec().width, 4);
  EXPECT_EQ(image->spec().height, 2);
}

TEST_F(BakeFeeds, StrictlyAMissingInterfaceIsAnError) {
  EXPECT_EQ(bake("--strict"), 1);
  EXPECT_TRUE(says("unknown-interface")) << errors_;
}

TEST_F(BakeFeeds, TheInputsOfAMaterialAreThoseOfTheNodeBehindItsGraph) {
  ASSERT_EQ(
      run("bake " + write("from.mtlx", nested) + " --no-cache --material M --out " + file("out")),
      0)
      << errors_;
  EXPECT_EQ(names_in(file("out")), std::set<std::string>{"NG.color_out.exr"});
}

TEST_F(BakeFeeds, AnOutputOfANodeIsNoOutputOfTheDocument) {
  ASSERT_EQ(run("bake " + write("from.mtlx", R"(<materialx version="1.39">
    <texcoord name="uv" type="vector2"/>
    <separate2 name="xy" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
    <output name="y" type="float" nodename="xy" output="outy"/>
    <standard_surface name="S" type="surfaceshader">
      <input name="base" type="float" nodename="xy" output="outx"/>
      <input name="coat" type="float" output="y"/>
    </standard_surface>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/>
    </surfacematerial></materialx>)") +
                " --no-cache --size 4 --material M --out " + file("out")),
            0)
      << errors_;
  EXPECT_EQ(names_in(file("out")), std::set<std::string>{"y.exr"});
}

}  // namespace
}  // namespace nacre
