// Where files land and how they are named, what flags and documents say of tiles, what
// `inspect` prints, and that errors name the file.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

std::string graph(const std::string& content) {
  return "<materialx version=\"1.39\"><nodegraph name=\"G\">\n" + content +
         "</nodegraph></materialx>";
}

std::string output(const std::string& name) {
  return "<output name=\"" + name + "\" type=\"color3\" nodename=\"n\"/>";
}

const std::string noise = "<noise2d name=\"n\" type=\"color3\"/>";

/// A material of which one output feeds two inputs.
const std::string material = R"(<materialx version="1.39"><nodegraph name="G">
    <noise2d name="n" type="color3"/><output name="o" type="color3" nodename="n"/>
  </nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="G" output="o"/>
    <input name="specular_color" type="color3" nodegraph="G" output="o"/>
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/>
  </surfacematerial></materialx>)";

class Outputs : public Tool {
 protected:
  int bake(const std::string& text, const std::string& options) {
    write("a.mtlx", text);
    const std::string size = options.find("--size") == std::string::npos ? " --size 4 " : " ";
    return run("bake " + file("a.mtlx") + " --no-cache" + size + options);
  }
  std::size_t lines_printed() const {
    return static_cast<std::size_t>(std::count(printed_.begin(), printed_.end(), '\n'));
  }
};

TEST_F(Outputs, FoldersAreMadeAndTexturesLieBesideTheirDocument) {
  write("a.mtlx", material);
  EXPECT_EQ(shell("mkdir " + file("here") + "; cd " + file("here") + "; $NACRE bake " +
                  file("a.mtlx") + " --no-cache --size 4 --document " + file("new/deep/b.mtlx")),
            0)
      << errors_;
  EXPECT_EQ(names_in(file("here")), std::set<std::string>{});
  EXPECT_EQ(names_in(file("new/deep")), (std::set<std::string>{"S.base_color.exr", "b.mtlx"}));
  EXPECT_EQ(run("convert " + file("a.mtlx") + " --out " + file("other/c.mtlx")), 0) << errors_;
}

TEST_F(Outputs, WhatCannotBeWrittenIsSaidBeforeTheWork) {
  write("file", "");
  fs::create_directories(file("folder.mtlx"));
  // With this many texels the bake itself would take minutes.
  const std::string large = "--backend reference --size 32768 ";
  EXPECT_EQ(bake(material, large + "--document " + file("file/b.mtlx")), 1);
  EXPECT_TRUE(says("file/b.mtlx") || says(file("file"))) << errors_;
  EXPECT_TRUE(says("[cannot-write]")) << errors_;
  EXPECT_EQ(bake(material, large + "--document " + file("folder.mtlx")), 1);
  EXPECT_TRUE(says("there is a folder of that name")) << errors_;
  EXPECT_EQ(bake(material, large + "--out " + file("file")), 1);
  EXPECT_TRUE(says("[cannot-write]")) << errors_;
  fs::create_directories(file("out/G.o.exr"));
  EXPECT_EQ(bake(material, large + "--out " + file("out")), 1);
  EXPECT_TRUE(says("there is a folder of that name")) << errors_;
  // A device stays one, even for root.
  EXPECT_EQ(run("convert " + file("a.mtlx") + " --out /dev/null"), 1);
  EXPECT_TRUE(says("no regular file")) << errors_;
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Outputs, TheDocumentReadIsNotReplaced) {
  EXPECT_EQ(bake(material, "--document " + file("a.mtlx")), 1);
  EXPECT_TRUE(says("[output-is-input]")) << errors_;
  EXPECT_EQ(text_of(file("a.mtlx")), material);
}

TEST_F(Outputs, OneOutputIsWrittenOnceWhateverItFeeds) {
  EXPECT_EQ(bake(material, "--material M --out " + file("one")), 0) << errors_;
  EXPECT_EQ(lines_printed(), 1u) << printed_;
  EXPECT_EQ(bake(material, "--output G/o --output G/o --out " + file("one")), 0);
  EXPECT_EQ(lines_printed(), 1u) << printed_;
  EXPECT_EQ(bake(material, "--document " + file("b.mtlx") + " --out " + file("two")), 0) << errors_;
  EXPECT_EQ(names_in(file("two")), std::set<std::string>{"S.base_color.exr"});
  // Both inputs have it.
  const auto baked = read(file("b.mtlx"));
  ASSERT_NE(baked, nullptr);
  EXPECT_EQ(values(*baked, "NG_baked_S/base_color_output", 4),
            values(*baked, "NG_baked_S/specular_color_output", 4));
}

