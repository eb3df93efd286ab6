#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "examples/bake/bake.h"
#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr int size = 32;

/// Documents that differ, each with the reason. All others must match.
const std::map<std::string, std::string>& exceptions() {
  static const std::string smart_cubic =
      "OSL's texture() is bicubic near level 0 unless told otherwise, and the OSL text does not "
      "say; the GLSL text, and ours, are linear";
  static const std::map<std::string, std::string> known{
      {"ND_facingratio_float", "the reference was computed without a viewer"},
      {"ND_hextiledimage_color3", smart_cubic},
      {"ND_hextiledimage_color4", smart_cubic},
      {"ND_hextilednormalmap_vector3",
       "the OSL implementation normalizes `strength` away; the GLSL one, and ours, do not"},
      {"ND_latlongimage",
       "OSL's derivative of atan2 has the wrong sign, so its footprint is mirrored; with that sign "
       "OpenImageIO's filter gives the reference everywhere"},
      {"ND_unifiednoise2d_float",
       "reference engine only: in double, points on a cell's edge fall to the other side"},
      {"ND_transformmatrix_vector3M4",
       "OSL transforms a vector, without translation; the GLSL implementation appends 1"},
  };
  return known;
}

constexpr int texels = size * size;

/// Channel after channel, as README.md says; empty if there is no such file.
std::vector<float> read_reference(const fs::path& file) {
  static_assert(std::endian::native == std::endian::little);
  std::ifstream in(file, std::ios::binary);
  std::vector<float> values;
  for (float value = 0; in.read(reinterpret_cast<char*>(&value), sizeof value);) {
    values.push_back(value);
  }
  return values;
}

/// The share of texels all of whose channels match: |a - b| <= 1e-4 + 1e-3 |b|.
double matching_share(const std::vector<float>& ours, int our_channels,
                      const std::vector<float>& reference) {
  const int compared = std::min(our_channels, static_cast<int>(reference.size()) / texels);
  int matches = 0;
  for (int i = 0; i < texels; ++i) {
    bool same = true;
    for (int c = 0; c < compared; ++c) {
      const float a = ours[static_cast<std::size_t>(i * our_channels + c)];
      const float b = reference[static_cast<std::size_t>(c * texels + i)];
      same = same && std::fabs(a - b) <= 1e-4f + 1e-3f * std::fabs(b);
    }
    matches += same;
  }
  return static_cast<double>(matches) / texels;
}

class Conformance : public ::testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  /// Empty if every output of the document matches; else what does not.
  std::string compare(const std::string& nodedef, const nlohmann::json& outputs) {
    Diagnostics diagnostics;
    const fs::path file = folder_ / "documents" / (nodedef + ".mtlx");
    const auto document = read_document(file, {}, diagnostics);
    if (document == nullptr) return "does not load: " + diagnostics.to_string();
    ShaderOptions options;
    options.compile.backend = GetParam();
    std::string problems;
    for (const auto& output : outputs) {
      const std::string name = output["output"];
      const auto kernel = system_->compile_outputs(*document, {name}, options, diagnostics);
      if (kernel == nullptr) return name + " does not compile: " + diagnostics.to_string();
      const std::vector<float> ours =
          host::bake_image(*kernel, 0, {.width = size, .height = size, .threads = 1});
      std::string flat = name;
      std::replace(flat.begin(), flat.end(), '/', '.');
      const std::vector<float> reference =
          read_reference(folder_ / "values" / nodedef / (flat + ".f32"));
      if (reference.empty() || reference.size() % texels != 0) return name + " has no values";
      const double share =
          matching_share(ours, component_count(kernel->outputs[0].type), reference);
      const double needed = nodedef.starts_with("ND_range_") ? 0.97 : 0.99;
      if (share < needed) problems += name + " " + std::to_string(share) + "; ";
    }
    return problems;
  }

  const fs::path folder_ = NACRE_CONFORMANCE_NODES;
  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

TEST_P(Conformance, NodesMatchTheReferenceValues) {
  nlohmann::json manifest;
  std::ifstream(folder_ / "manifest.json") >> manifest;
  EXPECT_EQ(manifest.size(), 715u);
  int matching = 0;
  int unexpected = 0;
  std::string differing;
  for (const auto& [nodedef, outputs] : manifest.items()) {
    const std::string problem = compare(nodedef, outputs);
    if (problem.empty()) {
      ++matching;
      // One engine may match where another does not; a list that no engine needs is wrong.
      if (GetParam() != Backend::reference && exceptions().contains(nodedef) &&
          nodedef != "ND_unifiednoise2d_float") {
        differing += "  " + nodedef + " matches, but is listed as an exception\n";
        ++unexpected;
      }
      continue;
    }
    const auto known = exceptions().find(nodedef);
    differing += "  " + nodedef + ": " + problem;
    differing += (known == exceptions().end() ? "UNEXPECTED" : known->second) + "\n";
    unexpected += known == exceptions().end();
  }
  std::cout << matching << " of " << manifest.size() << " documents match\n" << differing;
  EXPECT_EQ(unexpected, 0) << differing;
}

INSTANTIATE_TEST_SUITE_P(Engines, Conformance,
                         ::testing::Values(Backend::jit, Backend::interpreter, Backend::reference),
                         [](const auto& instance) {
                           switch (instance.param) {
                             case Backend::jit: return "jit";
                             case Backend::interpreter: return "interpreter";
                             default: return "reference";
                           }
                         });

}  // namespace
}  // namespace nacre
