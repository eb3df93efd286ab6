#include "jit/document/read.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "jit/document/names.h"
#include "tests/support/materialx_samples.h"
#include "tests/support/standard_library.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

// Files in a folder of their own, gone at the end of the test.
class Files : public ::testing::Test {
 protected:
  fs::path write(const fs::path& name, std::string_view body, std::string_view attributes = "") {
    fs::create_directories((folder / name).parent_path());
    std::ofstream out(folder / name, std::ios::binary);
    out << "<materialx version=\"1.39\" " << attributes << ">\n" << body << "</materialx>\n";
    return folder / name;
  }

  std::unique_ptr<Document> read(const fs::path& name, const ReadOptions& options = {}) {
    diagnostics = {};
    return read_document(folder / name, options, diagnostics);
  }

  const TemporaryFolder temporary;
  const fs::path folder = temporary.path();
  Diagnostics diagnostics;
};

std::string code_of(const Diagnostics& diagnostics) {
  return diagnostics.all().empty() ? "" : diagnostics.all().front().code;
}

TEST(Document, KeepsPlacesOfElements) {
  Diagnostics diagnostics;
  const auto document = document_of(
      "<nodegraph name=\"NG\">\n"
      "  <mix name=\"m\" type=\"float\">\n"
      "    <input name=\"fg\" type=\"float\" value=\"1\"/>\n"
      "  </mix>\n"
      "</nodegraph>\n",
      diagnostics);
  ASSERT_NE(document, nullptr);
  const Element* input = document->root().child("NG")->child("m")->child("fg");
  ASSERT_NE(input, nullptr);
  const SourceLocation where = location(*input);
  EXPECT_EQ(where.file, "test.mtlx");
  EXPECT_EQ(where.line, 4);
  EXPECT_EQ(where.column, 6);
  EXPECT_EQ(where.path, "NG/m/fg");
}

TEST(Document, TakesRawAngleBracketsAndUnboundPrefixes) {
  Diagnostics diagnostics;
  const auto document = document_of(
      "<my:image name=\"i\" type=\"color3\">\n"
      "  <input name=\"file\" type=\"filename\" value=\"a_<UDIM>_<UVTILE>.exr\"/>\n"
      "</my:image>\n",
      diagnostics);
  ASSERT_NE(document, nullptr) << diagnostics.to_string();
  const Element& image = *document->root().child("i");
  EXPECT_EQ(image.category(), "my:image");
  EXPECT_EQ(image.child("file")->attribute("value"), "a_<UDIM>_<UVTILE>.exr");
}

TEST(Document, SkipsByteOrderMarkAndDecodesReferences) {
  Diagnostics diagnostics;
  const auto document = read_document_text(
      "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">"
      "<constant name=\"c\" doc=\"a &lt; b &#x41;\"/></materialx>",
      "bom.mtlx", {}, diagnostics);
  ASSERT_NE(document, nullptr) << diagnostics.to_string();
  EXPECT_EQ(document->root().child("c")->attribute("doc"), "a < b A");
  EXPECT_EQ(document->line_of(*document->root().child("c")), 2);
}

TEST(Document, FindsChildrenInLargeScopes) {
  std::string body;
  for (int i = 0; i < 5000; ++i) body += "<constant name=\"c" + std::to_string(i) + "\"/>\n";
  Diagnostics diagnostics;
  const auto document = document_of(body, diagnostics);
  ASSERT_NE(document, nullptr);
  EXPECT_EQ(document->root().child_count(), 5000u);
  EXPECT_EQ(document->line_of(*document->root().child("c4321")), 4323);
  EXPECT_EQ(document->root().child("c5000"), nullptr);
}

TEST(Document, NamesFollowTheStandard) {
  for (const char* name : {"a", "_", "A9_z", "ns:a", "ns:more:a"}) EXPECT_TRUE(is_valid_name(name));
  for (const char* name : {"", "9a", "a b", "a-b", ":a", "a:", "a::b", "a.b", "\xC3\xA9"}) {
    EXPECT_FALSE(is_valid_name(name)) << name;
  }
}

TEST(Document, NestingIsLimited) {
  const auto nested = [](int depth) {
    std::string body;
    for (int i = 0; i < depth; ++i) body += "<nodegraph>";
    for (int i = 0; i < depth; ++i) body += "</nodegraph>";
    return body;
  };
  Diagnostics diagnostics;
  EXPECT_NE(document_of(nested(255), diagnostics), nullptr);
  EXPECT_EQ(document_of(nested(256), diagnostics), nullptr);
  EXPECT_EQ(code_of(diagnostics), "too-deep");
  Diagnostics bomb;
  EXPECT_EQ(document_of(nested(1'000'000), bomb), nullptr);
  EXPECT_EQ(code_of(bomb), "too-deep");
}

