// What a host gets of a compile, beside the numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "jit/compile/compile.h"
#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/support/small_program.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

/// sin(s) of the texture coordinates, by an output "out".
constexpr const char* wave = R"(<materialx version="1.39">
  <texcoord name="uv" type="vector2"/>
  <separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="uv"/>
  </separate2>
  <sin name="wave" type="float"><input name="in" type="float" nodename="parts" output="outx"/></sin>
  <output name="out" type="float" nodename="wave"/>
</materialx>)";

std::unique_ptr<ShadingSystem> system(const std::filesystem::path& cache = {}) {
  Diagnostics diagnostics;
  auto made = ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}, .cache = cache},
                                    diagnostics);
  EXPECT_EQ(diagnostics.to_string(), "");
  return made;
}

std::unique_ptr<OutputKernel> compiled(ShadingSystem& by, const std::string& text,
                                       const ShaderOptions& options = {}) {
  Diagnostics diagnostics;
  const auto document = read_document_text(text, "test.mtlx", {}, diagnostics);
  auto kernel = by.compile_outputs(*document, {"out"}, options, diagnostics);
  EXPECT_EQ(diagnostics.to_string(), "");
  return kernel;
}

bool has_stage(const OutputKernel& kernel, const std::string& name) {
  return std::ranges::any_of(kernel.stages, [&](const StageReport& stage) {
    return stage.name == name || stage.name.ends_with(": " + name);
  });
}

float result(const OutputKernel& kernel, float s) {
  float value = 0;
  const void* inputs[]{&s};
  void* outputs[]{&value};
  EXPECT_EQ(kernel.kernel.run(inputs, outputs, 1), RunStatus::done);
  return value;
}

/// The dear passes are for those that are not.
TEST(Compiled, CachedKernelsAreKnownBeforeTheLatePasses) {
  const TemporaryFolder folder;
  const auto first = compiled(*system(folder.path()), wave);
  const auto second = compiled(*system(folder.path()), wave);
  ASSERT_TRUE(first != nullptr && second != nullptr);
  EXPECT_TRUE(has_stage(*first, "derive") && has_stage(*second, "derive"));
  EXPECT_TRUE(has_stage(*first, "expand_math"));
  EXPECT_FALSE(has_stage(*second, "contract"));
  EXPECT_FALSE(has_stage(*second, "expand_math"));
  EXPECT_STREQ(second->kernel.kernel().engine(), "jit");
  EXPECT_EQ(result(*first, 0.7f), result(*second, 0.7f));
  // Whoever wants to look at the whole Program gets it.
  ShaderOptions whole;
  whole.compile.whole = true;
  const auto third = compiled(*system(folder.path()), wave, whole);
  ASSERT_NE(third, nullptr);
  EXPECT_TRUE(has_stage(*third, "expand_math"));
  EXPECT_EQ(result(*third, 0.7f), result(*first, 0.7f));
}

TEST(Compiled, ArraysThatDoNotFitAreNotRead) {
  const auto kernel = compiled(*system(), wave);
  ASSERT_NE(kernel, nullptr);
  float s = 0.5f, value = -7.0f;
  const std::vector<const void*> inputs{&s}, more_inputs{&s, &s};
  const std::vector<void*> outputs{&value}, more_outputs{&value, &value};
  const std::vector<std::uint32_t> parameters(kernel->kernel.parameters().size() + 1);
  const BoundKernel& bound = kernel->kernel;
  EXPECT_EQ(bound.run({}, outputs, 1), RunStatus::wrong_arguments);
  EXPECT_EQ(bound.run(more_inputs, outputs, 1), RunStatus::wrong_arguments);
  EXPECT_EQ(bound.run(inputs, {}, 1), RunStatus::wrong_arguments);
  EXPECT_EQ(bound.run(inputs, more_outputs, 1), RunStatus::wrong_arguments);
  EXPECT_EQ(bound.run(inputs, outputs, 1, parameters), RunStatus::wrong_arguments);
  EXPECT_EQ(value, -7.0f);
  EXPECT_EQ(bound.run(inputs, outputs, 1), RunStatus::done);
  EXPECT_NE(value, -7.0f);
}

TEST(Compiled, MachineCodeNeedsAService) {
  Diagnostics diagnostics;
  EXPECT_EQ(compile(small_program(1.0f), {}, nullptr, diagnostics), nullptr);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all().front().code, "no-service");
}

}  // namespace
}  // namespace nacre
