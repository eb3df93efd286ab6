// What a host may say of how documents are read and compiled.
#include <gtest/gtest.h>

#include <cmath>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

namespace nacre {
namespace {

/// Why there is no kernel for the output "out"; "" if there is one.
std::string fault_of(const std::string& text, const CompileOptions& options) {
  try {
    System().compile_outputs(Document::parse(text), {"out"}, options);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string image_of(const std::string& file, const std::string& more = "") {
  return R"(<materialx version="1.39">)" + more +
         R"(<image name="i" type="color3"><input name="file" type="filename" value=")" + file +
         R"("/></image><output name="out" type="color3" nodename="i"/></materialx>)";
}

TEST(ApiOptions, PartsOfFileNamesAreTheHosts) {
  CompileOptions options;
  options.names = {{"SHOT", "s12"}};
  EXPECT_NE(fault_of(image_of("a_{SHOT}_{TAKE}.png"), options).find("a_s12_{TAKE}.png"),
            std::string::npos);
}

TEST(ApiOptions, TokensAreThoseOfTheGeometry) {
  const std::string tokens = R"(<geominfo name="g" geom="/house/door">
    <token name="asset" type="string" value="oak"/></geominfo>)";
  CompileOptions options;
  options.geometry = "/house/door/knob";
  EXPECT_NE(fault_of(image_of("&lt;asset&gt;.png", tokens), options).find("oak.png"),
            std::string::npos);
  options.geometry = "/garden";
  EXPECT_EQ(fault_of(image_of("&lt;asset&gt;.png", tokens), options).find("oak.png"),
            std::string::npos);
}

TEST(ApiOptions, VariantsReplaceInputs) {
  const Document document = Document::parse(R"(<materialx version="1.39">
  <standard_surface name="S" type="surfaceshader">
    <input name="emission" type="float" value="1"/></standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <variantset name="lamp">
    <variant name="off"><input name="emission" type="float" value="0"/></variant></variantset>
</materialx>)");
  System system;
  CompileOptions options;
  options.engine = NACRE_INTERPRETER;
  EXPECT_TRUE(system.compile_material(document, "M", options).has(NACRE_EMISSION));
  options.variants = {{"lamp", "off"}};
  EXPECT_FALSE(system.compile_material(document, "M", options).has(NACRE_EMISSION));
}

TEST(ApiOptions, LimitsAreErrors) {
  std::string chain = R"(<materialx version="1.39"><constant name="n0" type="float"/>)";
  for (int i = 1; i < 20; ++i) {
    chain += "<sin name=\"n" + std::to_string(i) + "\" type=\"float\"><input name=\"in\" " +
             "type=\"float\" nodename=\"n" + std::to_string(i - 1) + "\"/></sin>";
  }
  chain += R"(<output name="out" type="float" nodename="n19"/></materialx>)";
  const std::string noise = R"(<materialx version="1.39"><noise3d name="n" type="float"/>
    <output name="out" type="float" nodename="n"/></materialx>)";
  CompileOptions options;
  options.engine = NACRE_INTERPRETER;
  EXPECT_EQ(fault_of(chain, options), "");
  options.max_nodes = 10;
  EXPECT_NE(fault_of(chain, options), "");
  options.max_nodes = 0;
  options.max_inputs = 1;
  EXPECT_EQ(fault_of(chain, options), "");
  const std::string two = R"(<materialx version="1.39"><add name="a" type="float">
    <input name="in1" type="float" value="1"/></add>
    <output name="out" type="float" nodename="a"/></materialx>)";
  EXPECT_NE(fault_of(two, options), "");
  options.max_inputs = 0;
  options.max_instructions = 2;
  EXPECT_NE(fault_of(noise, options), "");
  options.max_instructions = 0;
  options.max_steps = 2;
  EXPECT_NE(fault_of(noise, options), "");
  options.max_steps = 0;
  EXPECT_EQ(fault_of(noise, options), "");
}

TEST(ApiOptions, LimitsOfReadingAreErrors) {
  const std::string text = R"(<materialx version="1.39"><nodegraph name="NG">
    <constant name="c" type="float"/></nodegraph></materialx>)";
  EXPECT_NO_THROW(Document::parse(text));
  const auto is_refused = [&](auto member) {
    ReadOptions reading;
    reading.*member = 1;
    try {
      Document::parse(text, "x.mtlx", reading);
      return false;
    } catch (const Error&) {
      return true;
    }
  };
  EXPECT_TRUE(is_refused(&ReadOptions::max_file_bytes));
  EXPECT_TRUE(is_refused(&ReadOptions::max_elements));
  EXPECT_TRUE(is_refused(&ReadOptions::max_xml_depth));
}

