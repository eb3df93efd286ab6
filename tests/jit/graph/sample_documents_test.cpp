// Documents that must pass: ours in tests/documents/good, and MaterialX's own.
#include <gtest/gtest.h>

#include "jit/graph/build/builder.h"
#include "jit/graph/check/check.h"
#include "jit/graph/find.h"
#include "tests/jit/graph/build_text.h"
#include "tests/support/materialx_samples.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

// Builds every output, material and loose shader; how many there were.
int build_all(const fs::path& file) {
  Diagnostics diagnostics;
  const auto document = read_document(file, {}, diagnostics);
  EXPECT_NE(document, nullptr) << diagnostics.to_string();
  if (document == nullptr) return 0;
  EXPECT_TRUE(check_document(*document, standard_library(), {}, diagnostics))
      << diagnostics.to_string();
  const Definitions definitions(*document, &standard_library().definitions(), diagnostics);
  std::vector<GraphRequest> requests;
  for (const FoundOutput& output : find_outputs(*document)) {
    requests.push_back({{output.name}, ""});
  }
  for (const FoundMaterial& material : find_materials(*document)) {
    requests.push_back({{}, material.name});
  }
  for (const FoundOutput& shader : find_loose_shaders(*document, definitions)) {
    requests.push_back({{shader.name}, ""});
  }
  for (const GraphRequest& request : requests) {
    const auto graph = build_graph(*document, definitions, request, {}, diagnostics);
    EXPECT_TRUE(graph) << file << "\n" << diagnostics.to_string();
    if (!graph) continue;
    EXPECT_TRUE(verify(*graph, diagnostics)) << file << diagnostics.to_string();
    EXPECT_FALSE(graph->outputs.empty()) << file;
  }
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.to_string();
  return static_cast<int>(requests.size());
}

TEST(SampleDocuments, OursBuild) {
  for (const auto& entry : fs::directory_iterator(source_folder() / "tests/documents/good")) {
    if (entry.path().extension() != ".mtlx") continue;
    EXPECT_GT(build_all(entry.path()), 0) << entry.path();
  }
}

// The whole library: each nodedef alone, with nothing set.
TEST(SampleDocuments, EveryNodeDefOfTheLibraryBuilds) {
  for (const NodeDef* def : standard_library().definitions().all()) {
    GraphBuilder builder(standard_library());
    const auto node = builder.add_node(def->name, "n");
    for (const NodeDefOutput& output : def->outputs) {
      builder.output(std::string(output.name), node, output.name);
    }
    Diagnostics diagnostics;
    const auto graph = builder.finish({}, diagnostics);
    ASSERT_TRUE(graph) << def->name << "\n" << diagnostics.to_string();
    EXPECT_TRUE(diagnostics.all().empty()) << def->name << "\n" << diagnostics.to_string();
    EXPECT_TRUE(verify(*graph, diagnostics)) << def->name << "\n" << diagnostics.to_string();
    EXPECT_EQ(graph->outputs.size(), def->outputs.size());
  }
}

TEST(SampleDocuments, ExamplesBuildEveryOutputAndMaterial) {
  const fs::path folder = materialx_sample("Materials");
  if (folder.empty()) GTEST_SKIP() << "the MaterialX sample documents are not here";
  int documents = 0;
  int requests = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "Examples")) {
    if (entry.path().extension() != ".mtlx") continue;
    ++documents;
    requests += build_all(entry.path());
  }
  EXPECT_EQ(documents, 50);
  EXPECT_GT(requests, 50);
}

TEST(SampleDocuments, CheckingTheTestSuiteNeverCrashes) {
  const fs::path folder = materialx_sample("Materials");
  if (folder.empty()) GTEST_SKIP() << "the MaterialX sample documents are not here";
  int clean = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "TestSuite")) {
    if (entry.path().extension() != ".mtlx") continue;
    Diagnostics diagnostics;
    const auto document = read_document(entry.path(), {}, diagnostics);
    if (document == nullptr) continue;
    if (check_document(*document, standard_library(), {}, diagnostics)) ++clean;
  }
  // Of 143: three are at fault themselves (a nodedef without `node`, twice, and a node
  // nobody defines).
  EXPECT_EQ(clean, 140);
}

}  // namespace
}  // namespace nacre
