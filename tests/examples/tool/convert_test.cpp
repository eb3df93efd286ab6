#include <filesystem>

#include "jit/document/select.h"
#include "tests/examples/tool/tool_fixture.h"
#include "tests/support/materialx_samples.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class Convert : public Tool {
 protected:
  /// Names of all that has texels: outputs, and numeric nodes at the root.
  static std::vector<std::string> numeric_names(const Document& document) {
    std::vector<std::string> names;
    for (const FoundOutput& output : find_outputs(document)) {
      if (is_numeric(output.type)) names.push_back(output.name);
    }
    for (const Element& child : document.root().children()) {
      const auto type = parse_type(child.attribute("type"));
      if (is_node(child) && type && is_numeric(*type)) names.emplace_back(child.name());
    }
    return names;
  }

  /// Converts, and compares every texel of both documents.
  int expect_same_values(const std::string& from, const std::string& to,
                         const std::string& options = "") {
    EXPECT_EQ(run("convert " + from + " --out " + to + " " + options), 0) << errors_;
    const auto before = read(from);
    const auto after = read(to);
    if (before == nullptr || after == nullptr) return 0;
    EXPECT_EQ(after->root().attribute("version"), "1.39");
    int count = 0;
    for (const std::string& name : numeric_names(*before)) {
      EXPECT_EQ(values(*before, name, 8), values(*after, name, 8)) << name;
      ++count;
    }
    return count;
  }
};

// Nodes of old versions with values worked out by hand.
TEST_F(Convert, OldNodesKeepTheirValues) {
  const std::string from = write("old.mtlx", R"(<?xml version="1.0"?>
<materialx version="1.36">
  <compare name="below" type="float">
    <input name="intest" type="float" value="0.5"/><parameter name="cutoff" type="float" value="0.6"/>
    <input name="in1" type="float" value="1"/><input name="in2" type="float" value="2"/>
  </compare>
  <compare name="above" type="float">
    <input name="intest" type="float" value="0.7"/><parameter name="cutoff" type="float" value="0.6"/>
    <input name="in1" type="float" value="1"/><input name="in2" type="float" value="2"/>
  </compare>
  <atan2 name="angle" type="float">
    <input name="in1" type="float" value="1"/><input name="in2" type="float" value="0"/>
  </atan2>
  <combine name="three" type="color3">
    <input name="in1" type="float" value="1"/><input name="in2" type="float" value="2"/>
    <input name="in3" type="float" value="3"/>
  </combine>
  <separate name="parts" type="multioutput"><input name="in" type="color3" nodename="three"/></separate>
  <absval name="middle" type="float"><input name="in" type="float" nodename="parts" output="outg"/></absval>
  <swizzle name="turned" type="color3">
    <input name="in" type="color3" nodename="three"/><parameter name="channels" type="string" value="b1r"/>
  </swizzle>
  <absval name="blue" type="float"><input name="in" type="float" nodename="three" channels="b"/></absval>
  <invert name="halved" type="matrix33">
    <input name="in" type="matrix33" value="2,0,0, 0,2,0, 0,0,2"/>
  </invert>
  <transformpoint name="moved" type="vector3">
    <input name="in" type="vector3" value="1,2,3"/><input name="mat" type="matrix33" nodename="halved"/>
  </transformpoint>
  <switch name="first" type="float">
    <input name="in1" type="float" value="7"/><input name="in6" type="float" value="8"/>
    <parameter name="which" type="float" value="5"/>
  </switch>
</materialx>
)");
  EXPECT_EQ(expect_same_values(from, file("new.mtlx")), 11);
  const auto document = read(file("new.mtlx"));
  const auto value = [&](const std::string& name) { return values(*document, name, 1); };
  EXPECT_EQ(value("below"), std::vector<float>{1});
  EXPECT_EQ(value("above"), std::vector<float>{2});
  EXPECT_EQ(value("angle"), std::vector<float>{0});  // atan2(y = 0, x = 1)
  EXPECT_EQ(value("middle"), std::vector<float>{2});
  EXPECT_EQ(value("turned"), (std::vector<float>{3, 1, 1}));
  EXPECT_EQ(value("blue"), std::vector<float>{3});
  EXPECT_EQ(value("moved"), (std::vector<float>{0.5f, 1, 1.5f}));
  EXPECT_EQ(value("first"), std::vector<float>{7});
}

