#include "jit/document/write.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/jit/document/tree_text.h"
#include "tests/support/materialx_samples.h"
#include "tests/support/standard_library.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<Document> parse(std::string_view text, const std::string& name = "test.mtlx") {
  Diagnostics diagnostics;
  ReadOptions options;
  options.keep_comments = true;
  auto document = read_document_text(text, name, options, diagnostics);
  EXPECT_NE(document, nullptr) << diagnostics.to_string();
  return document;
}

TEST(WriteDocument, TextInItsOwnStyleStaysAsItIs) {
  const std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- A licence. -->\n"
      "<materialx version=\"1.39\" colorspace=\"lin_rec709\" require=\"thing\">\n"
      "  <!-- of <c> & co. -->\n"
      "  <constant name=\"c\" type=\"float\" ldx_value=\"1\" />\n"
      "\n"
      "  <?tool keep this?>\n"
      "  <studio:unknown>\n"
      "    <part of=\"it\" />\n"
      "    <!-- the end of it -->\n"
      "  </studio:unknown>\n"
      "  <note>five &lt; six<b />, <![CDATA[ <raw> ]]></note>\n"
      "</materialx>\n"
      "<!-- after all -->\n";
  EXPECT_EQ(write_document(*parse(text)), text);
}

TEST(WriteDocument, ReservedCharactersComeBack) {
  const auto document = parse(
      "<materialx version=\"1.39\"><image name=\"i\" doc='say \"a &amp; b\"&#10;&#9;&lt;'>"
      "<input name=\"file\" type=\"filename\" value=\"a.<UDIM>.exr\"/></image></materialx>");
  const std::string text = write_document(*document);
  EXPECT_NE(text.find("a.&lt;UDIM>.exr"), std::string::npos) << text;
  const auto again = parse(text);
  EXPECT_EQ(again->root().child("i")->attribute("doc"), "say \"a & b\"\n\t<");
  EXPECT_EQ(again->root().child("i")->child("file")->attribute("value"), "a.<UDIM>.exr");
}

TEST(WriteDocument, CommentsStayBesideWhatReplacesTheirElement) {
  const std::string text = write_document(
      *parse("<materialx version=\"1.37\">\n<!-- red -->\n<material name=\"M\">\n"
             "<!-- shiny -->\n<shaderref name=\"S\" node=\"standard_surface\"/>\n</material>\n"
             "<!-- end --></materialx>\n"));
  const std::size_t red = text.find("<!-- red -->");
  const std::size_t shiny = text.find("<!-- shiny -->");
  const std::size_t shader = text.find("<standard_surface");
  const std::size_t end = text.find("<!-- end -->");
  EXPECT_LT(red, shader);
  EXPECT_NE(shiny, std::string::npos);
  EXPECT_LT(shader, end);
  EXPECT_NE(end, std::string::npos) << text;
}

class WriteInclude : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "sub");
    write("sub/a.mtlx",
          "<materialx version=\"1.39\" namespace=\"lib\" fileprefix=\"tex/\">"
          "<image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" "
          "value=\"x.png\"/></image><constant name=\"k\" type=\"float\"/></materialx>");
    write("main.mtlx",
          "<materialx version=\"1.39\">\n  <!-- theirs -->\n  <xi:include href=\"sub/a.mtlx\" />\n"
          "  <!-- ours -->\n  <constant name=\"c\" type=\"float\" />\n</materialx>\n");
  }

  void write(const fs::path& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::unique_ptr<Document> read(const fs::path& name) {
    Diagnostics diagnostics;
    ReadOptions options;
    options.keep_comments = true;
    auto document = read_document(folder_ / name, options, diagnostics);
    EXPECT_NE(document, nullptr) << diagnostics.to_string();
    return document;
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(WriteInclude, StaysAnInclude) {
  EXPECT_EQ(write_document(*read("main.mtlx")),
            "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">\n  <!-- theirs -->\n"
            "  <xi:include href=\"sub/a.mtlx\" />\n  <!-- ours -->\n"
            "  <constant name=\"c\" type=\"float\" />\n</materialx>\n");
}

TEST_F(WriteInclude, IsWrittenOutWhenFlattened) {
  write("flat.mtlx", write_document(*read("main.mtlx"), {.flatten = true}));
  const auto flat = read("flat.mtlx");
  const Element& root = flat->root();
  EXPECT_EQ(flat->files().size(), 1u);
  ASSERT_EQ(root.child_count(), 3u);
  ASSERT_NE(root.child("lib:i"), nullptr);
  // Files are where they were, seen from the folder of the whole.
  EXPECT_EQ(root.child("lib:i")->attribute("fileprefix"), "sub/tex/");
  EXPECT_EQ(root.child("lib:k")->attribute("namespace"), "lib");
  EXPECT_NE(root.child("c"), nullptr);
}

// Reads, writes and reads again, as it is and flattened.
void check_round_trip(const fs::path& file) {
  SCOPED_TRACE(file);
  Diagnostics diagnostics;
  ReadOptions options;
  options.keep_comments = true;
  const auto document = read_document(file, options, diagnostics);
  ASSERT_NE(document, nullptr) << diagnostics.to_string();
  for (const bool flatten : {false, true}) {
    const std::string text = write_document(*document, {.flatten = flatten});
    const auto again = read_document_text(text, file.string(), options, diagnostics);
    ASSERT_NE(again, nullptr) << diagnostics.to_string();
    EXPECT_EQ(write_document(*again, {.flatten = flatten}), text);
    if (!flatten) {
      EXPECT_EQ(tree_text(*again), tree_text(*document));
    }
  }
  // What stands between elements makes no other tree.
  const auto plain = read_document(file, {}, diagnostics);
  EXPECT_EQ(tree_text(*plain), tree_text(*document));
}

int check_folder(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".mtlx") continue;
    check_round_trip(entry.path());
    ++count;
  }
  return count;
}

TEST(WriteDocument, OurExamplesComeBackEqual) {
  EXPECT_GT(check_folder(source_folder() / "examples/documents"), 5);
  EXPECT_GT(check_folder(source_folder() / "tests/documents/good"), 1);
  EXPECT_GT(check_folder(standard_library_folder()), 20);
}

TEST(WriteDocument, MaterialXSamplesComeBackEqual) {
  const fs::path folder = materialx_sample("Materials");
  if (folder.empty()) GTEST_SKIP() << "the MaterialX sample documents are not here";
  EXPECT_EQ(check_folder(folder), 193);
}

}  // namespace
}  // namespace nacre
