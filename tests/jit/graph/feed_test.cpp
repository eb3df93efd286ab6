#include "jit/graph/resolve/feed.h"

#include <gtest/gtest.h>

#include "jit/document/inheritance.h"
#include "jit/graph/find.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

constexpr std::string_view scene = R"(
  <input name="loop" type="float" interfacename="loop"/>
  <constant name="c" type="float"/>
  <output name="a" type="float" output="b"/>
  <output name="b" type="float" output="a"/>
  <add name="circle" type="float"><input name="in1" type="float" output="a"/></add>
  <add name="endless" type="float"><input name="in1" type="float" interfacename="loop"/></add>
  <nodedef name="ND_x" node="x">
    <input name="amount" type="float" value="0.7"/><output name="out" type="float"/>
  </nodedef>
  <nodegraph name="NG_x" nodedef="ND_x">
    <add name="n" type="float"><input name="in1" type="float" interfacename="amount"/></add>
    <output name="out" type="float" nodename="n"/>
  </nodegraph>
  <nodegraph name="G">
    <input name="said" type="float" value="0.5"/>
    <input name="open" type="float"/>
    <input name="fed" type="float" nodename="c"/>
    <add name="n" type="float">
      <input name="in1" type="float" interfacename="said"/>
      <input name="in2" type="float" interfacename="open"/>
    </add>
    <add name="m" type="float">
      <input name="in1" type="float" interfacename="fed"/>
      <input name="in2" type="float" interfacename="none" value="3"/>
    </add>
    <output name="out" type="float" nodename="n"/>
    <output name="through" type="float" interfacename="fed"/>
  </nodegraph>
  <add name="reads" type="float">
    <input name="in1" type="float" nodegraph="G" output="out"/>
    <input name="in2" type="float" nodegraph="G" output="through"/>
  </add>)";

class FeedOf : public ::testing::Test {
 protected:
  void SetUp() override {
    document_ = document_of(scene, diagnostics_);
    ASSERT_NE(document_, nullptr) << diagnostics_.to_string();
    definitions_.emplace(*document_, &standard_library().definitions(), diagnostics_);
    ASSERT_EQ(diagnostics_.to_string(), "");
  }

  const Element& port(std::string_view path) { return *find_element(*document_, path); }
  Feed feed(std::string_view path, bool lenient = false) {
    Complaints complaints(diagnostics_, lenient);
    return find_feed(port(path), *definitions_, complaints);
  }
  Feed source(std::string_view path) {
    Complaints complaints(diagnostics_, false);
    return find_source_node(port(path), *definitions_, complaints);
  }
  std::string code() { return diagnostics_.all().empty() ? "" : diagnostics_.all().back().code; }

  Diagnostics diagnostics_;
  std::unique_ptr<Document> document_;
  std::optional<Definitions> definitions_;
};

using Kind = Connection::Kind;

TEST_F(FeedOf, AnInterfaceIsTheInputOfTheGraph) {
  const Feed said = feed("G/n/in1");
  EXPECT_EQ(said.connection.kind, Kind::value);
  EXPECT_EQ(said.port, &port("G/said"));
  EXPECT_EQ(said.reader, &port("G/n/in1"));
  const Feed open = feed("G/n/in2");
  EXPECT_EQ(open.connection.kind, Kind::none);
  EXPECT_EQ(open.port, &port("G/open"));
  // What an input of a graph names stands beside the graph.
  EXPECT_EQ(feed("G/m/in1").connection.target, &port("c"));
  EXPECT_EQ(feed("G/fed").reader, &port("G/fed"));
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(FeedOf, TheDefaultOfTheNodedefThatAGraphImplements) {
  const Feed amount = feed("NG_x/n/in1");
  EXPECT_EQ(amount.connection.kind, Kind::value);
  EXPECT_EQ(amount.port, &port("ND_x/amount"));
}

TEST_F(FeedOf, AnInterfaceThatThereIsNot) {
  EXPECT_EQ(feed("G/m/in2").connection.kind, Kind::invalid);
  EXPECT_EQ(diagnostics_.error_count(), 1u);
  const Feed lenient = feed("G/m/in2", true);
  EXPECT_EQ(lenient.connection.kind, Kind::value);
  EXPECT_EQ(lenient.port, &port("G/m/in2"));
  EXPECT_EQ(diagnostics_.error_count(), 1u);
  EXPECT_EQ(code(), "unknown-interface");
}

TEST_F(FeedOf, TheNodeBehindOutputsAndInterfaces) {
  EXPECT_EQ(feed("reads/in1").connection.target, &port("G/out"));
  EXPECT_EQ(source("reads/in1").connection.target, &port("G/n"));
  EXPECT_EQ(source("reads/in2").connection.target, &port("c"));
  EXPECT_EQ(source("G/n/in1").connection.kind, Kind::value);
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(FeedOf, CirclesEnd) {
  EXPECT_EQ(source("circle/in1").connection.kind, Kind::invalid);
  EXPECT_EQ(code(), "cycle");
  EXPECT_EQ(feed("endless/in1").connection.kind, Kind::invalid);
  EXPECT_EQ(code(), "cycle");
}

TEST(FindInputs, ANodesOwnBeforeWhatItInheritsWhereTheySaySomething) {
  Diagnostics diagnostics;
  const auto document = document_of(R"(
    <mix name="base" type="float">
      <input name="fg" type="float" value="1"/>
      <input name="bg" type="float" value="2"/>
      <input name="mix" type="float"/>
    </mix>
    <mix name="heir" type="float" inherit="base">
      <input name="bg" type="float" value="3"/>
      <input name="fg" type="float"/>
    </mix>
    <mix name="lost" type="float" inherit="nobody"/>)",
                                    diagnostics);
  ASSERT_NE(document, nullptr);
  const Element& base = *document->root().child("base");
  const Element& heir = *document->root().child("heir");
  EXPECT_EQ(find_inputs(heir, diagnostics),
            (std::vector<const Element*>{heir.child("bg"), base.child("fg")}));
  EXPECT_EQ(find_input(heir, "fg"), base.child("fg"));
  EXPECT_EQ(find_input(heir, "mix"), nullptr);
  EXPECT_EQ(diagnostics.to_string(), "");
  EXPECT_TRUE(find_inputs(*document->root().child("lost"), diagnostics).empty());
  EXPECT_EQ(diagnostics.error_count(), 1u);
}

}  // namespace
}  // namespace nacre
