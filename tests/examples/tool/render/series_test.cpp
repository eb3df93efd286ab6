// `nacre render` of several cameras and frames: each picture is that of a run of its own.
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_process.h"

namespace nacre {
namespace {

/// A card that walks along x by its first animation, and up by its second, from 0 s to 2 s.
constexpr std::string_view scene = R"({
  "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1, 2, 3]}],
  "nodes": [{"name": "card", "mesh": 0},
            {"name": "ground", "mesh": 1, "translation": [0, -1, 0]},
            {"name": "Left", "camera": 0, "translation": [-0.5, 0.1, 6]},
            {"name": "Right/top", "camera": 0, "translation": [0.5, 0.6, 6]}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]},
             {"primitives": [{"attributes": {"POSITION": 0}}]}],
  "animations": [
    {"name": "walk", "samplers": [{"input": 1, "output": 2}],
     "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]},
    {"name": "rise", "samplers": [{"input": 1, "output": 3}],
     "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
  "buffers": [{"byteLength": 128, "uri": "a.bin"}],
  "bufferViews": [{"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 8},
                  {"buffer": 0, "byteOffset": 80, "byteLength": 24},
                  {"buffer": 0, "byteOffset": 104, "byteLength": 24}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR"},
                {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"},
                {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}]
})";

std::string scene_data() {
  const float numbers[] = {-0.5f, -0.5f, 0,    0.5f, -0.5f, 0,    0.5f, 0.5f, 0, -0.5f, -0.5f,
                           0,     0.5f,  0.5f, 0,    -0.5f, 0.5f, 0,    0,    2, 0,     0,
                           0,     2,     0,    0,    0,     0,    0,    0,    2, 0};
  std::string data(sizeof numbers, '\0');
  std::memcpy(data.data(), numbers, sizeof numbers);
  return data;
}

class Series : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    write("a.bin", scene_data());
    write("a.gltf", scene);
    // Whose colour goes with time and whose surface with the frame, pushed in or out by it.
    write("a.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">
      <time name="t" type="float"/><frame name="f" type="float"/>
      <combine3 name="c" type="color3"><input name="in1" type="float" nodename="t"/>
        <input name="in2" type="float" value="0.5"/></combine3>
      <position name="p" type="vector3"/>
      <noise3d name="n" type="float"><input name="position" type="vector3" nodename="p"/></noise3d>
      <multiply name="d" type="float"><input name="in1" type="float" nodename="n"/>
        <input name="in2" type="float" nodename="f"/></multiply>
      <displacement name="D" type="displacementshader">
        <input name="displacement" type="float" nodename="d"/>
        <input name="scale" type="float" value="0.05"/></displacement>
      <oren_nayar_diffuse_bsdf name="b" type="BSDF">
        <input name="color" type="color3" nodename="c"/></oren_nayar_diffuse_bsdf>
      <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
      <surfacematerial name="Bent" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/>
        <input name="displacementshader" type="displacementshader" nodename="D"/></surfacematerial>
    </materialx>)");
  }

  std::string asked(const std::string& more, const std::string& out) const {
    return "render " + file("a.mtlx") + " --scene " + file("a.gltf") + " --size 32x24 --spp 4 " +
           more + " --out " + file(out);
  }
  std::string bytes(const std::string& name) const { return text_of(file(name)); }
};

TEST_F(Series, CamerasSeeWhatEachSeesAlone) {
  for (const std::string material : {"--material M ", "--material Bent "}) {
    ASSERT_EQ(run(asked(material + "--camera Left", "l.exr")), 0) << errors_;
    EXPECT_EQ(errors_.find("several-cameras"), std::string::npos) << errors_;
    ASSERT_EQ(run(asked(material + "--camera Right/top", "r.exr")), 0) << errors_;
    ASSERT_EQ(run(asked(material + "--json --camera all", "of_{camera}.exr")), 0) << errors_;
    const auto pictures = nlohmann::json::parse(printed_)["pictures"];
    ASSERT_EQ(pictures.size(), 2u);
    EXPECT_EQ(pictures[1]["camera"], "Right/top");
    EXPECT_EQ(pictures[1]["file"], file("of_Right.top.exr"));
    EXPECT_EQ(bytes("of_Left.exr"), bytes("l.exr"));
    EXPECT_EQ(bytes("of_Right.top.exr"), bytes("r.exr"));
    EXPECT_NE(bytes("l.exr"), bytes("r.exr"));
  }
  // In the order that is asked for, once each; nobody's choice is the first.
  ASSERT_EQ(run(asked("--json --camera Right/top,Left,Left", "{camera}.exr")), 0) << errors_;
  EXPECT_EQ(nlohmann::json::parse(printed_)["pictures"][0]["camera"], "Right/top");
  ASSERT_EQ(run(asked("--material M", "a.exr")), 0) << errors_;
  EXPECT_TRUE(says("[several-cameras]") && says("'Left', 'Right/top'")) << errors_;
}

TEST_F(Series, FramesAreThoseOfTheirTime) {
  const std::string time = "--animation 0 --camera Left --fps 4 --shutter 0 0.1 ";
  for (const std::string material : {"--material M ", "--material Bent "}) {
    ASSERT_EQ(run(asked(material + time + "--frame 1 --time 0.5", "one.exr")), 0) << errors_;
    ASSERT_EQ(run(asked(material + time + "--frame 5 --time 1.5", "five.exr")), 0) << errors_;
    ASSERT_EQ(run(asked(material + time + "--time 0.25 --frames 1-5x4", "a.###.exr")), 0)
        << errors_;
    EXPECT_EQ(printed_, file("a.001.exr") + '\n' + file("a.005.exr") + '\n');
    EXPECT_EQ(bytes("a.001.exr"), bytes("one.exr"));
    EXPECT_EQ(bytes("a.005.exr"), bytes("five.exr"));
    EXPECT_NE(bytes("one.exr"), bytes("five.exr"));
  }
}

// Its images are those of the frame.
TEST_F(Series, FramesHaveTheirOwnImages) {
  for (const std::string number : {"7", "8"}) {
    ASSERT_EQ(shell(std::string("oiiotool --pattern constant:color=") +
                    (number == "7" ? "1,0,0" : "0,0,1") + " 4x4 3 -o " +
                    file("image." + number + ".exr")),
              0);
  }
  write("a.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">
    <image name="c" type="color3"><input name="file" type="filename" value="image.{frame}.exr"/></image>
    <surface_unlit name="s" type="surfaceshader">
      <input name="emission_color" type="color3" nodename="c"/></surface_unlit>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
  </materialx>)");
  ASSERT_EQ(run(asked("--animation walk --camera Left --frames 7,8", "{frame}.exr")), 0) << errors_;
  for (const std::string frame : {"7", "8"}) {
    ASSERT_EQ(run(asked("--animation walk --camera Left --frame " + frame + " --time " +
                            (frame == "7" ? "0.29166666" : "0.33333334"),
                        "alone.exr")),
              0)
        << errors_;
    EXPECT_EQ(bytes(frame + ".exr"), bytes("alone.exr"));
  }
}

TEST_F(Series, AnimationsAreChosen) {
  const auto picture = [&](const std::string& more) {
    EXPECT_EQ(run(asked("--material M --camera Left --time 1 " + more, "a.exr")), 0) << errors_;
    return bytes("a.exr");
  };
  const std::string walk = picture("--animation walk"), rise = picture("--animation rise");
  EXPECT_NE(walk, rise);
  EXPECT_EQ(picture("--animation 1"), rise);
  EXPECT_FALSE(says("several-animations"));
  EXPECT_EQ(picture(""), walk);
  EXPECT_TRUE(says("[several-animations]") && says("0 'walk', 1 'rise'")) << errors_;
  EXPECT_EQ(run(asked("--animation wlak", "b.exr")), 1);
  EXPECT_TRUE(says("[unknown-animation]") && says("did you mean 'walk'?")) << errors_;
  EXPECT_EQ(run(asked("--animation 2", "b.exr")), 1);
}

TEST_F(Series, WhatIsThereIsLeftOut) {
  const std::string frames = "--animation rise --camera Left --material M --frames 1-3 ";
  ASSERT_EQ(run(asked(frames, "whole.#.exr")), 0) << errors_;
  write("a.2.exr", "mine");
  ASSERT_EQ(run(asked(frames + "--json --skip-existing", "a.#.exr")), 0) << errors_;
  EXPECT_TRUE(says(file("a.2.exr") + ": note") && says("[skipped]")) << errors_;
  EXPECT_EQ(bytes("a.2.exr"), "mine");
  EXPECT_EQ(bytes("a.1.exr"), bytes("whole.1.exr"));
  EXPECT_EQ(bytes("a.3.exr"), bytes("whole.3.exr"));
  ASSERT_EQ(run(asked(frames, "a.#.exr")), 0) << errors_;
  EXPECT_EQ(bytes("a.2.exr"), bytes("whole.2.exr"));
}

// Killed again and again: what is there is whole, and what is not goes on.
TEST_F(Series, KilledOnesGoOn) {
  const auto arguments = [&](const std::string& out) {
    return std::vector<std::string>{
        "render",   file("a.mtlx"), "--scene",     file("a.gltf"), "--material", "M",
        "--size",   "64",           "--spp",       "256",          "--camera",   "Left",
        "--frames", "1-4",          "--animation", "walk",         "--out",      file(out)};
  };
  ASSERT_EQ(Process(arguments("whole.#.exr"), file("stderr")).wait(), 0) << bytes("stderr");
  auto resumed = arguments("a.#.exr");
  for (const std::string& each :
       {std::string("--skip-existing"), std::string("--checkpoint"), file("a.checkpoint"),
        std::string("--checkpoint-every"), std::string("0.05")}) {
    resumed.push_back(each);
  }
  int killed = 0;
  for (int k = 0; k < 6; ++k) {
    const Process process(resumed, file("stderr"));
    ::usleep(300'000 + 150'000 * static_cast<unsigned>(k));
    process.send(SIGKILL);
    killed += WIFSIGNALED(process.wait());
    for (const char* frame : {"1", "2", "3", "4"}) {
      const std::string name = std::string("a.") + frame + ".exr";
      if (!std::filesystem::exists(file(name))) continue;
      EXPECT_EQ(bytes(name), bytes(std::string("whole.") + frame + ".exr"));
    }
  }
  EXPECT_GT(killed, 0);
  ASSERT_EQ(Process(resumed, file("stderr")).wait(), 0) << bytes("stderr");
  for (const char* frame : {"1", "2", "3", "4"}) {
    EXPECT_EQ(bytes(std::string("a.") + frame + ".exr"),
              bytes(std::string("whole.") + frame + ".exr"));
  }
  EXPECT_FALSE(std::filesystem::exists(file("a.checkpoint")));
}

TEST_F(Series, WhatThereIsNotIsAnError) {
  EXPECT_EQ(run(asked("--camera left", "a.exr")), 1);
  EXPECT_TRUE(says("[unknown-camera]") && says("'Left', 'Right/top' or all") &&
              says("it differs only in case from 'Left'"))
      << errors_;
  EXPECT_EQ(run("render " + file("a.mtlx") + " --camera main --out " + file("a.exr")), 1);
  for (const char* frames : {"", "x", "3-1", "1-", "1-5x0", "1,,2", "1-2x", "0-2000000", "1x2"}) {
    EXPECT_EQ(run(asked("--frames '" + std::string(frames) + "'", "#.exr")), 2) << frames;
    EXPECT_TRUE(says("[bad-frames]") || says("--frames")) << errors_;
  }
  const std::string several[] = {asked("--frames 1-2", "a.exr"), asked("--camera all", "a.exr"),
                                 asked("--camera all --frames 1-2", "{camera}.exr")};
  for (const std::string& command : several) {
    EXPECT_EQ(run(command), 2);
    EXPECT_TRUE(says("[one-name]")) << errors_;
  }
  EXPECT_EQ(run(asked("--frames 1-2 --checkpoint a", "#.exr")), 2);
  EXPECT_TRUE(says("--skip-existing")) << errors_;
  EXPECT_EQ(run(asked("--frames 1-2 --frame 3", "#.exr")), 2);
  EXPECT_EQ(run(asked("--frames 1-2 --fps 0", "#.exr")), 2);
  EXPECT_FALSE(std::filesystem::exists(file("a.exr")));
}

}  // namespace
}  // namespace nacre
