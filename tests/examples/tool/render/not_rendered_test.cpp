// What `render` is asked and cannot do is said before the first ray, or with the picture.
#include <chrono>
#include <filesystem>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

constexpr std::string_view head = R"(<?xml version="1.0"?><materialx version="1.39">)";

constexpr std::string_view quad = R"(o card
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
f 1 2 3 4
)";

class NotRendered : public Tool {
 protected:
  /// Renders a document that is this text on the card, as small as can be.
  int render(std::string_view text, const std::string& flags = "") {
    return render_to(file("a.png"), text, "--size 4 --no-cache " + flags);
  }
  int render_to(const std::string& out, std::string_view text, const std::string& flags) {
    write("a.mtlx", std::string(head) + std::string(text) + "</materialx>");
    write("a.obj", quad);
    const std::string samples = flags.find("--spp") == flags.npos ? " --spp 1 " : " ";
    return run("render " + file("a.mtlx") + " --scene " + file("a.obj") + " --out " + out +
               samples + flags);
  }

  static std::string material(std::string_view category, std::string_view inputs) {
    return "<" + std::string(category) + R"( name="S" type="surfaceshader">)" +
           std::string(inputs) + "</" + std::string(category) + ">" +
           R"(<surfacematerial name="M" type="material">
             <input name="surfaceshader" type="surfaceshader" nodename="S"/>
           </surfacematerial>)";
  }

  /// Complaints of that code; each is a line that names the file.
  std::size_t count(const std::string& code) const {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = errors_.find('[' + code + ']', at)) != errors_.npos; ++at) {
      ++found;
    }
    return found;
  }
};

std::string input(const std::string& name, const std::string& type, const std::string& value) {
  return "<input name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

TEST_F(NotRendered, MediaInsideAreSaidWhereTheyCount) {
  const std::string water = input("transmission_weight", "float", "1");
  EXPECT_EQ(render(material("open_pbr_surface", water)), 0);
  EXPECT_EQ(errors_, "");
  const std::string depth = input("transmission_depth", "float", "0.5") +
                            input("transmission_color", "color3", "0.5, 0.1, 0.1");
  EXPECT_EQ(render(material("open_pbr_surface", water + depth)), 0);
  // It is rendered, but light that enters a card has nowhere to leave.
  EXPECT_EQ(count("not-modelled"), 0u) << errors_;
  EXPECT_EQ(count("open-solid"), 1u) << errors_;
  EXPECT_NE(errors_.find("card"), errors_.npos) << errors_;
  // What does not ask for the kernel is told.
  EXPECT_EQ(run("inspect --no-cache " + file("a.mtlx")), 0);
  EXPECT_NE(text_of(file("stdout")).find("interior medium"), std::string::npos);
  // Where nothing is transmitted no depth matters.
  EXPECT_EQ(render(material("open_pbr_surface", depth)), 0);
  EXPECT_EQ(errors_, "");
  EXPECT_EQ(run("inspect --no-cache " + file("a.mtlx")), 0);
  EXPECT_EQ(text_of(file("stdout")).find("interior medium"), std::string::npos);
  EXPECT_EQ(render(material("open_pbr_surface", input("subsurface_weight", "float", "1"))), 0);
  EXPECT_EQ(count("not-modelled"), 1u) << errors_;
  EXPECT_NE(errors_.find("subsurface_bsdf: radius"), errors_.npos) << errors_;
  EXPECT_EQ(run("inspect --no-cache " + file("a.mtlx")), 0);
  EXPECT_NE(text_of(file("stdout")).find("subsurface_bsdf: radius"), std::string::npos);
}

TEST_F(NotRendered, WhatFacetsAreNotGivenBackIsInTheManifest) {
  const std::string gold = std::string(head) +
                           material("standard_surface", input("metalness", "float", "1")) +
                           "</materialx>";
  const auto says_so = [&](const std::string& options) {
    EXPECT_EQ(run("inspect --no-cache " + options + write("gold.mtlx", gold)), 0) << errors_;
    return printed_.find("several scatterings between facets") != printed_.npos;
  };
  EXPECT_FALSE(says_so(""));
  EXPECT_FALSE(says_so("--compensation reflection "));
  EXPECT_TRUE(says_so("--compensation nothing "));
  EXPECT_NE(run("inspect --compensation some " + file("gold.mtlx")), 0);
}

// Light below a surface is followed where there is a below, if that is asked for.
TEST_F(NotRendered, SubsurfaceOfWhatIsNoSolid) {
  const std::string flesh = material("open_pbr_surface", input("subsurface_weight", "float", "1"));
  write("a.mtlx", std::string(head) + flesh + "</materialx>");
  const std::string ball = "render --no-cache --spp 1 --size 4 --out " + file("a.png") + " ";
  EXPECT_EQ(run(ball + file("a.mtlx")), 0);
  EXPECT_EQ(errors_, "");
  EXPECT_EQ(run(ball + "--subsurface diffuse " + file("a.mtlx")), 0);
  EXPECT_EQ(count("not-modelled"), 1u) << errors_;
  EXPECT_EQ(render(flesh), 0);  // On a card.
  EXPECT_EQ(count("not-modelled"), 1u) << errors_;
}

// A volume has an inside, which a card has not.
TEST_F(NotRendered, VolumesOfWhatIsNoSolid) {
  const std::string smoke = R"(
    <noise3d name="n" type="vector3"><input name="pivot" type="float" value="1"/></noise3d>
    <anisotropic_vdf name="v" type="VDF">
      <input name="scattering" type="vector3" nodename="n"/></anisotropic_vdf>
    <volume name="S" type="volumeshader"><input name="vdf" type="VDF" nodename="v"/></volume>
    <volumematerial name="M" type="material">
      <input name="volumeshader" type="volumeshader" nodename="S"/></volumematerial>)";
  write("a.mtlx", std::string(head) + smoke + "</materialx>");
  const std::string ball = "render --no-cache --spp 1 --size 4 --out " + file("a.png") + " ";
  EXPECT_EQ(run(ball + file("a.mtlx")), 0);
  EXPECT_EQ(errors_, "");
  EXPECT_EQ(render(smoke), 0);
  EXPECT_EQ(count("open-solid"), 1u) << errors_;
}

