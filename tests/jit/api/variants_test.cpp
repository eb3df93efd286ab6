// Several shaders of one material by one call.
#include <gtest/gtest.h>

#include <cstring>
#include <nacre/lobe_test.hpp>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

namespace nacre {
namespace {

constexpr const char* document_text = R"(<materialx version="1.39">
  <nodegraph name="G"><fractal3d name="n" type="float"/>
    <output name="rough" type="float" nodename="n"/></nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="metalness" type="float" value="0.5"/>
    <input name="specular_roughness" type="float" nodegraph="G" output="rough"/>
    <input name="opacity" type="color3" value="0.5, 0.6, 0.7"/></standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>)";

/// A camera's, a shadow ray's, and those of rays behind a bounce.
std::vector<CompileOptions> variants() {
  std::vector<CompileOptions> list(3);
  list[0].with_begin = {"albedo", "G/n"};
  list[1].entries = 1u << NACRE_OPACITY;
  list[2].lobes = NACRE_DIFFUSE_REFLECTION | NACRE_GLOSSY_REFLECTION;
  list[2].min_alpha = true;
  list[2].no_footprints = true;
  list[2].live = {"S/base_color"};
  for (CompileOptions& each : list) each.engine = NACRE_INTERPRETER;
  return list;
}

std::vector<std::string> names(const std::vector<Channel>& channels) {
  std::vector<std::string> list;
  for (const Channel& each : channels) list.push_back(each.name);
  return list;
}

TEST(Variants, AreWhatEachIsByItself) {
  System system;
  const Document document = Document::parse(document_text);
  for (const int engine : {NACRE_INTERPRETER, NACRE_JIT}) {
    std::vector<CompileOptions> asked = variants();
    for (CompileOptions& each : asked) each.engine = engine;
    const std::vector<Shader> together = system.compile_variants(document, "M", asked);
    ASSERT_EQ(together.size(), asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const Shader alone = system.compile_material(document, "M", asked[i]);
      for (int entry = NACRE_OUTPUTS; entry <= NACRE_EMIT; ++entry) {
        const auto e = static_cast<nacre_entry>(entry);
        EXPECT_EQ(together[i].has(e), alone.has(e)) << i << " " << entry;
        EXPECT_EQ(names(together[i].inputs(e)), names(alone.inputs(e))) << i << " " << entry;
        EXPECT_EQ(names(together[i].results(e)), names(alone.results(e))) << i << " " << entry;
      }
      EXPECT_EQ(together[i].state_count(), alone.state_count());
      EXPECT_EQ(together[i].left_out(), alone.left_out());
      if (!alone.has(NACRE_EVALUATE)) continue;
      detail::LobeProbe one(alone, nullptr, {}), other(together[i], nullptr, {});
      const auto expected = one.sample(direction(40), 1000, 3),
                 found = other.sample(direction(40), 1000, 3);
      EXPECT_EQ(std::memcmp(found.wi.data(), expected.wi.data(), sizeof(Direction) * 1000), 0) << i;
      EXPECT_EQ(found.weight, expected.weight) << i;
      EXPECT_EQ(one.evaluate({direction(40)}, expected.wi).f,
                other.evaluate({direction(40)}, expected.wi).f);
    }
  }
}

TEST(Variants, AreAllOrNone) {
  System system;
  const Document document = Document::parse(document_text);
  std::vector<CompileOptions> asked = variants();
  asked[1].with_begin = {"G/nothing"};
  std::vector<Diagnostic> said;
  try {
    system.compile_variants(document, "M", asked, &said);
    ADD_FAILURE() << "there is no such value";
  } catch (const Error& error) {
    ASSERT_EQ(error.diagnostics().size(), 1u) << error.what();
    EXPECT_NE(std::string(error.what()).find("G/nothing"), std::string::npos) << error.what();
  }
  EXPECT_THROW(system.compile_variants(document, "nothing", variants()), Error);
}

// What one of them needs of the graph must not be missing, and warnings are not repeated.
TEST(Variants, SayOnceWhatAllSay) {
  System system;
  const Document document = Document::parse(R"(<materialx version="1.39">
  <image name="i" type="color3"><input name="file" type="filename" value="nowhere.png"/></image>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodename="i"/></standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>)");
  std::vector<CompileOptions> asked(3);
  for (CompileOptions& each : asked) {
    each.engine = NACRE_INTERPRETER;
    each.missing_images_pass = true;
  }
  std::vector<Diagnostic> said;
  EXPECT_EQ(system.compile_variants(document, "M", asked, &said).size(), 3u);
  EXPECT_EQ(said.size(), 1u);
}

TEST(Variants, AreOfOneGraph) {
  System system;
  const Document document = Document::parse(document_text);
  std::vector<CompileOptions> asked = variants();
  asked[2].working_space = "acescg";
  EXPECT_THROW(system.compile_variants(document, "M", asked), Error);
  EXPECT_THROW(system.compile_variants(document, "M", {}), Error);
}

}  // namespace
}  // namespace nacre