/// A material of values alone has no textures: exit status 0 would say that they are there.
TEST_F(Outputs, AMaterialThatNoGraphFeedsIsAnError) {
  std::string plain = material;
  const std::string link = "nodegraph=\"G\" output=\"o\"";
  for (std::size_t at; (at = plain.find(link)) != std::string::npos;) {
    plain.replace(at, link.size(), "value=\"1, 0, 0\"");
  }
  EXPECT_EQ(bake(plain, "--material M --out " + file("out")), 1);
  EXPECT_TRUE(says("[nothing-to-bake]") && says("'M'")) << errors_;
  EXPECT_FALSE(fs::exists(file("out")));
}

TEST_F(Outputs, NoDocumentChoosesWhereFilesLand) {
  const std::string out = "--out " + file("deep/out");
  for (const std::string name : {"../../x", "a&#10;b", ".hidden", "/tmp/x"}) {
    EXPECT_EQ(bake(graph(noise + output(name)), out), 1) << name;
    EXPECT_TRUE(says("[invalid-name]")) << errors_;
  }
  EXPECT_EQ(names_in(file("deep/out")), std::set<std::string>{});
  EXPECT_EQ(bake(graph(noise + output(std::string(300, 'y'))), out), 0) << errors_;
  EXPECT_EQ(names_in(file("deep")), std::set<std::string>{"out"});
  const std::set<std::string> names = names_in(file("deep/out"));
  ASSERT_EQ(names.size(), 1u);
  EXPECT_LE(names.begin()->size(), 220u);
}

TEST_F(Outputs, NamesThatFallTogetherGetNumbers) {
  const std::string text = "<materialx version=\"1.39\"><nodegraph name=\"G\">" + noise +
                           output("a:b") + "</nodegraph><nodegraph name=\"G:a\">" + noise +
                           output("b") + "</nodegraph></materialx>";
  EXPECT_EQ(bake(text, "--out " + file("out")), 0) << errors_;
  EXPECT_EQ(names_in(file("out")), (std::set<std::string>{"G.a.b.exr", "G.a.b_2.exr"}));
  EXPECT_TRUE(says("[name-taken]")) << errors_;
}

TEST_F(Outputs, TilesAreThoseOfTheDocument) {
  const std::string tiled =
      "<materialx version=\"1.39\"><geominfo name=\"i\" geom=\"/\"><geomprop name=\"udimset\" "
      "type=\"stringarray\" value=\"1001,1002\"/></geominfo><nodegraph name=\"G\">" +
      noise + output("o") + "</nodegraph></materialx>";
  const std::string out = " --out " + file("out");
  EXPECT_EQ(bake(tiled, "--udim 1001,1020" + out), 1);
  EXPECT_TRUE(says("expected 1001,1002, found 1020 [no-such-tile]")) << errors_;
  EXPECT_EQ(names_in(file("out")), std::set<std::string>{});
  EXPECT_EQ(bake(tiled, out), 0);
  EXPECT_TRUE(says("expected --udim auto, found 1001,1002 [udim-not-baked]")) << errors_;
  EXPECT_EQ(bake(tiled, "--udim auto" + out), 0);
  EXPECT_EQ(errors_, "");
  EXPECT_EQ(bake(graph(noise + output("o")), "--udim 1020" + out), 0);
  EXPECT_TRUE(says("[no-udim]")) << errors_;
  EXPECT_EQ(bake(graph(noise + output("o")), out), 0);
  EXPECT_EQ(errors_, "");
}

TEST_F(Outputs, ErrorsNameTheFile) {
  const std::string sines = graph(
      "<texcoord name=\"t\" type=\"vector2\"/><sin name=\"n\" "
      "type=\"vector2\"><input name=\"in\" type=\"vector2\" "
      "nodename=\"t\"/></sin><output name=\"o\" type=\"vector2\" "
      "nodename=\"n\"/>");
  const auto line_of = [&](std::string_view code) {
    const std::size_t at = errors_.find(code);
    if (at == std::string::npos) return std::string("nothing of ") + std::string(code);
    const std::size_t begin = errors_.rfind('\n', at) + 1;
    return errors_.substr(begin, at - begin);
  };
  const std::string out = " --out " + file("out");
  // Sines become polynomials: too large only when lowered.
  EXPECT_EQ(bake(sines, "--max-instructions 20" + out), 1);
  EXPECT_TRUE(line_of("[program-too-large]").starts_with(file("a.mtlx") + ":2:")) << errors_;
  EXPECT_EQ(bake(sines, "--wait-for-code --max-compile-time 0" + out), 0);
  EXPECT_TRUE(line_of("[compile-timeout]").starts_with(file("a.mtlx") + ":2:")) << errors_;
  EXPECT_EQ(bake(sines, "--udim 12" + out), 1);
  EXPECT_TRUE(line_of("[bad-udim]").starts_with(file("a.mtlx") + ":")) << errors_;
}

