// What a system knows: nodes, faults of documents, textures.
#include <gtest/gtest.h>

#include <algorithm>
#include <nacre/nacre.hpp>
#include <string>

namespace nacre {
namespace {

const NodeDef& named(const std::vector<NodeDef>& all, const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const NodeDef& def) { return def.name == name; });
  return found != all.end() ? *found : throw std::runtime_error("no " + name);
}

TEST(ApiLibrary, NodesAreListedAsTheStandardHasThem) {
  const System system;
  const std::vector<NodeDef> all = system.nodedefs();
  const NodeDef& mix = named(all, "ND_mix_color3");
  EXPECT_EQ(mix.category, "mix");
  EXPECT_EQ(mix.group, "compositing");
  EXPECT_TRUE(mix.has_body);
  ASSERT_EQ(mix.inputs.size(), 3u);
  EXPECT_EQ(mix.inputs[0].name + ' ' + mix.inputs[1].name + ' ' + mix.inputs[2].name, "fg bg mix");
  EXPECT_EQ(mix.inputs[2].type, "float");
  ASSERT_EQ(mix.outputs.size(), 1u);
  EXPECT_EQ(mix.outputs[0].type, "color3");

  const NodeDef& surface = named(all, "ND_standard_surface_surfaceshader");
  EXPECT_EQ(surface.version, "1.0.1");
  const auto ior = std::find_if(surface.inputs.begin(), surface.inputs.end(),
                                [](const Port& port) { return port.name == "specular_IOR"; });
  ASSERT_NE(ior, surface.inputs.end());
  EXPECT_EQ(ior->value, "1.5");
  EXPECT_EQ(ior->label, "Index of Refraction");
  EXPECT_EQ(ior->folder, "Specular");

  EXPECT_EQ(all[nacre_system_find_nodedef(system.get(), "ND_mix_color3")].name, "ND_mix_color3");
  EXPECT_EQ(nacre_system_find_nodedef(system.get(), "ND_mxi_color3"), SIZE_MAX);
  nacre_port port{};
  port.size = sizeof port;
  EXPECT_EQ(nacre_system_input(system.get(), all.size(), 0, &port), NACRE_WRONG_ARGUMENTS);
  EXPECT_EQ(nacre_system_output(system.get(), 0, 100, &port), NACRE_WRONG_ARGUMENTS);
}

TEST(ApiLibrary, CheckSaysWhatCompilingWouldSay) {
  System system;
  const auto text = [](const std::string& node) {
    return "<materialx version=\"1.39\"><" + node +
           " name=\"n\" type=\"float\"/>"
           "<output name=\"out\" type=\"float\" nodename=\"n\"/></materialx>";
  };
  EXPECT_TRUE(system.check(Document::parse(text("constant"))).empty());
  const Document wrong = Document::parse(text("cnstant"), "wrong.mtlx");
  const std::vector<Diagnostic> said = system.check(wrong);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].severity, NACRE_ERROR);
  EXPECT_EQ(said[0].path, "n");
  try {
    system.compile_outputs(wrong, {"out"});
    FAIL() << "compiled";
  } catch (const Error& error) {
    ASSERT_EQ(error.diagnostics().size(), 1u);
    EXPECT_EQ(error.diagnostics()[0].text, said[0].text);
  }
  nacre_compile_options no_size{};
  EXPECT_EQ(nacre_check(system.get(), wrong.get(), &no_size, nullptr), NACRE_WRONG_ARGUMENTS);
}

TEST(ApiLibrary, TexturesAreCounted) {
  System system;
  EXPECT_EQ(system.texture_statistics().loads, 0u);
  const Document document = Document::parse(
      R"(<materialx version="1.39"><image name="i" type="color3">
           <input name="file" type="filename" value="nowhere.png"/></image>
         <output name="out" type="color3" nodename="i"/></materialx>)");
  CompileOptions options;
  options.missing_images_pass = true;
  std::vector<Diagnostic> said;
  {
    const Shader shader = system.compile_outputs(document, {"out"}, options, &said);
    EXPECT_EQ(said.size(), 1u);
    EXPECT_EQ(system.texture_statistics().missing_textures, 1u);
    EXPECT_EQ(system.texture_statistics().resident_bytes, 0u);
  }
  system.drop_textures();
  EXPECT_EQ(system.texture_statistics().missing_textures, 0u);
}

}  // namespace
}  // namespace nacre
