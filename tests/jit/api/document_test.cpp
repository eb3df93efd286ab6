// Documents as their hosts see them: elements and looks.
#include <gtest/gtest.h>

#include <nacre/nacre.hpp>
#include <string>
#include <vector>

namespace nacre {
namespace {

using Pairs = std::vector<std::pair<std::string_view, std::string_view>>;

TEST(ApiDocument, ElementsStandInTheDocumentsOrder) {
  const Document document = Document::parse(R"(<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <constant name="c" type="color3">
      <input name="value" type="color3" value="1, &lt;2&gt;, 3"/></constant>
    <output name="out" type="color3" nodename="c"/>
  </nodegraph>
  <output name="last" type="color3" nodegraph="NG" output="out"/>
</materialx>)",
                                            "folder/wood.mtlx");
  ASSERT_EQ(document.element_count(), 6u);
  const char* const categories[] = {"materialx", "nodegraph", "constant",
                                    "input",     "output",    "output"};
  const std::size_t parents[] = {SIZE_MAX, 0, 1, 2, 1, 0};
  const std::size_t ends[] = {6, 5, 4, 4, 5, 6};
  const int lines[] = {2, 3, 4, 5, 6, 8};
  for (std::size_t i = 0; i < 6; ++i) {
    const Element element = document.element(i);
    EXPECT_EQ(element.category, categories[i]);
    EXPECT_EQ(element.parent, parents[i]) << i;
    EXPECT_EQ(element.end, ends[i]) << i;
    EXPECT_EQ(element.line, lines[i]) << i;
    EXPECT_EQ(element.file, "folder/wood.mtlx");
  }
  EXPECT_EQ(document.element(3).attributes,
            (Pairs{{"name", "value"}, {"type", "color3"}, {"value", "1, <2>, 3"}}));
  EXPECT_EQ(document.find_element("NG/c/value"), 3u);
  EXPECT_EQ(document.find_element(""), 0u);
  EXPECT_EQ(document.find_element("NG/d"), SIZE_MAX);
  EXPECT_STREQ(nacre_document_find_attribute(document.get(), 5, "nodegraph"), "NG");
  EXPECT_EQ(nacre_document_find_attribute(document.get(), 5, "nodename"), nullptr);
  EXPECT_EQ(nacre_document_find_attribute(document.get(), 6, "nodename"), nullptr);
  nacre_element beyond{};
  beyond.size = sizeof beyond;
  EXPECT_EQ(nacre_document_element(document.get(), 6, &beyond), NACRE_WRONG_ARGUMENTS);
  EXPECT_EQ(nacre_document_attribute(document.get(), 3, 3, nullptr, nullptr),
            NACRE_WRONG_ARGUMENTS);
}

TEST(ApiDocument, ADeepDocumentIsListedWithoutRecursion) {
  std::string text = "<materialx version=\"1.39\">";
  constexpr int depth = 200;
  for (int i = 0; i < depth; ++i) text += "<a name=\"n\">";
  for (int i = 0; i < depth; ++i) text += "</a>";
  const Document document = Document::parse(text + "</materialx>");
  ASSERT_EQ(document.element_count(), depth + 1u);
  for (std::size_t i = 1; i <= depth; ++i) {
    EXPECT_EQ(document.element(i).parent, i - 1);
    EXPECT_EQ(document.element(i).end, depth + 1u);
  }
}

TEST(ApiDocument, AnOlderDocumentIsSeenAsItIsToday) {
  const Document document = Document::parse(
      R"(<materialx version="1.37"><invert name="i" type="float">
           <parameter name="amount" type="float" value="1"/></invert></materialx>)");
  EXPECT_NE(document.find_element("i/amount"), SIZE_MAX);
  EXPECT_EQ(document.element(document.find_element("i/amount")).category, "input");
}

TEST(ApiDocument, LooksAssignMaterialsAndVariants) {
  const Document document = Document::parse(R"(<materialx version="1.39">
  <look name="day">
    <variantassign name="v1" variantset="paint" variant="red"/>
    <materialassign name="m1" material="Wood" geom="/house"/>
    <materialassign name="m2" material="Brass" geom="/house/door/knob">
      <variantassign name="v2" variantset="wear" variant="old"/></materialassign>
    <visibility name="h" geom="/house/cellar" vistype="camera" visible="false"/>
  </look>
  <look name="night"/>
</materialx>)");
  ASSERT_EQ(document.looks(), (std::vector<std::string>{"day", "night"}));
  EXPECT_EQ(document.assignment(0, "/house/door").material, "Wood");
  const Assignment knob = document.assignment(0, "/house/door/knob");
  EXPECT_EQ(knob.material, "Brass");
  ASSERT_EQ(knob.variants.size(), 2u);
  EXPECT_EQ(knob.variants[0].set + "=" + knob.variants[0].variant, "paint=red");
  EXPECT_EQ(knob.variants[1].set + "=" + knob.variants[1].variant, "wear=old");
  EXPECT_EQ(document.assignment(0, "/garden").material, "");
  EXPECT_EQ(document.assignment(1, "/house").material, "");
  EXPECT_THROW(document.assignment(2, "/house"), Error);
  EXPECT_FALSE(document.is_visible(0, "/house/cellar", "camera"));
  EXPECT_TRUE(document.is_visible(0, "/house/cellar", "shadow"));
  EXPECT_TRUE(document.is_visible(0, "/house/door", "camera"));
}

}  // namespace
}  // namespace nacre