TEST_F(NotRendered, InputsThatTheModelItselfDoesNotRead) {
  EXPECT_EQ(render(material("standard_surface", input("transmission_depth", "float", "0.0"))), 0);
  EXPECT_EQ(errors_, "");  // The default, however it is written.
  EXPECT_EQ(render(material("standard_surface", input("transmission_depth", "float", "2"))), 0);
  EXPECT_EQ(count("input-not-rendered"), 1u) << errors_;
  EXPECT_NE(errors_.find("(S/transmission_depth)"), errors_.npos) << errors_;
}

TEST_F(NotRendered, DisplacementAndLights) {
  const std::string both = R"(
    <standard_surface name="S" type="surfaceshader"/>
    <displacement name="D" type="displacementshader">
      <input name="displacement" type="float" value="0.1"/>
    </displacement>
    <uniform_edf name="e" type="EDF"/>
    <light name="L" type="lightshader"><input name="edf" type="EDF" nodename="e"/></light>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/>
      <input name="displacementshader" type="displacementshader" nodename="D"/>
    </surfacematerial>)";
  EXPECT_EQ(render(both), 0);
  EXPECT_EQ(count("displacement-not-rendered"), 0u) << errors_;
  EXPECT_EQ(render(both, "--dice 0"), 0);
  EXPECT_EQ(count("displacement-not-rendered"), 1u) << errors_;
  EXPECT_EQ(count("light-without-place"), 1u) << errors_;
  EXPECT_NE(errors_.find("(L)"), errors_.npos) << errors_;
}

