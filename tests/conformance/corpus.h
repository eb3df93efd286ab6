#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/support/materialx_samples.h"

namespace nacre {

/// All of MaterialX's own documents.
class Corpus : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = materialx_sample("Materials");
    if (folder_.empty()) GTEST_SKIP() << "the MaterialX sample documents are not here";
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
    // The documents name images as "resources/Images/..." from MaterialX's own root.
    images_ =
        std::filesystem::temp_directory_path() / std::to_string(getpid()).append("_nacre_corpus");
    std::filesystem::create_directories(images_);
    std::filesystem::create_directory_symlink(std::filesystem::absolute(folder_.parent_path()),
                                              images_ / "resources");
  }

  void TearDown() override {
    if (!images_.empty()) std::filesystem::remove_all(images_);
  }

  std::unique_ptr<Document> read(const std::filesystem::path& file,
                                 Diagnostics& diagnostics) const {
    ReadOptions options;
    options.includes_anywhere = true;
    return read_document(file, options, diagnostics);
  }

  std::string name_of(const std::filesystem::path& file) const {
    return std::filesystem::relative(file, folder_).string();
  }

  ShaderOptions options(Backend backend) const {
    ShaderOptions result;
    result.compile.backend = backend;
    result.search_paths = {images_};
    result.files_anywhere = true;
    return result;
  }

  std::vector<std::filesystem::path> documents() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      if (entry.path().extension() == ".mtlx") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  std::filesystem::path folder_;
  std::filesystem::path images_;
  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

}  // namespace nacre