TEST(ApiOptions, WhatIsStoppedFails) {
  StopSource stop;
  CompileOptions options;
  options.stop = &stop;
  ReadOptions reading;
  reading.stop = &stop;
  const std::string text = R"(<materialx version="1.39"><constant name="c" type="float"/>
    <output name="out" type="float" nodename="c"/></materialx>)";
  EXPECT_EQ(fault_of(text, options), "");
  stop.request();
  EXPECT_NE(fault_of(text, options), "");
  EXPECT_THROW(Document::parse(text, "c.mtlx", reading), Error);
}

/// exp(s) at s = 1/3, and what was said.
float exp_of_third(const std::string& profile, std::vector<Diagnostic>& said, int accuracy) {
  const Document document = Document::parse(R"(<materialx version="1.39">
    <texcoord name="uv" type="vector2"/>
    <extract name="s" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
    <exp name="e" type="float"><input name="in" type="float" nodename="s"/></exp>
    <output name="out" type="float" nodename="e"/></materialx>)");
  CompileOptions options;
  options.profile = profile;
  options.accuracy = accuracy;
  const Shader shader = System().compile_outputs(document, {"out"}, options, &said);
  float uv[]{1.0f / 3.0f, 0.0f}, out = 0;
  Binder binder;
  binder.array("uv0", {0, 0, 0, 4}).array("out", {1});
  Batch batch;
  batch.count = 1;
  Binding(binder, shader).run(NACRE_OUTPUTS, std::vector<void*>{uv, &out}, batch);
  return out;
}

TEST(ApiOptions, AProfileChoosesForWhatItNames) {
  std::vector<Diagnostic> said;
  const float fast = exp_of_third("", said, NACRE_FAST);
  const float standard = exp_of_third("", said, NACRE_STANDARD);
  ASSERT_NE(fast, standard);
  const auto profile_of = [](const std::string& output) {
    return R"({"nacre_profile": 1, "subjects": [{"output": ")" + output +
           R"(", "choices": {"accuracy": "fast"}}]})";
  };
  EXPECT_EQ(exp_of_third(profile_of("out"), said, NACRE_STANDARD), fast);
  EXPECT_TRUE(said.empty());
  EXPECT_EQ(exp_of_third(profile_of("other"), said, NACRE_STANDARD), standard);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].code, "not-in-profile");
  EXPECT_THROW(exp_of_third("{}", said, NACRE_STANDARD), Error);
}

/// What a check of an empty document says of options.
std::vector<Diagnostic> refused(System& system, const nacre_compile_options& options) {
  const Document document = Document::parse(R"(<materialx version="1.39"/>)");
  const detail::Said report;
  EXPECT_EQ(nacre_check(system.get(), document.get(), &options, report.get()),
            NACRE_WRONG_ARGUMENTS);
  return report.all();
}

nacre_compile_options sized_options() {
  nacre_compile_options options{};
  options.size = sizeof options;
  return options;
}

TEST(ApiOptions, ChoicesThatThereAreNotAreRefused) {
  System system;
  for (int nacre_compile_options::* choice :
       {&nacre_compile_options::engine, &nacre_compile_options::accuracy,
        &nacre_compile_options::prefer, &nacre_compile_options::compensation,
        &nacre_compile_options::side}) {
    for (const int value : {-1, 3}) {
      nacre_compile_options options = sized_options();
      options.*choice = value;
      EXPECT_EQ(refused(system, options).size(), 1u);
    }
  }
}

TEST(ApiOptions, WhatMeansNothingIsNamed) {
  System system;
  const auto path_of = [&](auto&& change) {
    nacre_compile_options options = sized_options();
    change(options);
    const std::vector<Diagnostic> said = refused(system, options);
    return said.size() == 1 && said[0].code == "bad-options" ? said[0].path : "not one";
  };
  using O = nacre_compile_options;
  EXPECT_EQ(path_of([](O& o) { o.max_anisotropy = 65; }), "max_anisotropy");
  EXPECT_EQ(path_of([](O& o) { o.max_anisotropy = -5; }), "max_anisotropy");
  EXPECT_EQ(path_of([](O& o) { o.side = 2; }), "side");
  EXPECT_EQ(path_of([](O& o) { o.lobes = 0x100; }), "lobes");
  EXPECT_EQ(path_of([](O& o) { o.entries = 1u << NACRE_ENTRY_COUNT; }), "entries");
  EXPECT_EQ(path_of([](O& o) { o.max_seconds = std::nan(""); }), "max_seconds");
  EXPECT_EQ(path_of([](O& o) { o.max_seconds = -1; }), "max_seconds");
  EXPECT_EQ(path_of([](O& o) { o.live_count = 1; }), "live");
  EXPECT_EQ(path_of([](O& o) { o.fact_count = 2; }), "facts");
  EXPECT_EQ(path_of([](O& o) { o.error_points = 3; }), "error_points");
}

