// What the tool says to programs: --json, --warnings-as-errors, and what is wrong with a command
// line.
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

using Json = nlohmann::json;

constexpr const char* whole = R"(<materialx version="1.39">
  <nodegraph name="G">
    <constant name="c" type="color3"><input name="value" type="color3" value="1, 0.5, 0"/></constant>
    <output name="o" type="color3" nodename="c"/>
  </nodegraph>
  <standard_surface name="SR" type="surfaceshader"/>
  <surfacematerial name="Gold" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR"/>
  </surfacematerial>
</materialx>)";

/// A warning, where the tool is as lenient as MaterialX.
constexpr const char* doubtful = R"(<materialx version="1.39">
  <constant name="c" type="float"><input name="valeu" type="float" value="1"/></constant>
  <output name="o" type="float" nodename="c"/>
</materialx>)";

constexpr const char* wrong = R"(<materialx version="1.39">
  <constnat name="c" type="float"/>
  <output name="o" type="float" nodename="c"/>
</materialx>)";

class Report : public Tool {
 protected:
  /// Standard error, a JSON object a line.
  std::vector<Json> said() const {
    std::vector<Json> lines;
    std::istringstream stream(errors_);
    for (std::string line; std::getline(stream, line);) {
      const Json one = Json::parse(line, nullptr, false);
      EXPECT_TRUE(one.is_object()) << line;
      if (one.is_object()) lines.push_back(one);
    }
    return lines;
  }

  /// All of standard output.
  Json answer() const {
    const Json document = Json::parse(printed_, nullptr, false);
    EXPECT_FALSE(document.is_discarded()) << printed_;
    return document;
  }

  /// Each command that answers programs, on a document.
  std::vector<std::string> commands(const std::string& mtlx) const {
    return {"bake " + mtlx + " --size 4 --out " + file("out"),
            "check " + mtlx,
            "convert " + mtlx + " --out " + file("converted.mtlx"),
            "inspect --no-cache " + mtlx,
            "render " + mtlx + " --size 8 --spp 1 --out " + file("out.png"),
            "tune --no-times --no-cache --points 1000 " + mtlx};
  }
};

TEST_F(Report, StandardOutputIsOneDocument) {
  for (const std::string& command : commands(write("a.mtlx", whole))) {
    EXPECT_EQ(run(command + " --json"), 0) << command << errors_;
    EXPECT_EQ(errors_, "") << command;
    EXPECT_TRUE(answer().is_structured()) << command;
  }
}

TEST_F(Report, SoItIsOfWhatFails) {
  for (const char* text : {wrong, "<materialx"}) {
    for (const std::string& command : commands(write("a.mtlx", text))) {
      // What neither a conversion nor a picture needs may be wrong.
      const bool needs_nodes = !command.starts_with("convert") && !command.starts_with("render");
      if (text == wrong && !needs_nodes) continue;
      EXPECT_EQ(run(command + " --json"), 1) << command;
      EXPECT_TRUE(answer().is_structured()) << command;
      ASSERT_FALSE(said().empty()) << command;
      EXPECT_EQ(said().front()["severity"], "error") << command;
    }
  }
}

TEST_F(Report, SaysWhereWhatAndWhatWasMeant) {
  const std::string mtlx = write("a.mtlx", wrong);
  EXPECT_EQ(run("bake --json " + mtlx + " --out " + file("out")), 1);
  ASSERT_EQ(said().size(), 1u) << errors_;
  const Json one = said().front();
  EXPECT_EQ(one["severity"], "error");
  EXPECT_EQ(one["code"], "unknown-node");
  EXPECT_EQ(one["file"], mtlx);
  EXPECT_EQ(one["line"], 2);
  EXPECT_EQ(one["column"], 4);
  EXPECT_EQ(one["path"], "c");
  EXPECT_EQ(one["found"], "<constnat>");
  EXPECT_EQ(one["hint"], "did you mean 'constant'?");
  // What is not known is not there; the whole is what people read.
  EXPECT_EQ(run("bake " + mtlx + " --out " + file("out")), 1);
  EXPECT_EQ(one["text"].get<std::string>() + '\n', errors_);
  EXPECT_EQ(run("render --json --aov nothing --out a.exr " + mtlx), 2);
  EXPECT_FALSE(said().front().contains("line")) << errors_;
}

