// What surfaces become kernels of: closures that are used twice, lights that do not shine.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

ShadingSystem& system() {
  static Diagnostics diagnostics;
  static const auto made =
      ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
  return *made;
}

std::unique_ptr<Document> read(const std::string& body, Diagnostics& diagnostics) {
  return read_document_text("<materialx version=\"1.39\">" + body + "</materialx>", "test.mtlx", {},
                            diagnostics);
}

ShaderOptions interpreted() {
  ShaderOptions options;
  options.compile.backend = Backend::interpreter;
  return options;
}

std::unique_ptr<MaterialKernels> compile(const std::string& body, Diagnostics& diagnostics,
                                         const ShaderOptions& options = interpreted()) {
  const auto document = read(body, diagnostics);
  return document == nullptr ? nullptr
                             : system().compile_material(*document, "M", options, diagnostics);
}

std::string reads(const std::string& port, const std::string& type, const std::string& node) {
  return "<input name=\"" + port + "\" type=\"" + type + "\" nodename=\"" + node + "\"/>";
}

std::string material(const std::string& shader) {
  return "<surfacematerial name=\"M\" type=\"material\">" +
         reads("surfaceshader", "surfaceshader", shader) + "</surfacematerial>";
}

std::string surface_of(const std::string& bsdf) {
  return "<surface name=\"s\" type=\"surfaceshader\">" + reads("bsdf", "BSDF", bsdf) +
         "</surface>" + material("s");
}

/// `levels` nodes of a category, each of which uses the one before twice.
std::string diamonds(const std::string& category, const std::string& first,
                     const std::string& second, int levels) {
  std::string body = "<dielectric_bsdf name=\"b0\" type=\"BSDF\"/>";
  for (int i = 1; i <= levels; ++i) {
    const std::string before = "b" + std::to_string(i - 1);
    body += "<" + category + " name=\"b" + std::to_string(i) + "\" type=\"BSDF\">" +
            reads(first, "BSDF", before) + reads(second, "BSDF", before);
    if (category == "mix") body += "<input name=\"mix\" type=\"float\" value=\"0.25\"/>";
    body += "</" + category + ">";
  }
  return body + surface_of("b" + std::to_string(levels));
}

TEST(Closures, WhatIsUsedTwiceIsOneLobe) {
  for (const auto& [category, first, second] :
       {std::array{"mix", "fg", "bg"}, {"add", "in1", "in2"}, {"layer", "top", "base"}}) {
    Diagnostics diagnostics;
    const auto kernels = compile(diamonds(category, first, second, 40), diagnostics);
    ASSERT_NE(kernels, nullptr) << category << diagnostics.to_string();
    EXPECT_EQ(kernels->lobes.size(), 1u) << category;
  }
}

float albedo(const MaterialKernels& kernels) {
  const Program& program = kernels.albedo->program();
  std::vector<float> values(program.inputs.size(), 0.0f);
  std::vector<const void*> in;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = program.inputs[i].name;
    if (name == "N.z" || name == "Ng.z" || name == "wo.z" || name == "T.x") values[i] = 1.0f;
    in.push_back(&values[i]);
  }
  std::vector<float> results(program.outputs.size());
  std::vector<void*> out;
  for (float& result : results) out.push_back(&result);
  EXPECT_EQ(kernels.albedo->run(in, out, 1), RunStatus::done);
  return results[0];
}

/// Every lobe that the shader's graph has, but for those that the kernels have, is in the manifest.
TEST(Closures, TheManifestNamesEachLobeThatIsNotThere) {
  ShaderOptions all_live = interpreted();
  all_live.live = {"*"};
  for (const char* const shader : {"standard_surface", "open_pbr_surface", "gltf_pbr",
                                   "UsdPreviewSurface", "disney_principled"}) {
    const std::string body =
        "<" + std::string(shader) + " name=\"s\" type=\"surfaceshader\"/>" + material("s");
    Diagnostics diagnostics;
    const auto whole = compile(body, diagnostics, all_live);
    const auto plain = compile(body, diagnostics);
    ASSERT_TRUE(whole != nullptr && plain != nullptr) << diagnostics.to_string();
    EXPECT_LT(plain->lobes.size(), whole->lobes.size()) << shader;
    for (const LobeInfo& lobe : whole->lobes) {
      const bool is_there = std::ranges::any_of(
          plain->lobes, [&](const LobeInfo& other) { return other.path == lobe.path; });
      const bool is_named = std::ranges::any_of(plain->manifest, [&](const std::string& line) {
        return line == lobe.name + " at " + lobe.path + ": weight 0";
      });
      EXPECT_NE(is_there, is_named) << shader << ' ' << lobe.path;
    }
  }
}

