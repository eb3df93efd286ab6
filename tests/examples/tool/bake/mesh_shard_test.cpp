// Maps of meshes that are recorded and shared among runs: together they are one run, byte by byte,
// and what was baked on another scene, or otherwise, does not count.
#include "tests/examples/tool/bake/farm_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// Three squares beside and above each other in uv, the last one over the first, so that it is
/// dark there.
constexpr std::string_view squares = R"(
v 0 0 0
v 1 0 0
v 1 0 -1
v 0 0 -1
v 2 0 0
v 2 0 -1
v 0 0.25 0
v 1 0.25 0
v 1 0.5 -1
v 0 0.5 -1
vt 0.1 0.1
vt 0.9 0.1
vt 0.9 0.9
vt 0.1 0.9
vt 1.1 0.1
vt 1.9 0.1
vt 1.9 0.9
vt 1.1 0.9
vt 0.1 1.1
vt 0.9 1.1
vt 0.9 1.9
vt 0.1 1.9
o first
f 1/1 2/2 3/3 4/4
o second
f 2/5 5/6 6/7 3/8
o roof
f 7/9 8/10 9/11 10/12
)";

class BakeMeshShard : public Farm {
 protected:
  void SetUp() override {
    Farm::SetUp();
    write("a.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">
      <geominfo name="u" geom="/"><geomprop name="udimset" type="stringarray"
        value="1001,1002,1011"/></geominfo>
      <nodegraph name="G">
        <image name="i" type="color3"><input name="file" type="filename" value="t.png"/></image>
        <geompropvalue name="a" type="float">
          <input name="geomprop" type="string" value="ambientocclusion"/></geompropvalue>
        <position name="p" type="vector3"/>
        <convert name="c" type="color3"><input name="in" type="vector3" nodename="p"/></convert>
        <constant name="k" type="float"><input name="value" type="float" value="0.25"/></constant>
        <output name="image" type="color3" nodename="i"/>
        <output name="open" type="float" nodename="a"/>
        <output name="place" type="color3" nodename="c"/>
        <output name="const" type="float" nodename="k"/>
      </nodegraph>
      <standard_surface name="S" type="surfaceshader">
        <input name="base_color" type="color3" nodegraph="G" output="image"/>
        <input name="base" type="float" nodegraph="G" output="open"/>
        <input name="specular_color" type="color3" nodegraph="G" output="place"/>
        <input name="metalness" type="float" nodegraph="G" output="const"/>
      </standard_surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/>
      </surfacematerial></materialx>)");
    scene_ = write("a.obj", squares);
  }

  int on_meshes(const std::string& folder, const std::string& arguments = "") {
    const bool has_rays = arguments.find("--rays") != std::string::npos;
    return bake_document(
        folder, "--scene " + scene_ + " --samples 2 " + (has_rays ? "" : "--rays 32 ") + arguments);
  }
  int written() const { return nlohmann::json::parse(printed_)["written"]; }

  std::string scene_;
};

TEST_F(BakeMeshShard, TogetherTheyAreOneRun) {
  ASSERT_EQ(on_meshes("one"), 0) << errors_;
  const auto right = baked("one");
  EXPECT_EQ(right.size(), 10u);
  for (const int count : {1, 2, 4}) {
    const std::string folder = "of" + std::to_string(count);
    for (int index = count; index >= 1; --index) {
      EXPECT_EQ(on_meshes(folder, "--threads 3 --shard " + std::to_string(index) + "/" +
                                      std::to_string(count)),
                0)
          << errors_;
    }
    EXPECT_EQ(on_meshes(folder, "--json --merge " + std::to_string(count)), 0) << errors_;
    EXPECT_EQ(baked(folder), right) << count;
    const auto said = nlohmann::json::parse(printed_);
    EXPECT_EQ(said["merged"], 9);
    EXPECT_TRUE(said["files"][0].contains("covered_texels")) << printed_;
  }
}

TEST_F(BakeMeshShard, GoesOnWithWhatIsThere) {
  ASSERT_EQ(on_meshes("one", "--manifest " + file("one/m.json")), 0) << errors_;
  const auto right = baked("one");
  fs::remove(file("one/S.base.1002.exr"));
  write("one/S.base_color.1011.exr", "cut short");
  ASSERT_EQ(on_meshes("one", "--json --manifest " + file("one/m.json")), 0) << errors_;
  EXPECT_EQ(written(), 2);
  EXPECT_TRUE(says("7 of 12 images are there already")) << errors_;
  EXPECT_EQ(baked("one"), right);
}

TEST_F(BakeMeshShard, WhatIsOfAnotherBakeIsRefused) {
  const auto is_refused = [&](const std::string& changed, const std::string& why) {
    EXPECT_EQ(on_meshes("out", "--shard 2/2 " + changed), 0) << errors_;
    EXPECT_EQ(on_meshes("out", "--merge 2"), 1) << changed;
    EXPECT_TRUE(says(why) && says("[foreign-part]")) << errors_;
    EXPECT_FALSE(fs::exists(file("out/b.mtlx")));
  };
  ASSERT_EQ(on_meshes("out", "--shard 1/2"), 0) << errors_;
  is_refused("--rays 33", "rays was 33, not 32");
  is_refused("--distance 2", "distance was 2, not");
  is_refused("--dilate 2", "dilate was 2, not all");
  is_refused("--view normal", "view was normal, not none");
  is_refused("--mesh first --mesh second --mesh roof", "mesh was first, second, roof");
  // On the plane.
  ASSERT_EQ(bake_document("out", "--samples 2 --shard 2/2"), 0) << errors_;
  EXPECT_EQ(on_meshes("out", "--merge 2"), 1);
  EXPECT_TRUE(says("scene is new") && says("[foreign-part]")) << errors_;
  // What is baked on stands elsewhere, though its file is called the same.
  std::string moved(squares);
  moved.replace(moved.find("v 0 0.25 0"), 10, "v 0 0.75 0");
  write("a.obj", moved);
  ASSERT_EQ(on_meshes("out", "--shard 2/2"), 0) << errors_;
  write("a.obj", squares);
  EXPECT_EQ(on_meshes("out", "--merge 2"), 1);
  EXPECT_TRUE(says("scene has changed") && says("[foreign-part]")) << errors_;
  ASSERT_EQ(on_meshes("out", "--shard 2/2"), 0) << errors_;
  EXPECT_EQ(on_meshes("out", "--merge 2"), 0) << errors_;
}

}  // namespace
}  // namespace nacre