TEST_F(Report, CheckAnswersWithWhatIsWrong) {
  EXPECT_EQ(run("check --json " + write("a.mtlx", doubtful)), 1);
  Json found = answer();
  EXPECT_EQ(found["ok"], false);
  EXPECT_EQ(found["errors"], 0);
  EXPECT_EQ(found["warnings"], 1);
  ASSERT_EQ(found["diagnostics"].size(), 1u);
  EXPECT_EQ(found["diagnostics"][0]["code"], "unknown-input");
  EXPECT_EQ(run("check --json --strict " + file("a.mtlx")), 1);
  EXPECT_EQ(answer()["errors"], 1);
  EXPECT_EQ(run("check --json " + write("b.mtlx", whole)), 0);
  EXPECT_EQ(answer()["ok"], true);
}

TEST_F(Report, ConvertAndRenderSayWhatTheyWrote) {
  const std::string mtlx = write("a.mtlx", whole);
  EXPECT_EQ(run("convert --json " + mtlx + " --out " + file("b.mtlx")), 0);
  EXPECT_EQ(answer()["file"], file("b.mtlx"));
  EXPECT_EQ(answer()["written"], true);
  EXPECT_EQ(run("convert --json " + mtlx + " --out " + file("a.mtlx/b.mtlx")), 1);
  EXPECT_EQ(answer()["written"], false);
  EXPECT_EQ(
      run("render --json " + mtlx + " --size 8x4 --spp 2 --out " + file("a.exr") + " --aov albedo"),
      0)
      << errors_;
  const Json picture = answer();
  EXPECT_EQ(picture["file"], file("a.exr"));
  EXPECT_EQ(picture["width"], 8);
  EXPECT_EQ(picture["height"], 4);
  EXPECT_EQ(picture["passes"], Json({"albedo"}));
  EXPECT_EQ(picture["samples"]["least"], 2);
  EXPECT_EQ(picture["samples"]["whole"], true);
  EXPECT_EQ(picture["paths"], 8 * 4 * 2);
}

TEST_F(Report, WarningsMayBeErrors) {
  const std::string mtlx = write("a.mtlx", doubtful);
  const std::string bake = "bake " + mtlx + " --size 4 --out " + file("out");
  EXPECT_EQ(run(bake), 0) << errors_;
  EXPECT_EQ(run(bake + " --warnings-as-errors"), 1);
  EXPECT_TRUE(says("warnings count as errors here")) << errors_;
  EXPECT_TRUE(std::filesystem::exists(file("out/o.exr")));  // What was made is there.
  EXPECT_EQ(run(bake + " --warnings-as-errors --json"), 1);
  EXPECT_EQ(said().back()["code"], "warnings-as-errors");
  EXPECT_EQ(run("inspect --no-cache --warnings-as-errors " + mtlx), 1);
  // Where there is none nothing changes.
  const std::string clean = write("b.mtlx", whole);
  for (const std::string& command : commands(clean)) {
    EXPECT_EQ(run(command + " --warnings-as-errors"), 0) << command << errors_;
  }
}

TEST_F(Report, LenientIsTheOppositeOfStrict) {
  const std::string mtlx = write("a.mtlx", doubtful);
  const std::string bake = "bake " + mtlx + " --size 4 --out " + file("out");
  EXPECT_EQ(run(bake + " --lenient"), 0) << errors_;
  EXPECT_EQ(run(bake + " --strict"), 1);
  EXPECT_EQ(run(bake + " --strict --lenient"), 2);
}

