#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "examples/bake/bake.h"
#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"
#include "jit/graph/find.h"
#include "jit/shading/shading_system.h"
#include "tests/support/materialx_samples.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// MaterialX's own example documents, and ours: every graph output bakes to
/// finite texels and every material compiles.
class ExampleDocuments : public ::testing::Test {
 protected:
  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  void check_all(const fs::path& folder) {
    int documents = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".mtlx") continue;
      if (entry.path().parent_path().filename() == "SimpleHair") continue;  // No hair lobe yet.
      check(entry.path());
      ++documents;
    }
    EXPECT_GT(documents, 0);
  }

 private:
  void check(const fs::path& file) {
    SCOPED_TRACE(file.string());
    Diagnostics diagnostics;
    ReadOptions read;
    read.includes_anywhere = true;
    const auto document = read_document(file, read, diagnostics);
    ASSERT_NE(document, nullptr) << diagnostics.to_string();
    ShaderOptions options;
    options.files_anywhere = true;
    for (const FoundOutput& output : find_outputs(*document)) {
      if (!is_numeric(output.type)) continue;
      const auto kernel = system_->compile_outputs(*document, {output.name}, options, diagnostics);
      ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
      for (const float texel : host::bake_image(*kernel, 0, {.width = 8, .height = 8})) {
        EXPECT_TRUE(std::isfinite(texel)) << output.name;
      }
    }
    options.compile.backend = Backend::interpreter;
    for (const FoundMaterial& material : find_materials(*document)) {
      const auto kernels =
          system_->compile_material(*document, material.name, options, diagnostics);
      ASSERT_NE(kernels, nullptr) << diagnostics.to_string();
      EXPECT_TRUE(kernels->evaluate.has_value() || kernels->emission.has_value()) << material.name;
    }
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      EXPECT_EQ(diagnostic.code, "missing-image") << diagnostic.to_string();
    }
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

TEST_F(ExampleDocuments, OursCompile) {
  check_all(fs::path(NACRE_SOURCE_DIR) / "examples" / "documents");
}

TEST_F(ExampleDocuments, MaterialXOnesCompile) {
  const fs::path folder = materialx_sample("Materials/Examples");
  if (folder.empty()) GTEST_SKIP() << "the MaterialX sample documents are not here";
  check_all(folder);
}

}  // namespace
}  // namespace nacre
