// What a host says of its scene: the same bits with less to do, and the same where it is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "tests/jit/api/surface_document.h"
#include "tests/jit/api/surface_points.h"

namespace nacre {
namespace {

constexpr std::size_t count = 3000;

/// A live shader of which this is known.
Shader compiled(std::vector<Fact> facts, bool background = false) {
  static System system;
  CompileOptions options;
  options.live = {"*"};
  options.facts = std::move(facts);
  options.background = background;
  return system.compile_material(Document::parse(surface_document("0.8, 0.3, 0.1", "0.5")), "M",
                                 options);
}

const std::vector<Fact> no_layers{
    {"S/coat", 0, 0}, {"S/transmission", 0, 0}, {"S/sheen", 0, 0}, {"S/subsurface", 0, 0}};

TEST(ApiFacts, AreTheSameBitsWithLess) {
  const Shader general = compiled({}), narrow = compiled(no_layers);
  SurfacePoints expected(count), found(count);
  expected.shade(general);
  found.shade(narrow);
  EXPECT_TRUE(found.same_results(expected));
  EXPECT_EQ(narrow.points_outside_facts(), 0u);
  const std::vector<FactInfo> facts = narrow.facts();
  ASSERT_EQ(facts.size(), no_layers.size());
  for (std::size_t i = 0; i < facts.size(); ++i) {
    EXPECT_EQ(facts[i].fact.name, no_layers[i].name);
    EXPECT_EQ(facts[i].fact.maximum, 0);
    EXPECT_GT(facts[i].saved.value_or(0), 0u) << facts[i].fact.name;
  }
  EXPECT_TRUE(general.facts().empty());
}

TEST(ApiFacts, OfAnInstanceThatBreaksThemAreForgotten) {
  const Shader general = compiled({}), narrow = compiled(no_layers);
  for (const char* broken : {"S/coat", "S/transmission", "S/sheen"}) {
    Instance of_general(general), of_narrow(narrow);
    of_general.set(broken, 0.75f);
    of_narrow.set(broken, 0.75f);
    SurfacePoints expected(count), found(count), before(count);
    expected.shade(general, &of_general);
    before.shade(general);
    const std::uint64_t outside = narrow.points_outside_facts();
    found.shade(narrow, &of_narrow);
    EXPECT_TRUE(found.same_results(expected)) << broken;
    EXPECT_FALSE(found.same_results(before)) << broken;
    // Also of sample and evaluate, which read it in the state alone.
    EXPECT_EQ(narrow.points_outside_facts() - outside, 4 * count) << broken;
  }
  // And the others go on as they were.
  SurfacePoints expected(count), found(count);
  expected.shade(general);
  const std::uint64_t outside = narrow.points_outside_facts();
  found.shade(narrow);
  EXPECT_TRUE(found.same_results(expected));
  EXPECT_EQ(narrow.points_outside_facts(), outside);
}

TEST(ApiFacts, HoldInTheBackgroundToo) {
  const Shader general = compiled({}), narrow = compiled(no_layers, true);
  SurfacePoints expected(count), at_once(count), later(count);
  expected.shade(general);
  at_once.shade(narrow);
  narrow.wait();
  later.shade(narrow);
  EXPECT_TRUE(at_once.same_results(expected));
  EXPECT_TRUE(later.same_results(expected));
}

TEST(ApiFacts, OfPointsAreLookedAtPointByPoint) {
  const Shader general = compiled({}),
               narrow = compiled({{"dot(N,wo)", 0.01, 1.001}, {"uv0", 0, 1}});
  SurfacePoints expected(count), found(count);
  for (SurfacePoints* const points : {&expected, &found}) {
    for (const std::size_t i : {std::size_t{5}, std::size_t{1700}, count - 1}) {
      for (float& x : points->points[i].wo) x = -x;  // From behind.
      points->points[i].uv[0] = -3.25f;
    }
  }
  expected.shade(general);
  found.shade(narrow);
  EXPECT_TRUE(found.same_results(expected));
}

TEST(ApiFacts, ThatHoldForNoNumberAreErrors) {
  for (const Fact& wrong : {Fact{"uv0", 1, 0}, Fact{"", 0, 1}, Fact{"dot(N", 0, 1}}) {
    try {
      compiled({wrong});
      ADD_FAILURE() << wrong.name;
    } catch (const Error& error) {
      ASSERT_FALSE(error.diagnostics().empty());
      EXPECT_EQ(error.diagnostics().front().code, "bad-fact");
    }
  }
}

}  // namespace
}  // namespace nacre
