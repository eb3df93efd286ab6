#include "examples/common/materialx_libraries.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class MaterialXLibraries : public testing::Test {
 protected:
  fs::path make_library(const fs::path& folder) {
    fs::create_directories(root_ / folder / "stdlib");
    std::ofstream(root_ / folder / "stdlib" / "stdlib_defs.mtlx") << "<materialx/>\n";
    return root_ / folder;
  }

  const TemporaryFolder folder_;
  const fs::path root_ = folder_.path();
};

TEST_F(MaterialXLibraries, InstalledOneWinsOverBuildTree) {
  const fs::path installed = make_library("prefix/share/nacre/libraries");
  const fs::path built = make_library("build");
  EXPECT_EQ(find_materialx_libraries(nullptr, root_ / "prefix/bin/nacre", built), installed);
}

TEST_F(MaterialXLibraries, BuildTreeIsTheLastPlace) {
  const fs::path built = make_library("build");
  EXPECT_EQ(find_materialx_libraries(nullptr, root_ / "prefix/bin/nacre", built), built);
}

TEST_F(MaterialXLibraries, EnvironmentWinsOverBoth) {
  make_library("prefix/share/nacre/libraries");
  const fs::path named = make_library("named");
  EXPECT_EQ(find_materialx_libraries(named.c_str(), root_ / "prefix/bin/nacre", root_ / "none"),
            named);
}

TEST_F(MaterialXLibraries, WrongEnvironmentIsNotPassedOver) {
  const fs::path built = make_library("build");
  const std::string wrong = (root_ / "nowhere").string();
  EXPECT_EQ(find_materialx_libraries(wrong.c_str(), root_ / "prefix/bin/nacre", built), "");
}

TEST_F(MaterialXLibraries, EmptyEnvironmentCountsAsUnset) {
  const fs::path built = make_library("build");
  EXPECT_EQ(find_materialx_libraries("", root_ / "prefix/bin/nacre", built), built);
}

TEST_F(MaterialXLibraries, NothingFoundIsAnEmptyPath) {
  EXPECT_EQ(find_materialx_libraries(nullptr, root_ / "bin/nacre", root_ / "build"), "");
}

TEST(MaterialXLibrary, IsThereForTheTests) {
  const fs::path definitions = fs::path(NACRE_MATERIALX_LIBRARIES_DIR) / "stdlib/stdlib_defs.mtlx";
  ASSERT_TRUE(fs::exists(definitions)) << definitions << ": run `make materialx`";
  std::ifstream file(definitions);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(text.find("<materialx version=\"1.39\""), std::string::npos);
}

}  // namespace
}  // namespace nacre