TEST(ApiOptions, NamesThatNobodyKnowsAreRefused) {
  System system;
  const Document document = Document::parse(R"(<materialx version="1.39">
    <constant name="c" type="float"/></materialx>)");
  const auto code_of = [&](auto&& change) {
    CompileOptions options;
    change(options);
    try {
      system.compile_outputs(document, {"c"}, options);
    } catch (const Error& error) {
      return error.diagnostics().at(0).code;
    }
    return std::string();
  };
  EXPECT_EQ(code_of([](CompileOptions& o) { o.working_space = "rec2021"; }), "unknown-colorspace");
  EXPECT_EQ(code_of([](CompileOptions& o) { o.output_space = "rec2021"; }), "unknown-colorspace");
  EXPECT_EQ(code_of([](CompileOptions& o) { o.distance_unit = "cubit"; }), "unknown-unit");
  EXPECT_EQ(code_of([](CompileOptions& o) { o.distance_unit = "degree"; }), "unknown-unit");
  EXPECT_EQ(code_of([](CompileOptions& o) {
              o.working_space = "acescg";
              o.output_space = "srgb_texture";
              o.distance_unit = "inch";
            }),
            "");
}

TEST(ApiOptions, FactsOfNothingAreSaid) {
  System system;
  const Document document = Document::parse(R"(<materialx version="1.39">
    <constant name="c" type="float"/><sin name="other" type="float"/></materialx>)");
  const auto codes_of = [&](const std::string& name) {
    std::vector<Diagnostic> said;
    CompileOptions options;
    options.facts = {{name, 0.0, 1.0}};
    options.live = {"c/value"};
    system.compile_outputs(document, {"c"}, options, &said);
    return said.empty() ? std::string() : said[0].code;
  };
  EXPECT_EQ(codes_of("nope"), "unread-fact");
  EXPECT_EQ(codes_of("dot(N,nope)"), "unread-fact");
  EXPECT_EQ(codes_of("c/value"), "");
  EXPECT_EQ(codes_of("other/in"), "");  // Of what another kernel of the document may read.
  EXPECT_EQ(codes_of("nowhere/in"), "unread-fact");
  EXPECT_EQ(codes_of("uv0.x"), "");
  EXPECT_EQ(codes_of("dot(N,wo)"), "");
}