TEST_F(Outputs, InspectPrintsJsonForEveryDocument) {
  const auto inspect = [&](const std::string& text) {
    write("a.mtlx", text);
    run("inspect --json --live --no-cache " + file("a.mtlx"));
    return nlohmann::json::parse(printed_, nullptr, false);
  };
  const auto one = inspect(graph(noise + output("o")));
  ASSERT_TRUE(one.is_array()) << printed_;
  EXPECT_EQ(one.size(), 1u);
  for (const std::string& bad :
       {graph("<nothing name=\"n\" type=\"color3\"/>" + output("o")), std::string("no xml"),
        std::string("<materialx version=\"1.39\"/>")}) {
    const auto none = inspect(bad);
    ASSERT_TRUE(none.is_array()) << printed_;
    EXPECT_EQ(none.size(), 0u) << printed_;
  }
  EXPECT_TRUE(inspect(graph(noise + output("\xff\xfe"))).is_array()) << printed_;
  const auto infinite =
      inspect(graph("<constant name=\"n\" type=\"color3\"><input name=\"value\" "
                    "type=\"color3\" value=\"inf, nan, 1e999\"/></constant>" +
                    output("o")));
  EXPECT_TRUE(infinite.is_array()) << printed_;
}

TEST_F(Outputs, FlagsThatMeanNothingAreSaid) {
  const std::string text = graph(noise + output("o"));
  const std::string out = " --out " + file("out");
  for (const std::string flag : {"--frame nan", "--frame 1e30", "--time inf", "--time x"}) {
    EXPECT_EQ(bake(text, flag + out), 2) << flag;
    EXPECT_TRUE(says(flag.substr(0, flag.find(' ')))) << errors_;
  }
  EXPECT_EQ(bake(text, "--frame -3.5 --time 0.25" + out), 0) << errors_;
  EXPECT_EQ(bake(text, "--search-path " + file("nowhere") + out), 0);
  EXPECT_TRUE(says("[no-such-folder]")) << errors_;
  EXPECT_EQ(run("check " + folder_.path().string()), 1);
  EXPECT_TRUE(says("this is no regular file")) << errors_;
  // Help is for people: it prints, and prints no control characters.
  for (const std::string command : {"", "bake", "check", "convert", "inspect", "render"}) {
    EXPECT_EQ(run(command + " --help"), 0);
    EXPECT_EQ(std::count_if(printed_.begin(), printed_.end(),
                            [](char c) { return c >= 0 && c < ' ' && c != '\n'; }),
              0)
        << command;
  }
}

TEST_F(Outputs, CachesAreWhereTheySayAndBehindNoLink) {
  write("a.mtlx", graph(noise + output("o")));
  const std::string bake = "$NACRE bake " + file("a.mtlx") + " --size 4 --out " + file("out");
  // XDG Base Directory Specification 0.8: a relative value is ignored.
  EXPECT_EQ(shell("cd " + folder_.path().string() + "; HOME=" + file("home") +
                  " XDG_CACHE_HOME=relative " + bake),
            0)
      << errors_;
  EXPECT_FALSE(fs::exists(file("relative")));
  EXPECT_TRUE(fs::exists(file("home/.cache/nacre")));

  fs::create_directories(file("real"));
  fs::permissions(file("real"), fs::perms::owner_all);
  fs::create_directory_symlink(file("real"), file("link"));
  for (const std::string end : {"", "/", "//", "/.", "/./"}) {
    EXPECT_EQ(shell(bake + " --cache " + file("link") + end), 0);
    EXPECT_TRUE(says("[kernel-cache]")) << end << errors_;
  }
  EXPECT_TRUE(names_in(file("real")).empty());
  EXPECT_EQ(shell(bake + " --cache " + file("real") + "/"), 0);
  EXPECT_FALSE(names_in(file("real")).empty());
  EXPECT_EQ(errors_, "");
}

}  // namespace
}  // namespace nacre
