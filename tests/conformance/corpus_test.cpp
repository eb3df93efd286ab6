#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "examples/bake/bake.h"
#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"
#include "jit/graph/find.h"
#include "jit/shading/shading_system.h"
#include "tests/support/materialx_samples.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

using Reasons = std::map<std::string, std::string>;  ///< "FILE NAME", and why.

/// Materials that do not compile, each with the reason.
const Reasons& uncompilable() {
  static const std::string file = "TestSuite/pbrlib/surfaceshader/surfacematerial_with_graph.mtlx ";
  static const Reasons known{{file + "M_EmptySurface", "nothing is connected, on purpose"},
                             {file + "M_EmptyVolume", "nothing is connected, on purpose"}};
  return known;
}

/// All of MaterialX's own documents: every numeric output through the compiler
/// and the interpreter, whose texels must be the same bits.
class Corpus : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = materialx_sample("Materials");
    if (folder_.empty()) GTEST_SKIP() << "the MaterialX sample documents are not here";
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
    // The documents name images as "resources/Images/..." from MaterialX's own root.
    images_ = fs::temp_directory_path() / std::to_string(getpid()).append("_nacre_corpus");
    fs::create_directories(images_);
    fs::create_directory_symlink(fs::absolute(folder_.parent_path()), images_ / "resources");
  }

  void TearDown() override {
    if (!images_.empty()) fs::remove_all(images_);
  }

  std::unique_ptr<Document> read(const fs::path& file, Diagnostics& diagnostics) const {
    ReadOptions options;
    options.includes_anywhere = true;
    return read_document(file, options, diagnostics);
  }

  std::string name_of(const fs::path& file) const { return fs::relative(file, folder_).string(); }

  ShaderOptions options(Backend backend) const {
    ShaderOptions result;
    result.compile.backend = backend;
    result.search_paths = {images_};
    result.files_anywhere = true;
    return result;
  }

  std::vector<fs::path> documents() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.path().extension() == ".mtlx") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  /// The texels of one output; empty if it does not compile.
  std::vector<float> bake(const Document& document, const std::string& output,
                          const ShaderOptions& options, Diagnostics& diagnostics) {
    const auto kernel = system_->compile_outputs(document, {output}, options, diagnostics);
    if (kernel == nullptr) return {};
    return host::bake_image(*kernel, 0, {.width = 7, .height = 5, .threads = 1});
  }

  fs::path folder_;
  fs::path images_;
  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

std::vector<std::uint32_t> bits(const std::vector<float>& texels) {
  std::vector<std::uint32_t> result;
  for (const float texel : texels) result.push_back(std::bit_cast<std::uint32_t>(texel));
  return result;
}

TEST_F(Corpus, EveryNumericOutputIsFiniteAndTheSameOnBothEngines) {
  int documents_read = 0;
  int numeric = 0;
  for (const fs::path& file : documents()) {
    Diagnostics diagnostics;
    const auto document = read(file, diagnostics);
    ASSERT_NE(document, nullptr) << file << diagnostics.to_string();
    ++documents_read;
    for (const FoundOutput& output : find_outputs(*document)) {
      if (!is_numeric(output.type)) continue;
      ++numeric;
      const std::string place = name_of(file) + ' ' + output.name;
      Diagnostics problems;
      const auto compiled = bake(*document, output.name, options(Backend::jit), problems);
      const auto interpreted =
          bake(*document, output.name, options(Backend::interpreter), problems);
      ASSERT_FALSE(compiled.empty()) << place << problems.to_string();
      EXPECT_EQ(bits(interpreted), bits(compiled)) << place;
      EXPECT_TRUE(std::ranges::all_of(compiled, [](float x) { return std::isfinite(x); })) << place;
      for (const Diagnostic& problem : problems.all()) {
        // Images of the repository that are not among the reference material, and a
        // matrix that has "0.5.0" among its numbers.
        const bool known =
            problem.code == "missing-image" ||
            (problem.code == "number-leftover" && output.name.starts_with("determinant_matrix44"));
        EXPECT_TRUE(known) << place << problem.to_string();
      }
    }
  }
  std::cout << documents_read << " documents, " << numeric << " outputs\n";
  EXPECT_EQ(documents_read, 193);
  EXPECT_EQ(numeric, 710);
}

/// What a conditional node does not take is not computed; nothing shows of it.
TEST_F(Corpus, RecordingBranchesApartChangesNoBit) {
  for (const fs::path& file : documents()) {
    Diagnostics diagnostics;
    const auto document = read(file, diagnostics);
    ASSERT_NE(document, nullptr) << file << diagnostics.to_string();
    for (const FoundOutput& output : find_outputs(*document)) {
      if (!is_numeric(output.type)) continue;
      ShaderOptions eager = options(Backend::interpreter);
      eager.lazy = false;
      EXPECT_EQ(bits(bake(*document, output.name, options(Backend::interpreter), diagnostics)),
                bits(bake(*document, output.name, eager, diagnostics)))
          << name_of(file) << ' ' << output.name;
    }
  }
}

TEST_F(Corpus, EveryMaterialCompiles) {
  int materials = 0;
  for (const fs::path& file : documents()) {
    Diagnostics diagnostics;
    const auto document = read(file, diagnostics);
    ASSERT_NE(document, nullptr) << file << diagnostics.to_string();
    for (const FoundMaterial& material : find_materials(*document)) {
      ++materials;
      const std::string place = name_of(file) + ' ' + material.name;
      Diagnostics problems;
      const auto kernels = system_->compile_material(*document, material.name,
                                                     options(Backend::interpreter), problems);
      EXPECT_EQ(kernels == nullptr, uncompilable().contains(place))
          << place << problems.to_string();
    }
  }
  std::cout << materials << " materials\n";
  EXPECT_EQ(materials, 161);
}

}  // namespace
}  // namespace nacre
