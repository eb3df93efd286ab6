#include "tests/conformance/corpus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "examples/bake/bake.h"
#include "jit/graph/find.h"

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

/// Every numeric output through the compiler and the interpreter, whose texels must be the same
/// bits.
class CorpusBakes : public Corpus {
 protected:
  /// The texels of one output; empty if it does not compile.
  std::vector<float> bake(const Document& document, const std::string& output,
                          const ShaderOptions& options, Diagnostics& diagnostics) {
    const auto kernel = system_->compile_outputs(document, {output}, options, diagnostics);
    if (kernel == nullptr) return {};
    return host::bake_image(*kernel, 0, {.width = 7, .height = 5, .threads = 1});
  }
};

std::vector<std::uint32_t> bits(const std::vector<float>& texels) {
  std::vector<std::uint32_t> result;
  for (const float texel : texels) result.push_back(std::bit_cast<std::uint32_t>(texel));
  return result;
}

TEST_F(CorpusBakes, EveryNumericOutputIsFiniteAndTheSameOnBothEngines) {
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
TEST_F(CorpusBakes, RecordingBranchesApartChangesNoBit) {
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