TEST(Document, SizeIsLimited) {
  ReadOptions options;
  options.limits.elements = 10;
  std::string text = "<materialx version=\"1.39\">";
  for (int i = 0; i < 30; ++i) text += "<backdrop/>";
  text += "</materialx>";
  Diagnostics diagnostics;
  EXPECT_EQ(read_document_text(text, "x", options, diagnostics), nullptr);
  EXPECT_EQ(code_of(diagnostics), "too-many-elements");
  options.limits.file_bytes = 100;
  Diagnostics bytes;
  EXPECT_EQ(read_document_text(text, "x", options, bytes), nullptr);
  EXPECT_EQ(code_of(bytes), "file-too-large");
}

TEST(Document, CutAnywhereItDoesNotCrash) {
  const std::string text =
      "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\" colorspace=\"lin_rec709\">\n"
      "<!-- note --><nodegraph name=\"NG\"><mix name=\"m\" type=\"float\"><input name=\"fg\" "
      "type=\"float\" value=\"&quot;1\"/></mix></nodegraph><![CDATA[x]]></materialx>\n";
  for (std::size_t size = 0; size < text.size() - 1; ++size) {
    Diagnostics diagnostics;
    EXPECT_EQ(read_document_text(text.substr(0, size), "cut", {}, diagnostics), nullptr) << size;
    EXPECT_TRUE(diagnostics.has_errors()) << size;
  }
  Diagnostics diagnostics;
  EXPECT_NE(read_document_text(text, "whole", {}, diagnostics), nullptr);
}

TEST(Document, ChangedBytesDoNotCrashIt) {
  const std::string text =
      "<materialx version=\"1.39\"><xi:include href=\"no\"/><look name=\"l\"/><mix name=\"m\" "
      "type=\"float\"><input name=\"fg\" type=\"float\" value=\"1\"/></mix></materialx>";
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (int byte = 0; byte < 256; byte += 5) {
      std::string changed = text;
      changed[at] = static_cast<char>(byte);
      Diagnostics diagnostics;
      read_document_text(changed, "changed", {}, diagnostics);
    }
  }
}

using Include = Files;

std::string numbered(int i) { return fmt::format("f{}.mtlx", i); }
std::string include_of(int i) { return fmt::format("<xi:include href=\"{}\"/>\n", numbered(i)); }

TEST_F(Include, IncludedDefinitionWinsOverLocalDuplicate) {
  write("lib/a.mtlx", "<constant name=\"c\" type=\"color3\"/>\n<constant name=\"d\"/>\n");
  write("main.mtlx", "<constant name=\"c\" type=\"float\"/>\n<xi:include href=\"lib/a.mtlx\"/>\n");
  const auto document = read("main.mtlx");
  ASSERT_NE(document, nullptr) << diagnostics.to_string();
  const Element& root = document->root();
  EXPECT_EQ(root.child_count(), 2u);
  EXPECT_EQ(root.child("c")->attribute("type"), "color3");
  EXPECT_EQ(fs::path(location(*root.child("c")).file).filename(), "a.mtlx");
  EXPECT_EQ(location(*root.child("c")).line, 2);
}

TEST_F(Include, FirstOfTwoIncludesWins) {
  write("a.mtlx", "<constant name=\"c\" type=\"float\"/>\n");
  write("b.mtlx", "<constant name=\"c\" type=\"color3\"/>\n");
  write("main.mtlx", "<xi:include href=\"b.mtlx\"/><xi:include href=\"a.mtlx\"/>");
  const auto document = read("main.mtlx");
  ASSERT_NE(document, nullptr);
  EXPECT_EQ(document->root().child("c")->attribute("type"), "color3");
}

TEST_F(Include, IsRelativeToTheIncludingFile) {
  write("deep/er/b.mtlx", "<constant name=\"b\"/>\n");
  write("deep/a.mtlx", "<xi:include href=\"er/b.mtlx\"/>\n");
  write("main.mtlx", "<xi:include href=\"deep/a.mtlx\"/>\n");
  const auto document = read("main.mtlx");
  ASSERT_NE(document, nullptr) << diagnostics.to_string();
  EXPECT_NE(document->root().child("b"), nullptr);
}