// A typing error leaves a host without the parameter that it wants to set.
TEST(ApiOptions, PatternsOfNothingAreSaid) {
  System system;
  const Document document = Document::parse(R"(<materialx version="1.39">
    <sin name="c" type="float"><input name="in" type="float" value="1"/></sin>
    <nodedef name="ND_twice" node="twice"><input name="in" type="float" value="1"/>
      <output name="out" type="float"/></nodedef>
    <nodegraph name="NG_twice" nodedef="ND_twice">
      <multiply name="inner" type="float"><input name="in1" type="float" interfacename="in"/>
      </multiply><output name="out" type="float" nodename="inner"/></nodegraph>
    <twice name="outer" type="float"/>
    <sin name="other" type="float"/><standard_surface name="S" type="surfaceshader"/>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>)");
  const auto codes_of = [&](std::vector<std::string> live, std::vector<std::string> varying) {
    std::vector<Diagnostic> said;
    CompileOptions options;
    options.live = std::move(live);
    options.varying = std::move(varying);
    options.live.empty() || options.live[0][0] != 'S'
        ? system.compile_outputs(document, {"c"}, options, &said)
        : system.compile_material(document, "M", options, &said);
    std::string codes;
    for (const Diagnostic& each : said) codes += each.code + ' ' + each.found + ';';
    return codes;
  };
  EXPECT_EQ(codes_of({"S/coat_roughness"}, {}), "");
  EXPECT_EQ(codes_of({"S/coat_rouhgness"}, {}), "unfit-pattern 'S/coat_rouhgness';");
  EXPECT_EQ(codes_of({"c/in"}, {}), "");
  EXPECT_EQ(codes_of({"c/*"}, {"c/i?"}), "");
  EXPECT_EQ(codes_of({"*"}, {"*"}), "");
  EXPECT_EQ(codes_of({"other/in"}, {}), "");  // Another output of the document has that.
  EXPECT_EQ(codes_of({"other/inn"}, {}), "unfit-pattern 'other/inn';");
  EXPECT_EQ(codes_of({"*/coat_roughness"}, {}), "");  // The other kind has that.
  EXPECT_EQ(codes_of({"*/coat_rouhgness"}, {}), "unfit-pattern '*/coat_rouhgness';");
  EXPECT_EQ(codes_of({"*coat_roughness"}, {}), "");
  EXPECT_EQ(codes_of({"*coat_rouhgness"}, {}), "unfit-pattern '*coat_rouhgness';");
  EXPECT_EQ(codes_of({"*"}, {"*/coat_color.x", "*/coat_colour.x"}),
            "unfit-pattern '*/coat_colour.x';");
  EXPECT_EQ(codes_of({"S/*", "*/base_color"}, {"S/base_color.?"}), "");
  // A node is no parameter; within the graph of another one they may be.
  EXPECT_EQ(codes_of({"othe?"}, {}), "unfit-pattern 'othe?';");
  EXPECT_EQ(codes_of({"outer/*/in1", "outer/inner/in2"}, {}), "");
  EXPECT_EQ(codes_of({"outer/*/inn"}, {}), "unfit-pattern 'outer/*/inn';");
  EXPECT_EQ(codes_of({"c/inn"}, {}), "unfit-pattern 'c/inn';");
  EXPECT_EQ(codes_of({"d/in"}, {}), "unfit-pattern 'd/in';");
  EXPECT_EQ(codes_of({"d*"}, {}), "unfit-pattern 'd*';");
  EXPECT_EQ(codes_of({}, {"c/in"}), "unfit-pattern 'c/in';");  // It is not live.
  EXPECT_EQ(codes_of({"*"}, {"d/in"}), "unfit-pattern 'd/in';");
  EXPECT_EQ(codes_of({"*"}, {"time", "exterior_index"}), "");
  EXPECT_EQ(codes_of({}, {"*"}), "");  // All that is no parameter: time, and so on.
}

// Of a document that doubles itself with each definition nothing is said, and soon.
TEST(ApiOptions, PatternsAreNotLookedForWithoutEnd) {
  std::string text = R"(<materialx version="1.39"><sin name="c" type="float"/>)";
  for (int k = 0; k < 60; ++k) {
    const std::string own = std::to_string(k);
    const std::string inner = k == 0 ? "sin" : "d" + std::to_string(k - 1);
    text +=
        "<nodedef name=\"ND_" + own + "\" node=\"d" + own +
        R"("><input name="in" type="float" value="1"/><output name="out" type="float"/></nodedef>
               <nodegraph name="NG_)" +
        own + "\" nodedef=\"ND_" + own + "\">";
    for (const char* name : {"a", "b"}) {
      text += "<" + inner + " name=\"" + name +
              R"(" type="float"><input name="in" type="float" interfacename="in"/></)" + inner +
              ">";
    }
    text += R"(<output name="out" type="float" nodename="a"/></nodegraph>)";
  }
  const Document document = Document::parse(text + R"(<d59 name="e" type="float"/></materialx>)");
  System system;
  CompileOptions options;
  options.live = {"*/inn"};
  std::vector<Diagnostic> said;
  EXPECT_NO_THROW(system.compile_outputs(document, {"c"}, options, &said));
  EXPECT_TRUE(said.empty());
}

TEST(ApiOptions, EntriesThatThereAreNotAreNotRun) {
  System system;
  const Document document = Document::parse(R"(<materialx version="1.39">
    <constant name="c" type="float"/></materialx>)");
  const Shader shader = system.compile_outputs(document, {"c"});
  Binder binder;
  binder.array("c", {.array = 0, .stride = sizeof(float)});
  const Binding binding(binder, shader);
  nacre_batch batch{};
  batch.size = sizeof batch;
  for (const int entry : {-1, static_cast<int>(NACRE_ENTRY_COUNT), 99}) {
    EXPECT_EQ(nacre_run(binding.get(), static_cast<nacre_entry>(entry), nullptr, &batch),
              NACRE_WRONG_ARGUMENTS)
        << entry;
  }
  // One that a shader of outputs lacks computes nothing.
  EXPECT_EQ(nacre_run(binding.get(), NACRE_EMISSION, nullptr, &batch), NACRE_OK);
}

}  // namespace
}  // namespace nacre
