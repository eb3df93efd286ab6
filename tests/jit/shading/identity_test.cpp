// One document, one kernel: no other's, and the same whatever the host's floating-point
// environment is.

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <bit>
#include <cfenv>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "runtime/program/digest.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t points = 37;

/// All outputs of a kernel where every channel sweeps from -1 on, by steps that no rounding
/// touches.
std::vector<std::vector<std::uint32_t>> outputs_of(const BoundKernel& kernel) {
  std::vector<float> sweep;
  for (std::size_t i = 0; i < points; ++i) sweep.push_back(static_cast<float>(i) / 16.0f - 1.0f);
  const std::vector<const void*> in(kernel.program().inputs.size(), sweep.data());
  std::vector<std::vector<std::uint32_t>> outputs(kernel.program().outputs.size(),
                                                  std::vector<std::uint32_t>(points));
  std::vector<void*> out;
  for (auto& channel : outputs) out.push_back(channel.data());
  EXPECT_EQ(kernel.run(in, out, points), RunStatus::done);
  return outputs;
}

/// The first 22 constants of these differ, but not the 128 bits that once stood for them.
TEST(Identity, DocumentsMadeToCollideHaveTheirOwnKernels) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  std::vector<std::vector<std::vector<std::uint32_t>>> found;
  // The second round has both from the cache.
  for (const char* name : {"a", "b", "a", "b"}) {
    const auto system = ShadingSystem::create(
        {.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}, .cache = folder.path() / "kernels"},
        diagnostics);
    ASSERT_NE(system, nullptr) << diagnostics.to_string();
    const auto document = read_document(
        fs::path(NACRE_SOURCE_DIR) / "tests/documents/collision" / (std::string(name) + ".mtlx"),
        {}, diagnostics);
    ASSERT_NE(document, nullptr) << diagnostics.to_string();
    ShaderOptions options;
    const auto jit = system->compile_outputs(*document, {"o"}, options, diagnostics);
    options.compile.backend = Backend::interpreter;
    const auto interpreter = system->compile_outputs(*document, {"o"}, options, diagnostics);
    ASSERT_TRUE(jit && interpreter) << diagnostics.to_string();
    EXPECT_EQ(std::string(jit->kernel.kernel().engine()), "jit");
    found.push_back(outputs_of(jit->kernel));
    EXPECT_EQ(found.back(), outputs_of(interpreter->kernel)) << name;
  }
  EXPECT_NE(found[0], found[1]);
  EXPECT_EQ(diagnostics.to_string(), "");
}

/// Decimals that no float has, colours of other spaces, units, functions of constants.
constexpr const char* decimals = R"(<materialx version="1.39" colorspace="lin_rec709">
  <texcoord name="uv" type="vector2"/>
  <extract name="u" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
  <sin name="s" type="float"><input name="in" type="float" value="0.3"/></sin>
  <multiply name="m" type="float">
    <input name="in1" type="float" nodename="u"/>
    <input name="in2" type="float" value="0.1"/>
  </multiply>
  <add name="a" type="float">
    <input name="in1" type="float" nodename="m"/>
    <input name="in2" type="float" nodename="s"/>
  </add>
  <rotate3d name="r" type="vector3">
    <input name="in" type="vector3" value="0.1, 0.7, 1e-40"/>
    <input name="amount" type="float" value="33.3"/>
  </rotate3d>
  <constant name="c" type="color3">
    <input name="value" type="color3" value="0.2, 0.333333333333, 0.7" colorspace="srgb_texture"/>
  </constant>
  <convert name="cv" type="vector3"><input name="in" type="color3" nodename="c"/></convert>
  <add name="rc" type="vector3">
    <input name="in1" type="vector3" nodename="r"/>
    <input name="in2" type="vector3" nodename="cv"/>
  </add>
  <multiply name="out1" type="vector3">
    <input name="in1" type="vector3" nodename="rc"/>
    <input name="in2" type="float" nodename="a"/>
  </multiply>
  <output name="out" type="vector3" nodename="out1"/>
  <standard_surface name="ss" type="surfaceshader">
    <input name="base_color" type="color3" value="0.1, 0.2, 0.3"/>
    <input name="specular_roughness" type="float" value="0.35"/>
    <input name="coat" type="float" value="0.123"/>
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="ss"/>
  </surfacematerial>
</materialx>)";

/// Digests of all Programs, values of parameters, and what one computes.
std::vector<std::string> everything(ParameterMode parameters) {
  Diagnostics diagnostics;
  std::vector<std::string> all;
  const auto system =
      ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
  const auto document = read_document_text(decimals, "test.mtlx", {}, diagnostics);
  if (system == nullptr || document == nullptr) return {diagnostics.to_string()};
  ShaderOptions options;
  options.parameters = parameters;
  const auto add = [&](const BoundKernel& kernel) {
    all.push_back(kernel.program().name + " " + to_hex(code_digest(kernel.program())));
    for (const std::uint32_t value : kernel.parameters()) all.push_back(std::to_string(value));
  };
  const auto outputs = system->compile_outputs(*document, {"out"}, options, diagnostics);
  options.compile.backend = Backend::interpreter;
  const auto material = system->compile_material(*document, "M", options, diagnostics);
  if (outputs == nullptr || material == nullptr) return {diagnostics.to_string()};
  add(outputs->kernel);
  for (const auto* kernel :
       {&material->begin, &material->sample, &material->evaluate, &material->albedo}) {
    if (*kernel) add(**kernel);
  }
  for (const auto& channel : outputs_of(outputs->kernel)) {
    for (const std::uint32_t bits : channel) all.push_back(std::to_string(bits));
  }
  return all;
}

TEST(Identity, HostsFloatEnvironmentNeitherMattersNorChanges) {
  std::fenv_t before;
  std::fegetenv(&before);
  for (const ParameterMode parameters : {ParameterMode::frozen, ParameterMode::live}) {
    const std::vector<std::string> expected = everything(parameters);
    ASSERT_GT(expected.size(), 100u);
    for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST}) {
      for (const std::uint32_t flush : {0x0000u, 0x8040u}) {
        std::fesetround(rounding);
        const std::uint32_t mode = _mm_getcsr() | flush;
        _mm_setcsr(mode);
        const std::vector<std::string> found = everything(parameters);
        const std::uint32_t after = _mm_getcsr();
        const int rounding_after = std::fegetround();
        std::fesetenv(&before);
        EXPECT_EQ(found, expected) << "rounding " << rounding << " flush " << flush;
        EXPECT_EQ(after & 0xffc0u, mode & 0xffc0u);
        EXPECT_EQ(rounding_after, rounding);
      }
    }
  }
}

TEST(Identity, LanesThatThereAreNotAreAnError) {
  Diagnostics diagnostics;
  const auto system =
      ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
  const auto document = read_document_text(decimals, "test.mtlx", {}, diagnostics);
  ASSERT_EQ(diagnostics.to_string(), "");
  for (const int lanes : {2, 3, 32, -1, 1 << 30}) {
    for (const bool asynchronous : {false, true}) {
      Diagnostics said;
      ShaderOptions options;
      options.compile.lanes = lanes;
      options.compile.asynchronous = asynchronous;
      options.compile.dump_ir = true;
      EXPECT_EQ(system->compile_outputs(*document, {"out"}, options, said), nullptr);
      ASSERT_EQ(said.error_count(), 1u) << lanes;
      EXPECT_EQ(said.all().front().code, "bad-lanes");
    }
  }
}

}  // namespace
}  // namespace nacre