TEST_F(Include, FallsBackToSearchPaths) {
  write("elsewhere/a.mtlx", "<constant name=\"a\"/>\n");
  write("main/main.mtlx", "<xi:include href=\"a.mtlx\"/>\n");
  EXPECT_EQ(read("main/main.mtlx"), nullptr);
  EXPECT_EQ(code_of(diagnostics), "include-not-found");
  ReadOptions options;
  options.search_paths = {folder / "elsewhere"};
  EXPECT_NE(read("main/main.mtlx", options), nullptr) << diagnostics.to_string();
}

TEST_F(Include, PushesRootAttributesToChildrenThatLackThem) {
  write("a.mtlx", "<image name=\"i\"/>\n<image name=\"j\" colorspace=\"raw\"/>\n",
        "colorspace=\"acescg\" fileprefix=\"tex/\" geomprefix=\"/a\"");
  write("main.mtlx", "<xi:include href=\"a.mtlx\"/><image name=\"k\"/>",
        "colorspace=\"lin_rec709\"");
  const auto document = read("main.mtlx");
  ASSERT_NE(document, nullptr);
  const Element& root = document->root();
  EXPECT_EQ(root.child("i")->inherited_attribute("colorspace"), "acescg");
  EXPECT_EQ(root.child("i")->attribute("fileprefix"), "tex/");
  EXPECT_EQ(root.child("i")->attribute("geomprefix"), "/a");
  EXPECT_EQ(root.child("j")->inherited_attribute("colorspace"), "raw");
  EXPECT_EQ(root.child("k")->inherited_attribute("colorspace"), "lin_rec709");
  EXPECT_EQ(root.child("k")->inherited_attribute("fileprefix"), "");
}

TEST_F(Include, NamespacePrefixesNames) {
  write("a.mtlx", "<constant name=\"c\"/>\n<constant name=\"o\" namespace=\"other\"/>\n",
        "namespace=\"lib\"");
  write("main.mtlx", "<constant name=\"c\"/>\n<xi:include href=\"a.mtlx\"/>\n");
  const auto document = read("main.mtlx");
  ASSERT_NE(document, nullptr);
  EXPECT_NE(document->root().child("lib:c"), nullptr);
  EXPECT_NE(document->root().child("other:o"), nullptr);
  EXPECT_NE(document->root().child("c"), nullptr);
}

TEST_F(Include, SymbolicLinksDoNotLeadOutside) {
  write("outside/secret.mtlx", "<constant name=\"c\"/>\n");
  write("inside/main.mtlx", "<xi:include href=\"link.mtlx\"/>\n");
  fs::create_symlink(folder / "outside/secret.mtlx", folder / "inside/link.mtlx");
  EXPECT_EQ(read("inside/main.mtlx"), nullptr);
  EXPECT_EQ(code_of(diagnostics), "include-outside");
  ReadOptions options;
  options.includes_anywhere = true;
  EXPECT_NE(read("inside/main.mtlx", options), nullptr);
}

TEST_F(Include, DepthIsLimited) {
  for (int i = 0; i < 20; ++i) {
    write(numbered(i), include_of(i + 1));
  }
  write("f20.mtlx", "<constant name=\"end\"/>\n");
  ReadOptions options;
  options.limits.include_depth = 21;
  EXPECT_NE(read("f0.mtlx", options), nullptr) << diagnostics.to_string();
  options.limits.include_depth = 20;
  EXPECT_EQ(read("f0.mtlx", options), nullptr);
  EXPECT_EQ(code_of(diagnostics), "include-depth");
}

TEST_F(Include, DoublingIncludesStopAtTheFileLimit) {
  for (int i = 0; i < 40; ++i) {
    write(numbered(i), include_of(i + 1) + include_of(i + 1));
  }
  write("f40.mtlx", "<constant name=\"end\"/>\n");
  EXPECT_EQ(read("f0.mtlx"), nullptr);
  EXPECT_EQ(code_of(diagnostics), "too-many-includes");
}

TEST_F(Include, OldVersionsLoadWhenNothingChanged) {
  std::ofstream(folder / "old.mtlx")
      << "<materialx version=\"1.38\"><constant name=\"c\" type=\"float\"/></materialx>";
  EXPECT_NE(read("old.mtlx"), nullptr) << diagnostics.to_string();
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.to_string();
}

TEST(SampleDocuments, AllLoadWithoutCrash) {
  const fs::path folder = materialx_sample("Materials");
  if (folder.empty()) GTEST_SKIP() << "the MaterialX sample documents are not here";
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".mtlx") continue;
    ++count;
    Diagnostics diagnostics;
    const auto document = read_document(entry.path(), {}, diagnostics);
    EXPECT_NE(document, nullptr) << entry.path();
    EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.to_string();
  }
  EXPECT_EQ(count, 193);
}

}  // namespace
}  // namespace nacre