TEST_F(Report, CommandLinesThatMeanNothing) {
  EXPECT_EQ(run("bkae a.mtlx --size 4"), 2);
  EXPECT_TRUE(says("nacre has no command 'bkae'; did you mean 'bake'? [usage]")) << errors_;
  EXPECT_TRUE(says("See: nacre --help")) << errors_;
  EXPECT_EQ(run("Bake a.mtlx"), 2);
  EXPECT_TRUE(says("it differs only in case from 'bake'")) << errors_;
  EXPECT_EQ(run("bake a.mtlx --siez=4"), 2);
  EXPECT_TRUE(says("nacre bake has no option --siez; did you mean '--size'?")) << errors_;
  EXPECT_TRUE(says("See: nacre bake --help")) << errors_;
  // Not that the one that was meant is missing.
  EXPECT_EQ(run("convert a.mtlx --uot b.mtlx"), 2);
  EXPECT_TRUE(says("nacre convert has no option --uot; did you mean '--out'?")) << errors_;
  EXPECT_EQ(run("bake a.mtlx --format pgn"), 2);
  EXPECT_TRUE(says("pgn not in") && says("did you mean 'png'?")) << errors_;
  EXPECT_EQ(run("check a.mtlx b.mtlx"), 2);
  EXPECT_TRUE(says("nacre check takes no further 'b.mtlx'")) << errors_;
  EXPECT_EQ(run(""), 2);
  EXPECT_TRUE(says("a command is missing; expected one of bake, check")) << errors_;
  EXPECT_EQ(run("bake"), 2);
  EXPECT_TRUE(says("FILE is required")) << errors_;
  EXPECT_EQ(run("bake --json a.mtlx --siez 4"), 2);
  EXPECT_EQ(printed_, "");
  EXPECT_EQ(said().front()["hint"], "did you mean '--size'?") << errors_;
}

TEST_F(Report, OptionsThatChangeNothing) {
  const std::string render =
      "render " NACRE_SOURCE_DIR "/examples/documents/brass.mtlx --size 8 --spp 1 --out ";
  struct Row {
    const char *out, *options, *code;
  };
  const std::vector<Row> rows{
      {"a.exr", "--exposure 1", "--exposure changes nothing here"},
      {"a.png", "--exposure 1", ""},
      {"a.exr", "--white 2", "--white changes nothing here"},
      {"a.png", "--half", "--half changes nothing here"},
      {"a.exr", "--half", ""},
      {"a.exr", "--fps 30", "--fps changes nothing here"},
      {"a.exr", "--fps 30 --shutter 0 1", ""},
      {"a.exr", "--fps 30 --shutter 0.5 0.5", ""},
      {"a.#.exr", "--fps 30 --frames 1", ""},
      {"a.exr", "--roulette none --roulette-depth 2", "--roulette-depth changes nothing here"}};
  for (const Row& row : rows) {
    const std::string line = render + file(row.out) + ' ' + row.options;
    const bool is_said = *row.code != '\0';
    EXPECT_EQ(run(line + " --warnings-as-errors"), is_said ? 1 : 0) << line << errors_;
    EXPECT_EQ(says("no-effect"), is_said) << line << errors_;
    EXPECT_TRUE(says(row.code)) << line << errors_;
  }
  for (const char* alone : {"--focus-distance 3", "--checkpoint-every 3"}) {
    EXPECT_EQ(run(render + file("a.exr") + ' ' + alone), 2) << alone << errors_;
  }
  EXPECT_EQ(run("bake a.mtlx --clip"), 2);
  EXPECT_TRUE(says("--clip requires --document")) << errors_;
  EXPECT_EQ(run("inspect a.mtlx --recorded p.json"), 2);
}

TEST_F(Report, NamesThatThereAreNot) {
  const std::string mtlx = write("a.mtlx", whole);
  const std::string render = "render --size 8 --spp 1 --out " + file("a.exr") + " " + mtlx;
  EXPECT_EQ(run(render + " --material gold"), 1);
  EXPECT_TRUE(says("it differs only in case from 'Gold'")) << errors_;
  EXPECT_EQ(run(render + " --aov albdeo"), 2);
  EXPECT_TRUE(says("did you mean 'albedo'?")) << errors_;
  EXPECT_EQ(run("bake " + mtlx + " --output G/0 --out " + file("out")), 1);
  EXPECT_TRUE(says("did you mean 'G/o'?")) << errors_;
  EXPECT_EQ(run("bake " + mtlx + " --material Godl --out " + file("out")), 1);
  EXPECT_TRUE(says("did you mean 'Gold'?")) << errors_;
  EXPECT_EQ(run("check " + mtlx + " --lobe dielectric_bdsf"), 1);
  EXPECT_TRUE(says("did you mean 'dielectric_bsdf'?")) << errors_;
}

}  // namespace
}  // namespace nacre