TEST_F(Convert, ObjectSpaceNormalsAreDecoded) {
  const std::string from = write("old.mtlx", R"(<materialx version="1.38">
  <normalmap name="n" type="vector3">
    <input name="in" type="vector3" value="0.8, 0.5, 0.9"/>
    <input name="space" type="string" value="object"/>
  </normalmap>
</materialx>)");
  EXPECT_EQ(expect_same_values(from, file("new.mtlx")), 3);
  const auto document = read(file("new.mtlx"));
  const std::vector<float> n = values(*document, "n", 1);
  ASSERT_EQ(n.size(), 3u);
  EXPECT_NEAR(n[0], 0.6, 1e-6);
  EXPECT_NEAR(n[1], 0.0, 1e-6);
  EXPECT_NEAR(n[2], 0.8, 1e-6);
}

TEST_F(Convert, DocumentsOfMaterialXKeepTheirValues) {
  const fs::path folder = materialx_sample("Materials/TestSuite/stdlib/upgrade");
  if (folder.empty()) GTEST_SKIP() << "the MaterialX sample documents are not here";
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    count += expect_same_values(entry.path().string(), file(entry.path().filename().string()));
  }
  EXPECT_GT(count, 25);
}

TEST_F(Convert, IncludesStayUnlessFlattened) {
  fs::create_directory(folder_.path() / "sub");
  write("sub/a.mtlx", R"(<materialx version="1.37">
  <atan2 name="a" type="float"><input name="in1" type="float" value="1"/></atan2></materialx>)");
  const std::string main = write("main.mtlx", R"(<materialx version="1.39">
  <!-- a note --><xi:include href="sub/a.mtlx"/><constant name="c" type="float"/></materialx>)");
  EXPECT_EQ(expect_same_values(main, file("kept.mtlx")), 2);
  EXPECT_NE(text_of(file("kept.mtlx")).find("<xi:include href=\"sub/a.mtlx\" />"),
            std::string::npos);
  EXPECT_NE(text_of(file("kept.mtlx")).find("<!-- a note -->"), std::string::npos);
  EXPECT_EQ(expect_same_values(main, file("flat.mtlx"), "--flatten"), 2);
  EXPECT_EQ(text_of(file("flat.mtlx")).find("xi:include"), std::string::npos);
  EXPECT_NE(text_of(file("flat.mtlx")).find("<input name=\"inx\""), std::string::npos);
}

TEST_F(Convert, WhatFailsLeavesNoFile) {
  const std::string bad = write("bad.mtlx", R"(<materialx version="1.38">
  <arrayappend name="a" type="floatarray"/></materialx>)");
  EXPECT_EQ(run("convert " + bad + " --out " + file("out.mtlx")), 1);
  EXPECT_NE(errors_.find("bad.mtlx:2:4: error"), std::string::npos) << errors_;
  EXPECT_FALSE(fs::exists(file("out.mtlx")));
  EXPECT_EQ(run("convert " + bad), 2);
  EXPECT_EQ(run("convert --help"), 0);
  const std::string good = write("good.mtlx", "<materialx version=\"1.38\"/>");
  EXPECT_EQ(run("convert " + good + " --out " + file("good.mtlx/folder.mtlx")), 1);
}

TEST_F(Convert, SaysWhenFilesCountFromAnotherFolder) {
  fs::create_directory(folder_.path() / "sub");
  const std::string from = write("a.mtlx", R"(<materialx version="1.39">
  <image name="i" type="color3"><input name="file" type="filename" value="x.png"/></image></materialx>)");
  EXPECT_EQ(run("convert " + from + " --out " + file("sub/a.mtlx")), 0);
  EXPECT_NE(errors_.find("other-folder"), std::string::npos) << errors_;
  EXPECT_EQ(run("convert " + from + " --out " + file("b.mtlx")), 0);
  EXPECT_EQ(errors_, "");
}

}  // namespace
}  // namespace nacre
