#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "examples/bake/bake.h"
#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// All outputs of the reference documents through every width of compiled code
/// and the interpreter: the texels must be the same bits. The plane's size leaves
/// a tail for every width, and the thread count changes with it. Without
/// NACRE_TEST_FULL every eleventh document is taken.
class BitIdentity : public ::testing::TestWithParam<Accuracy> {
 protected:
  using Images = std::vector<std::vector<std::uint32_t>>;

  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  std::vector<std::uint32_t> bake(const Document& document, const std::string& output,
                                  Backend backend, int lanes, int threads) {
    Diagnostics diagnostics;
    ShaderOptions options;
    options.compile.accuracy = GetParam();
    options.compile.backend = backend;
    options.compile.lanes = lanes;
    const auto kernel = system_->compile_outputs(document, {output}, options, diagnostics);
    if (kernel == nullptr) return {};
    host::BakeSettings settings;
    settings.width = 19;
    settings.height = 13;
    settings.threads = threads;
    std::vector<std::uint32_t> bits;
    for (const float texel : host::bake_image(*kernel, 0, settings)) {
      bits.push_back(std::bit_cast<std::uint32_t>(texel));
    }
    return bits;
  }

  const fs::path folder_ = NACRE_CONFORMANCE_NODES;
  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

TEST_P(BitIdentity, EveryWidthGivesTheInterpretersTexels) {
  nlohmann::json manifest;
  std::ifstream(folder_ / "manifest.json") >> manifest;
  const int stride = std::getenv("NACRE_TEST_FULL") != nullptr ? 1 : 11;
  int number = 0;
  int compared = 0;
  for (const auto& [nodedef, outputs] : manifest.items()) {
    if (number++ % stride != 0) continue;
    const auto document =
        read_document(folder_ / "documents" / (nodedef + ".mtlx"), {}, diagnostics_);
    ASSERT_NE(document, nullptr) << diagnostics_.to_string();
    for (const auto& output : outputs) {
      const std::string name = output["output"];
      const auto expected = bake(*document, name, Backend::interpreter, 0, 1);
      EXPECT_FALSE(expected.empty()) << nodedef << " " << name;
      int threads = 1;
      for (const int lanes : {1, 4, 8, 16}) {
        EXPECT_EQ(bake(*document, name, Backend::jit, lanes, threads), expected)
            << nodedef << " " << name << " at " << lanes << " lanes";
        threads = threads == 4 ? 1 : 2 * threads;
      }
      ++compared;
    }
  }
  std::cout << compared << " outputs compared\n";
}

INSTANTIATE_TEST_SUITE_P(Modes, BitIdentity,
                         ::testing::Values(Accuracy::precise, Accuracy::standard),
                         [](const auto& instance) {
                           return std::string(accuracy_name(instance.param));
                         });

}  // namespace
}  // namespace nacre