TEST_F(NotRendered, VertexAttributesThatAreMissing) {
  const auto graph = [](std::string_view node) {
    return std::string(node) + R"(<standard_surface name="S" type="surfaceshader">
      <input name="base_color" type="color3" nodename="c"/></standard_surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>)";
  };
  EXPECT_EQ(render(graph(R"(<geomcolor name="c" type="color3"/>)")), 0);
  EXPECT_EQ(count("missing-attribute"), 1u) << errors_;
  EXPECT_NE(errors_.find("color0"), errors_.npos) << errors_;
  EXPECT_EQ(render(graph(R"(<texcoord name="t" type="vector2"/>
    <checkerboard name="c" type="color3">
      <input name="texcoord" type="vector2" nodename="t"/></checkerboard>)")),
            0);
  EXPECT_EQ(count("missing-attribute"), 1u) << errors_;
  EXPECT_NE(errors_.find("texture coordinates"), errors_.npos) << errors_;
  EXPECT_NE(errors_.find("(card)"), errors_.npos) << errors_;
}

TEST_F(NotRendered, AssignmentsThatAreOnNothing) {
  const std::string two = material("standard_surface", "") +
                          R"(<surfacematerial name="N" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>)";
  EXPECT_EQ(render(two, "--material N"), 0);
  EXPECT_EQ(errors_, "");
  EXPECT_EQ(render(two), 0);
  EXPECT_EQ(count("first-material"), 1u) << errors_;
  EXPECT_EQ(render(two, "--assign card=N"), 0);
  EXPECT_EQ(errors_, "");
  EXPECT_EQ(render(two, "--assign care=N"), 1);
  EXPECT_EQ(count("unmatched-assign"), 1u) << errors_;
  EXPECT_NE(errors_.find("one of card"), errors_.npos) << errors_;
  EXPECT_EQ(render(two + R"(<look name="l">
      <materialassign name="a" material="N" geom="/car"/></look>)"),
            0);
  EXPECT_EQ(count("unmatched-assignment"), 1u) << errors_;
  EXPECT_EQ(count("first-material"), 1u) << errors_;
}

TEST_F(NotRendered, WhyAMaterialIsNotThere) {
  EXPECT_EQ(render(material("standard_surface", ""), "--material S"), 1);
  EXPECT_EQ(count("unknown-material"), 1u) << errors_;
  EXPECT_EQ(count("not-a-material"), 1u) << errors_;
  EXPECT_NE(errors_.find("a standard_surface of type surfaceshader"), errors_.npos) << errors_;
  EXPECT_EQ(render(material("standard_surface", "") + R"(<surfacematerial name="X">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>)",
                   "--material X"),
            1);
  EXPECT_EQ(count("unknown-material"), 1u) << errors_;
  EXPECT_NE(errors_.find("(X)"), errors_.npos) << errors_;
}

TEST_F(NotRendered, WhereThePictureGoesIsSeenFirst) {
  namespace fs = std::filesystem;
  const std::string document = material("standard_surface", "");
  EXPECT_EQ(render_to(file("new/folder/a.png"), document, "--size 4"), 0) << errors_;
  EXPECT_TRUE(fs::exists(file("new/folder/a.png")));
  // A render of these would take hours.
  const std::string long_one = "--size 4096 --spp 100000";
  const auto start = std::chrono::steady_clock::now();
  write("plain", "");
  for (const std::string& out : {file("plain/a.png"), folder_.path().string(), file("a.bmp"),
                                 std::string("/proc/self/a.png")}) {
    EXPECT_EQ(render_to(out, document, long_one), 1) << out;
    EXPECT_EQ(count("cannot-write") + count("unknown-image-format"), 1u) << errors_;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::minutes(2));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".nacre")) << entry.path();
  }
}

TEST_F(NotRendered, NumbersThatCannotBeAreShortAnswers) {
  for (const char* flag :
       {"--spp 0", "--spp -1", "--lens-radius inf", "--lens-radius nan", "--lens-radius -1",
        "--focus-distance inf", "--exposure nan", "--environment-scale -inf", "--time inf",
        "--max-depth -1", "--max-nodes -1", "--max-meshes -1", "--environment-rotation 1e30"}) {
    EXPECT_EQ(render(material("standard_surface", ""), flag), 2) << flag;
    EXPECT_LT(errors_.size(), 160u) << errors_;
  }
}

}  // namespace
}  // namespace nacre
