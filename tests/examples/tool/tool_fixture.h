#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/common/materialx_libraries.h"
#include "jit/document/read.h"
#include "jit/graph/find.h"
#include "jit/shading/shading_system.h"
#include "tests/support/temporary_folder.h"

namespace nacre {

inline std::string text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Runs the tool in a folder of its own, and evaluates documents beside it.
class Tool : public ::testing::Test {
 protected:
  void SetUp() override {
    Diagnostics diagnostics;
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics);
    ASSERT_NE(system_, nullptr) << diagnostics.to_string();
  }

  std::string file(std::string_view name) const { return folder_.file(name); }
  std::string write(std::string_view name, std::string_view text) const {
    return folder_.write(name, text);
  }

  /// The exit status of `nacre ARGUMENTS`; what it says is `errors_` and `printed_`.
  int run(const std::string& arguments) { return shell(std::string(NACRE_TOOL) + " " + arguments); }

  /// The same of a command line of the shell, in which the tool is $NACRE.
  int shell(const std::string& line) {
    const std::string command = "NACRE='" + std::string(NACRE_TOOL) + "'; { " + line + "\n} >" +
                                file("stdout") + " 2>" + file("stderr");
    const int status = std::system(command.c_str());
    errors_ = text_of(file("stderr"));
    printed_ = text_of(file("stdout"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  bool says(std::string_view text) const { return errors_.find(text) != std::string::npos; }

  /// Names of all that is in a folder, hidden or not, sorted.
  std::set<std::string> names_in(const std::string& folder) const {
    std::set<std::string> names;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  std::unique_ptr<Document> read(const std::string& path) {
    Diagnostics diagnostics;
    ReadOptions options;
    options.includes_anywhere = true;
    auto document = read_document(path, options, diagnostics);
    EXPECT_NE(document, nullptr) << diagnostics.to_string();
    return document;
  }

  /// The texels of an output or node; none after an error.
  std::vector<float> values(const Document& document, const std::string& name, int size) {
    Diagnostics diagnostics;
    const auto kernel = system_->compile_outputs(document, {name}, {}, diagnostics);
    EXPECT_NE(kernel, nullptr) << name << "\n" << diagnostics.to_string();
    if (kernel == nullptr) return {};
    return host::bake_image(*kernel, 0, {.width = size, .height = size, .threads = 1});
  }

  TemporaryFolder folder_;
  std::unique_ptr<ShadingSystem> system_;
  std::string errors_;
  std::string printed_;
};

}  // namespace nacre
