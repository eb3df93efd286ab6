// That a light tree draws with the probabilities that it names, and may draw all that shines.
#include "examples/render/light_tree.h"

#include <gtest/gtest.h>

#include "tests/examples/render/light_samples.h"

namespace nacre::host {
namespace {

struct Lights {
  std::vector<TestLight> lights;
  std::vector<LightBounds> bounds;

  Lights(std::uint32_t seed, int count, float size = 3.f) {
    RandomLights random(seed);
    for (int i = 0; i < count; ++i) add(random_light(random, size));
  }
  void add(const TestLight& light) {
    lights.push_back(light);
    bounds.push_back(light.bounds());
  }
};

TEST(LightTree, DrawsWithTheProbabilityThatItNames) {
  for (const int count : {1, 2, 3, 17, 400}) {
    const Lights some(static_cast<std::uint32_t>(count), count);
    const LightTree tree(some.bounds);
    RandomLights random(7);
    for (int i = 0; i < 200; ++i) {
      const LitPlace at = random.place(4.f);
      double sum = 0;
      for (std::uint32_t light = 0; light < some.lights.size(); ++light) {
        sum += tree.probability(at, light);
      }
      EXPECT_LE(sum, 1 + 1e-9);
      for (int k = 0; k < 50; ++k) {
        const auto choice = tree.sample(at, double{random.number(0.f, 1.f)} * 0.9999999);
        if (!choice) {
          EXPECT_LT(sum, 1);
          continue;
        }
        EXPECT_EQ(choice->probability, tree.probability(at, choice->light));  // To the bit.
        EXPECT_GT(choice->probability, 0.0);
      }
    }
  }
}

TEST(LightTree, ProbabilitiesOfLightsThatShineEverywhereSumToOne) {
  Lights some(3, 0);
  RandomLights random(3);
  for (int i = 0; i < 300; ++i) {
    TestLight light = random_light(random, 3.f);
    light.cos_o = light.cos_e = -1.f;
    light.reach = INFINITY;
    some.add(light);
  }
  const LightTree tree(some.bounds);
  for (int i = 0; i < 300; ++i) {
    const LitPlace at = random.place(4.f);
    double sum = 0;
    for (std::uint32_t light = 0; light < 300; ++light) sum += tree.probability(at, light);
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
}

// Pearson's chi-square over the lights and "none", those expected less than 8 times together.
TEST(LightTree, FrequenciesAreTheProbabilities) {
  const Lights some(11, 120);
  const LightTree tree(some.bounds);
  RandomLights random(5);
  std::mt19937_64 bits(9);
  std::uniform_real_distribution<double> uniform;
  constexpr int draws = 100000;
  double chi_square = 0, freedom = 0;
  for (int i = 0; i < 10; ++i) {
    const LitPlace at = random.place(4.f);
    std::vector<double> counts(some.lights.size() + 1, 0.0), expected;
    for (int k = 0; k < draws; ++k) {
      const auto choice = tree.sample(at, uniform(bits));
      ++counts[choice ? choice->light : some.lights.size()];
    }
    double sum = 0;
    for (std::uint32_t light = 0; light < some.lights.size(); ++light) {
      expected.push_back(draws * tree.probability(at, light));
      sum += expected.back();
    }
    expected.push_back(std::max(0.0, draws - sum));
    double rare_expected = 0, rare = 0;
    freedom -= 1;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      if (expected[k] == 0.0) {
        EXPECT_EQ(counts[k], 0.0);
      }
      if (expected[k] < 8) {
        rare_expected += expected[k];
        rare += counts[k];
        continue;
      }
      chi_square += (counts[k] - expected[k]) * (counts[k] - expected[k]) / expected[k];
      freedom += 1;
    }
    if (rare_expected < 8) continue;
    chi_square += (rare - rare_expected) * (rare - rare_expected) / rare_expected;
    freedom += 1;
  }
  // About normal, of so many degrees of freedom.
  EXPECT_GT(freedom, 100);
  EXPECT_LT(std::abs(chi_square - freedom), 4 * std::sqrt(2 * freedom));
}

TEST(LightTree, WhatShinesCanBeDrawn) {
  const Lights some(13, 500);
  const LightTree tree(some.bounds);
  RandomLights random(6);
  int shining = 0;
  for (int i = 0; i < 300; ++i) {
    const LitPlace at = random.place(i % 3 == 0 ? 40.f : 4.f);
    for (std::uint32_t light = 0; light < some.lights.size(); ++light) {
      const TestLight& l = some.lights[light];
      double most = 0;
      for (const Vec3 corner : l.corners) most = std::max(most, l.from(corner, at.P));
      if (!(most > 0.0)) continue;
      ++shining;
      EXPECT_GT(tree.probability(at, light), 0.0);
    }
  }
  EXPECT_GT(shining, 10000);
}

// The sum over all lights, estimated by one each time.
TEST(LightTree, MeansAreSums) {
  const Lights some(17, 200);
  const LightTree tree(some.bounds);
  RandomLights random(8);
  std::mt19937_64 bits(10);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 8; ++i) {
    const LitPlace at = random.place(4.f);
    double exact = 0, sum = 0, squares = 0;
    for (const TestLight& l : some.lights) exact += l.from(l.corners[0], at.P);
    constexpr int draws = 40000;
    for (int k = 0; k < draws; ++k) {
      const auto choice = tree.sample(at, uniform(bits));
      if (!choice) continue;
      const TestLight& l = some.lights[choice->light];
      const double value = l.from(l.corners[0], at.P) / choice->probability;
      sum += value;
      squares += value * value;
    }
    const double mean = sum / draws;
    const double deviation = std::sqrt((squares / draws - mean * mean) / draws);
    EXPECT_LT(std::abs(mean - exact), 4 * deviation + 1e-9 * exact) << mean << ' ' << exact;
    EXPECT_LT(deviation, 0.02 * exact);  // Else nothing is shown.
  }
}

// Far from all, only the intensities differ: a light's share is its own of the whole.
TEST(LightTree, FromFarAwayLightsAreDrawnByTheirIntensities) {
  Lights some(19, 0);
  RandomLights random(19);
  double whole = 0;
  for (int i = 0; i < 50; ++i) {
    TestLight light = random_light(random, 1.f);
    light.cos_o = light.cos_e = -1.f;
    light.reach = INFINITY;
    whole += double{light.intensity};
    some.add(light);
  }
  const LightTree tree(some.bounds);
  for (const Vec3 far : {Vec3{1e5f, 0, 0}, Vec3{-3e4f, 7e4f, 2e4f}}) {
    for (std::uint32_t light = 0; light < 50; ++light) {
      const double share = double{some.lights[light].intensity} / whole;
      EXPECT_NEAR(tree.probability({far, {0, 1, 0}}, light), share, 2e-3 * share + 1e-6);
    }
  }
}

TEST(LightTree, NoLightsAndDarkLights) {
  const LitPlace at{{0, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(LightTree().empty());
  EXPECT_FALSE(LightTree().sample(at, 0.5));
  EXPECT_TRUE(LightTree(std::vector<LightBounds>()).empty());
  Lights some(23, 3);
  for (LightBounds& b : some.bounds) b.intensity = 0.0;
  const LightTree dark(some.bounds);
  EXPECT_TRUE(dark.empty());
  EXPECT_FALSE(dark.sample(at, 0.5));
  EXPECT_EQ(dark.probability(at, 1), 0.0);
  // One that shines among them has all of the probability.
  some.bounds[1] = LightBounds();
  some.bounds[1].box.add({1, 2, 3});
  some.bounds[1].intensity = 1e-20;
  const LightTree one(some.bounds);
  for (const double u : {0.0, 0.3, 0x1.fffffffffffffp-1}) {
    const auto choice = one.sample(at, u);
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->light, 1u);
    EXPECT_EQ(choice->probability, 1.0);
  }
  EXPECT_EQ(one.probability(at, 0), 0.0);
  EXPECT_EQ(one.probability(at, 1), 1.0);
}

// Where no cut parts them, and where every cut leaves all but one together.
TEST(LightTree, DegenerateLights) {
  Lights same(29, 0), powers(29, 0);
  for (int i = 0; i < 1000; ++i) same.add({.corners = {}, .axis = {0, 0, 1}});
  float x = 1e17f;
  for (int i = 0; i < 400; ++i, x *= 0.8f) {
    powers.add({.corners = {{x, 0, 0}, {x, 0, 0}, {x, 0, 0}}, .axis = {0, 0, 1}});
  }
  for (const Lights* some : {&same, &powers}) {
    const LightTree tree(some->bounds);
    const LitPlace at{{0, 1, 0}, {0, 1, 0}};
    double sum = 0;
    for (std::uint32_t i = 0; i < some->lights.size(); ++i) {
      sum += tree.probability(at, i);
      if (some == &same) {
        EXPECT_NEAR(tree.probability(at, i), 1e-3, 1e-9);
      }
      EXPECT_GT(tree.probability(at, i), 0.0);
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
}

TEST(LightTree, ManyLights) {
  const Lights some(31, 100000, 30.f);
  const LightTree tree(some.bounds);
  RandomLights random(12);
  for (int i = 0; i < 200; ++i) {
    const LitPlace at = random.place(30.f);
    const auto choice = tree.sample(at, double{random.number(0.f, 0.999f)});
    if (choice) {
      EXPECT_EQ(choice->probability, tree.probability(at, choice->light));
    }
  }
}

}  // namespace
}  // namespace nacre::host
