// Files that a host has: includes and images in archives, and elsewhere than their names say.
#include <gtest/gtest.h>

#include <map>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "tests/jit/api/image_points.h"
#include "tests/jit/api/tga.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

/// Files by name, and who asked for which.
struct Archive {
  std::map<std::string, std::string> files;
  std::vector<std::string> asked;

  FileResolver resolver() {
    return [this](const std::string& name, const std::string& named_by,
                  int what) -> std::optional<File> {
      asked.push_back(named_by + (what == NACRE_INCLUDE ? " includes " : " shows ") + name);
      const auto found = files.find(name);
      if (found == files.end()) return {};
      return File{"asset:" + name, found->second};
    };
  }
};

TEST(ApiFiles, IncludesComeFromMemory) {
  Archive archive;
  archive.files["outer.mtlx"] =
      R"(<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
    <xi:include href="inner.mtlx"/></materialx>)";
  archive.files["inner.mtlx"] = R"(<materialx version="1.39"><constant name="c" type="float"/>
    <output name="deep" type="float" nodename="c"/></materialx>)";
  ReadOptions options;
  options.resolver = archive.resolver();
  const Document document = Document::parse(
      R"(<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
         <xi:include href="outer.mtlx"/></materialx>)",
      "main.mtlx", options);
  EXPECT_EQ(document.outputs(), std::vector<std::string>{"deep"});
  EXPECT_EQ(archive.asked, (std::vector<std::string>{"main.mtlx includes outer.mtlx",
                                                     "asset:outer.mtlx includes inner.mtlx"}));
  EXPECT_EQ(document.element(document.find_element("deep")).file, "asset:inner.mtlx");
}

TEST(ApiFiles, WhatIncludesItselfInMemoryIsAnError) {
  Archive archive;
  archive.files["a.mtlx"] = R"(<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
    <xi:include href="a.mtlx"/></materialx>)";
  ReadOptions options;
  options.resolver = archive.resolver();
  try {
    Document::parse(archive.files["a.mtlx"], "main.mtlx", options);
    FAIL() << "read";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics()[0].code, "include-cycle");
  }
  options.max_file_bytes = 10;
  archive.files["a.mtlx"] = "<materialx version=\"1.39\"/>";
  EXPECT_THROW(Document::parse(R"(<materialx version="1.39"/>)", "main.mtlx", options), Error);
}

TEST(ApiFiles, ImagesComeFromMemory) {
  Archive archive;
  archive.files["two.tga"] = tga_of({0xff0000, 0x0000ff});
  SystemOptions options;
  options.resolver = archive.resolver();
  System system(options);
  const Shader shader = system.compile_outputs(image_document("two.tga"), {"out"});
  EXPECT_EQ(colors_at(shader, {0.25f, 0.75f}), (std::vector<Color>{red, blue}));
  EXPECT_EQ(archive.asked, std::vector<std::string>{"image.mtlx shows two.tga"});
  // The same bytes are one texture.
  const Shader again = system.compile_outputs(image_document("two.tga"), {"out"});
  EXPECT_EQ(system.texture_statistics().loads, 1u);
  EXPECT_EQ(colors_at(again, {0.75f}), std::vector<Color>{blue});
}

TEST(ApiFiles, ABrokenImageInMemoryIsComplainedOfByItsName) {
  Archive archive;
  archive.files["broken.tga"] = tga_of({0xff0000}).substr(0, 10);
  SystemOptions options;
  options.resolver = archive.resolver();
  System system(options);
  try {
    system.compile_outputs(image_document("broken.tga"), {"out"});
    FAIL() << "compiled";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("asset:broken.tga"), std::string::npos)
        << error.what();
    EXPECT_EQ(std::string(error.what()).find("/proc"), std::string::npos) << error.what();
  }
}

TEST(ApiFiles, APathOfTheHostsMayLieAnywhere) {
  const TemporaryFolder folder;
  const std::string path = folder.write("there.tga", tga_of({0x00ff00}));
  SystemOptions options;
  options.resolver = [&](const std::string& name, const std::string&, int) -> std::optional<File> {
    if (name != "elsewhere") return {};
    return File{path, {}};
  };
  System system(options);
  const Shader shader = system.compile_outputs(image_document("elsewhere"), {"out"});
  EXPECT_EQ(colors_at(shader, {0.5f}), std::vector<Color>{green});
  // A document itself may not lead there.
  EXPECT_THROW(system.compile_outputs(image_document(path, "other/image.mtlx"), {"out"}), Error);
}

TEST(ApiFiles, WhatTheHostThrowsIsAsIfItHadNothing) {
  SystemOptions options;
  options.resolver = [](const std::string&, const std::string&, int) -> std::optional<File> {
    throw std::runtime_error("no archive");
  };
  System system(options);
  EXPECT_THROW(system.compile_outputs(image_document("nowhere.tga"), {"out"}), Error);
}

}  // namespace
}  // namespace nacre