TEST(Closures, TheManifestNamesWhatWasNotRequested) {
  const auto says = [](const ShaderOptions& options, const std::string& what) {
    Diagnostics diagnostics;
    const auto kernels =
        compile(R"(<standard_surface name="s" type="surfaceshader"/>)" + material("s"), diagnostics,
                options);
    if (kernels == nullptr) return ADD_FAILURE() << diagnostics.to_string(), false;
    return std::ranges::count(kernels->manifest, what) == 1;
  };
  const std::string kind = "dielectric_bsdf: of a kind that was not requested";
  const std::string once =
      "dielectric_bsdf: without what several scatterings between facets bring back";
  ShaderOptions options = interpreted();
  EXPECT_FALSE(says(options, kind) || says(options, once));
  options.kernels.lobes = lobe_diffuse_reflection;
  EXPECT_TRUE(says(options, kind));
  options.kernels.lobes = lobe_all;
  options.kernels.compensation = Compensation::nothing;
  EXPECT_TRUE(says(options, once));
}

TEST(Closures, AnInterfaceThatIsNoneHasNoLobe) {
  const auto open_pbr = [](const char* weight) {
    return R"(<open_pbr_surface name="s" type="surfaceshader">
      <input name="specular_weight" type="float" value=")" +
           std::string(weight) + R"("/></open_pbr_surface>)" + material("s");
  };
  Diagnostics diagnostics;
  const auto with = compile(open_pbr("1"), diagnostics);
  const auto without = compile(open_pbr("0"), diagnostics);
  ASSERT_TRUE(with != nullptr && without != nullptr) << diagnostics.to_string();
  const auto has_interface = [](const MaterialKernels& kernels) {
    return std::ranges::count(kernels.lobes, "dielectric_bsdf", &LobeInfo::name) != 0;
  };
  EXPECT_TRUE(has_interface(*with));
  EXPECT_FALSE(has_interface(*without));
}

/// The weights of a lobe's uses add up to what two equal lobes would have.
TEST(Closures, SharedWeighsAsMuchAsTwoOfAKind) {
  const std::string lobe =
      " type=\"BSDF\"><input name=\"color\" type=\"color3\" "
      "value=\"0.5,0.25,0.125\"/></burley_diffuse_bsdf>";
  const std::string twice = "<burley_diffuse_bsdf name=\"a\"" + lobe;
  const auto mixed = [&](const std::string& bg) {
    return "<mix name=\"m\" type=\"BSDF\">" + reads("fg", "BSDF", "a") + reads("bg", "BSDF", bg) +
           "<input name=\"mix\" type=\"float\" value=\"0.25\"/></mix>" + surface_of("m");
  };
  Diagnostics diagnostics;
  const auto shared = compile(twice + mixed("a"), diagnostics);
  const auto apart =
      compile(twice + "<burley_diffuse_bsdf name=\"b\"" + lobe + mixed("b"), diagnostics);
  ASSERT_TRUE(shared != nullptr && apart != nullptr) << diagnostics.to_string();
  EXPECT_EQ(shared->lobes.size(), 1u);
  EXPECT_EQ(apart->lobes.size(), 2u);
  EXPECT_GT(albedo(*shared), 0.1f);
  EXPECT_NEAR(albedo(*shared), albedo(*apart), 1e-6f);
}

TEST(Closures, TooManyLobesAreRefusedWhereTheyAreAsked) {
  std::string body = "<dielectric_bsdf name=\"b0\" type=\"BSDF\"/>";
  for (int i = 1; i < 400; ++i) {
    const std::string number = std::to_string(i);
    body += "<conductor_bsdf name=\"l" + number +
            "\" type=\"BSDF\"><input name=\"roughness\" type=\"vector2\" value=\"0." + number +
            ",0.2\"/></conductor_bsdf><add name=\"b" + number + "\" type=\"BSDF\">" +
            reads("in1", "BSDF", "b" + std::to_string(i - 1)) + reads("in2", "BSDF", "l" + number) +
            "</add>";
  }
  body += surface_of("b399");
  ShaderOptions options = interpreted();
  options.compile.max_instructions = 20'000;
  Diagnostics diagnostics;
  EXPECT_EQ(compile(body, diagnostics, options), nullptr);
  ASSERT_EQ(diagnostics.all().size(), 1u) << diagnostics.to_string();
  EXPECT_EQ(diagnostics.all().front().code, "program-too-large");
  EXPECT_EQ(diagnostics.all().front().where.file, "test.mtlx");
  EXPECT_EQ(diagnostics.all().front().where.path, "M");
  // Checking the document gives the same answer.
  Diagnostics checked;
  system().check(*read(body, checked), options, checked);
  ASSERT_EQ(checked.all().size(), 1u) << checked.to_string();
  EXPECT_EQ(checked.all().front().code, "program-too-large");
}

// A chain of nodes as long as a document may have: no recursion.
TEST(Closures, LongChainsEnd) {
  std::string body = "<dielectric_bsdf name=\"b0\" type=\"BSDF\"/>";
  constexpr int length = 30'000;
  for (int i = 1; i <= length; ++i) {
    body += "<multiply name=\"b" + std::to_string(i) + "\" type=\"BSDF\">" +
            reads("in1", "BSDF", "b" + std::to_string(i - 1)) +
            "<input name=\"in2\" type=\"float\" value=\"0.9999\"/></multiply>";
  }
  Diagnostics diagnostics;
  const auto kernels = compile(body + surface_of("b" + std::to_string(length)), diagnostics);
  ASSERT_NE(kernels, nullptr) << diagnostics.to_string();
  EXPECT_EQ(kernels->lobes.size(), 1u);
}

std::string shader(const std::string& category, const std::string& inputs) {
  return "<" + category + " name=\"s\" type=\"surfaceshader\">" + inputs + "</" + category + ">" +
         material("s");
}

/// Hosts take an object with an emission kernel for a light.
TEST(Closures, WhatDoesNotShineHasNoEmissionKernel) {
  const std::string texture =
      "<texcoord name=\"uv\" type=\"vector2\"/><checkerboard name=\"c\" type=\"color3\">" +
      reads("texcoord", "vector2", "uv") + "</checkerboard>";
  const std::string coat =
      "<input name=\"coat\" type=\"float\" value=\"0.5\"/>"
      "<input name=\"coat_color\" type=\"color3\" value=\"0.9,0.5,0.2\"/>";
  const std::string open_coat =
      "<input name=\"coat_weight\" type=\"float\" value=\"0.5\"/>"
      "<input name=\"coat_color\" type=\"color3\" value=\"0.9,0.5,0.2\"/>";
  for (const std::string& body :
       {shader("standard_surface", ""), shader("standard_surface", coat),
        texture + shader("standard_surface", coat + reads("emission_color", "color3", "c")),
        shader("open_pbr_surface", ""), shader("open_pbr_surface", open_coat),
        texture + shader("open_pbr_surface", open_coat + reads("emission_color", "color3", "c"))}) {
    Diagnostics diagnostics;
    const auto kernels = compile(body, diagnostics);
    ASSERT_NE(kernels, nullptr) << diagnostics.to_string();
    EXPECT_FALSE(kernels->emission.has_value()) << body;
    EXPECT_NE(
        std::find(kernels->manifest.begin(), kernels->manifest.end(), "emission: always black"),
        kernels->manifest.end());
    EXPECT_FALSE(kernels->opacity.has_value()) << body;
  }
  Diagnostics diagnostics;
  const auto lit = compile(
      shader("standard_surface", coat + "<input name=\"emission\" type=\"float\" value=\"1\"/>"),
      diagnostics);
  ASSERT_NE(lit, nullptr) << diagnostics.to_string();
  EXPECT_TRUE(lit->emission.has_value());
}

TEST(Closures, OneBadMaterialDoesNotSpoilTheNext) {
  Diagnostics diagnostics;
  EXPECT_EQ(compile(shader("standard_surface", reads("base", "float", "nowhere")), diagnostics),
            nullptr);
  ASSERT_TRUE(diagnostics.has_errors());
  const std::size_t errors = diagnostics.error_count();
  EXPECT_NE(compile(shader("standard_surface", ""), diagnostics), nullptr);
  EXPECT_EQ(diagnostics.error_count(), errors) << diagnostics.to_string();
}

TEST(Closures, AStopRequestEndsCompiling) {
  std::stop_source source;
  source.request_stop();
  ShaderOptions options = interpreted();
  options.compile.stop = Stop(source.get_token());
  Diagnostics diagnostics;
  EXPECT_EQ(compile(shader("standard_surface", ""), diagnostics, options), nullptr);
  ASSERT_EQ(diagnostics.all().size(), 1u) << diagnostics.to_string();
  EXPECT_EQ(diagnostics.all().front().code, "stopped");
  EXPECT_EQ(diagnostics.all().front().where.file, "test.mtlx");
}

}  // namespace
}  // namespace nacre
