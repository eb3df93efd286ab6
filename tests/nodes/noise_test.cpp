#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "jit/passes/derive.h"
#include "nodes/noise/perlin.h"
#include "runtime/interpreter/interpreter.h"
#include "tests/nodes/independent/scalar_noise.h"
#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

/// Coordinates with positive and negative cells, and some far out.
Columns points(const std::string& port, int count = 200) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> near(-8.0f, 8.0f);
  Columns columns;
  for (const char* component : {".x", ".y", ".z"}) {
    std::vector<float>& column = columns[port + component];
    for (int i = 0; i < count; ++i) {
      column.push_back(i % 10 == 9 ? near(random) * 1000.0f : near(random));
    }
  }
  return columns;
}

std::vector<double> point(const Columns& columns, const std::string& port, std::size_t i, int n) {
  std::vector<double> p;
  for (int k = 0; k < n; ++k) p.push_back(columns.at(component_name(port, k, 3)).at(i));
  return p;
}

TEST(Lookup3, GivesItsPublishedHashes) {
  // "Four score and seven years ago", 30 bytes: lookup3.c, driver5.
  const std::vector<std::uint32_t> words{0x72756f46, 0x6f637320, 0x61206572, 0x7320646e,
                                         0x6e657665, 0x61657920, 0x61207372, 0x00006f67};
  EXPECT_EQ(reference::lookup3(words, 30, 0), 0x17770551u);
  EXPECT_EQ(reference::lookup3(words, 30, 1), 0xcd628161u);
}

TEST(CellNoise, IsTheHashOfTheCell) {
  const Columns p = points("texcoord");
  const DoubleColumns two = run_node({"cellnoise2d", {{"texcoord", Type::vector2}}}, p);
  Columns q = points("position");
  const DoubleColumns three = run_node({"cellnoise3d", {{"position", Type::vector3}}}, q);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_EQ(two.at("out")[i], reference::cell_noise(point(p, "texcoord", i, 2)));
    EXPECT_EQ(three.at("out")[i], reference::cell_noise(point(q, "position", i, 3)));
  }
}

TEST(CellNoise, IsDefinedForEveryCoordinate) {
  const auto kernel =
      make_interpreter(node_program({"cellnoise2d", {{"texcoord", Type::vector2}}}));
  const std::vector<float> x = hostile_floats();
  const Columns out = run(*kernel, {{"texcoord.x", x}, {"texcoord.y", {0.5f}}});
  for (const float value : out.at("out")) EXPECT_TRUE(value >= 0.0f && value <= 1.0f);
  const auto at = [&](float u) {
    return run(*kernel, {{"texcoord.x", {u}}, {"texcoord.y", {0.5f}}}).at("out")[0];
  };
  EXPECT_EQ(at(1e20f), at(std::numeric_limits<float>::infinity()));
  EXPECT_EQ(at(std::numeric_limits<float>::quiet_NaN()), at(0.5f));
}

TEST(Perlin, AgreesWithTheScalarStatementIn2d) {
  Columns p = points("texcoord");
  p["amplitude.x"] = p["amplitude.y"] = p["amplitude.z"] = p["amplitude.w"] = {2.0f};
  p["pivot"] = {0.25f};
  const DoubleColumns out =
      run_node({"noise2d",
                {{"amplitude", Type::vector4}, {"pivot"}, {"texcoord", Type::vector2}},
                {{"out", Type::vector4}}},
               p);
  for (std::size_t i = 0; i < 200; ++i) {
    const auto c = point(p, "texcoord", i, 2);
    for (int k = 0; k < 3; ++k) {
      const double expected = 2.0 * reference::perlin(reference::Vector2{c[0], c[1]}, k) + 0.25;
      EXPECT_NEAR(out.at(component_name("out", k, 4))[i], expected, 1e-9);
    }
    const double fourth = reference::perlin(reference::Vector2{c[0] + 19, c[1] + 73});
    EXPECT_NEAR(out.at("out.w")[i], 2.0 * fourth + 0.25, 1e-9);
  }
}

TEST(Perlin, AgreesWithTheScalarStatementIn3d) {
  Columns p = points("position");
  p["amplitude"] = {1.0f};
  const DoubleColumns one =
      run_node({"noise3d", {{"amplitude"}, {"pivot"}, {"position", Type::vector3}}}, p);
  p["amplitude.x"] = p["amplitude.y"] = {1.0f};
  const DoubleColumns two =
      run_node({"noise3d",
                {{"amplitude", Type::vector2}, {"pivot"}, {"position", Type::vector3}},
                {{"out", Type::vector2}}},
               p);
  for (std::size_t i = 0; i < 200; ++i) {
    const auto c = point(p, "position", i, 3);
    const reference::Vector3 v{c[0], c[1], c[2]};
    EXPECT_NEAR(one.at("out")[i], reference::perlin(v), 1e-9);
    EXPECT_NEAR(two.at("out.x")[i], reference::perlin(v, 0), 1e-9);
    EXPECT_NEAR(two.at("out.y")[i], reference::perlin(v, 1), 1e-9);
  }
}

/// A number that is known while recording; NaN where it is not.
float literal(Float x) {
  return x.is_constant() ? std::bit_cast<float>(x.ref().id) : std::nanf("");
}

// Of places that are constants nothing is recorded.
TEST(Perlin, IsTheSameWhereThePlaceIsKnown) {
  for (int i = 0; i < 50; ++i) {
    const float x = 0.37f * static_cast<float>(i) - 9.0f, y = 4.0f - 0.61f * static_cast<float>(i),
                z = 0.13f * static_cast<float>(i);
    Recorder recorder;
    const float amplitude = 1.0f, pivot = 0.0f;
    const std::vector<Arg> rest{{"amplitude", Type::float_, {amplitude}},
                                {"pivot", Type::float_, {pivot}}};
    std::vector<Arg> plane = rest, space = rest;
    plane.push_back({"texcoord", Type::vector2, {x, y}});
    space.push_back({"position", Type::vector3, {x, y, z}});
    EXPECT_NEAR(literal(perlin(recorder, Float2{x, y})),
                call_node("noise2d", plane, Type::float_)[0], 1e-6);
    EXPECT_NEAR(literal(perlin(recorder, Float3{x, y, z})),
                call_node("noise3d", space, Type::float_)[0], 1e-6);
    EXPECT_TRUE(recorder.program().entry().code.empty());
  }
}

TEST(Perlin, HasNoFractionLeftFarOut) {
  const auto kernel = make_interpreter(
      node_program({"noise2d", {{"amplitude"}, {"pivot"}, {"texcoord", Type::vector2}}}));
  const auto at = [&](float u) {
    return run(*kernel, {{"amplitude", {1.0f}}, {"texcoord.x", {u}}, {"texcoord.y", {2.0f}}})
        .at("out")[0];
  };
  EXPECT_EQ(at(3.0f), 0.0f);
  EXPECT_EQ(at(1e10f), 0.0f);
  EXPECT_EQ(at(-3e38f), 0.0f);
  EXPECT_NEAR(at(std::numeric_limits<float>::quiet_NaN()), 0.0f, 1e-6f);
  EXPECT_NEAR(at(std::numeric_limits<float>::infinity()), 0.0f, 1e-6f);
}

/// The noises of one float, with the bound of what they give.
struct Noise {
  NodeUnderTest node;
  double bound;
};
std::vector<Noise> noises() {
  const std::vector<NodePort> flat{{"texcoord", Type::vector2}};
  const std::vector<NodePort> solid{{"position", Type::vector3}};
  const auto with = [](std::vector<NodePort> ports, const std::vector<NodePort>& more) {
    ports.insert(ports.end(), more.begin(), more.end());
    return ports;
  };
  const std::vector<NodePort> level{{"amplitude"}, {"pivot"}};
  const std::vector<NodePort> octaves{
      {"amplitude"}, {"octaves", Type::integer}, {"lacunarity"}, {"diminish"}};
  const std::vector<NodePort> worley{{"jitter"}, {"style", Type::integer}};
  return {{{"noise2d", with(flat, level)}, 1.1},
          {{"noise3d", with(solid, level)}, 1.1},
          {{"fractal2d", with(flat, octaves)}, 2.2},
          {{"fractal3d", with(solid, octaves)}, 2.2},
          {{"cellnoise2d", flat}, 1.0},
          {{"cellnoise3d", solid}, 1.0},
          {{"worleynoise2d", with(flat, worley)}, 1000.0},
          {{"worleynoise3d", with(solid, worley)}, 1000.0}};
}

std::vector<float> noise_at(const Noise& noise, const std::vector<float>& x,
                            const std::vector<float>& y) {
  Columns columns{{"amplitude", {1.0f}},
                  {"octaves", {3}},
                  {"lacunarity", {2.0f}},
                  {"diminish", {0.5f}},
                  {"jitter", {1.0f}}};
  const std::string group = noise.node.inputs.front().name;
  columns[group + ".x"] = x;
  columns[group + ".y"] = y;
  columns[group + ".z"] = y;
  return run(*make_interpreter(node_program(noise.node)), columns).at("out");
}

TEST(Noise, IsFiniteAndBoundedForAnyCoordinate) {
  const std::vector<float> hostile = hostile_floats();
  std::vector<float> x, y;
  for (const float a : hostile) {
    for (const float b : hostile) x.push_back(a), y.push_back(b);
  }
  for (const float sign : {1.0f, -1.0f}) x.push_back(sign * 1e30f), y.push_back(1e30f);
  for (const Noise& noise : noises()) {
    for (const float value : noise_at(noise, x, y)) {
      EXPECT_TRUE(std::isfinite(value)) << noise.node.category;
      EXPECT_LE(std::fabs(value), noise.bound) << noise.node.category;
    }
  }
}

/// Floats near a million are 1/16 apart: enough for every cell to have a gradient.
TEST(Noise, StillVariesAMillionCellsOut) {
  std::vector<float> x, y;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      x.push_back(1e6f + static_cast<float>(i) * 0.3125f);
      y.push_back(-1e6f + static_cast<float>(j) * 0.3125f);
    }
  }
  for (const Noise& noise : noises()) {
    double sum = 0, squares = 0;
    const std::vector<float> values = noise_at(noise, x, y);
    for (const double value : values) sum += value, squares += value * value;
    const auto count = static_cast<double>(values.size());
    EXPECT_GT(squares / count - sum * sum / count / count, 0.01) << noise.node.category;
  }
}

const NodeUnderTest fractal_node{"fractal2d",
                                 {{"amplitude", Type::vector2},
                                  {"octaves", Type::integer},
                                  {"lacunarity"},
                                  {"diminish"},
                                  {"texcoord", Type::vector2}},
                                 {{"out", Type::vector2}}};

TEST(Fractal, SumsOctaves) {
  Columns p = points("texcoord", 40);
  p["amplitude.x"] = {1.0f};
  p["amplitude.y"] = {0.5f};
  p["lacunarity"] = {2.5f};
  p["diminish"] = {0.625f};
  for (int i = 0; i < 40; ++i) p["octaves"].push_back(static_cast<float>(i % 6 - 1));
  const DoubleColumns out = run_node(fractal_node, p);
  for (std::size_t i = 0; i < 40; ++i) {
    const auto c = point(p, "texcoord", i, 2);
    const auto sum = [&](double u, double v) {
      double total = 0.0;
      double amplitude = 1.0;
      for (int k = 0; k < static_cast<int>(i % 6) - 1; ++k) {
        total += amplitude * reference::perlin(reference::Vector2{u, v});
        amplitude *= 0.625;
        u *= 2.5;
        v *= 2.5;
      }
      return total;
    };
    EXPECT_NEAR(out.at("out.x")[i], sum(c[0], c[1]), 1e-8);
    EXPECT_NEAR(out.at("out.y")[i], 0.5 * sum(c[0] + 19, c[1] + 193), 1e-8);
  }
}

TEST(Fractal, EndsForAnyNumberOfOctaves) {
  Columns p{
      {"amplitude.x", {1.0f}}, {"octaves", {2e9f}}, {"lacunarity", {2.0f}}, {"diminish", {0.5f}}};
  p["texcoord.x"] = {0.3f};
  p["texcoord.y"] = {0.7f};
  EXPECT_TRUE(std::isfinite(run_node(fractal_node, p).at("out.x")[0]));
}

// Of finite numbers there is finite noise: what is far beyond where noise is 0 stays where it is.
TEST(Fractal, IsFiniteWhateverItsFactors) {
  const auto kernel = make_interpreter(node_program(fractal_node));
  Columns p{{"amplitude.x", {1.0f}}, {"octaves", {64.0f}}};
  for (const float lacunarity : {1e10f, -3e38f, 2.0f, 0.0f}) {
    for (const float diminish : {0.5f, 1e30f, -1e30f, 2.0f}) {
      for (const float x : {0.3f, -7.25f, 1e20f}) {
        p["lacunarity"].push_back(lacunarity), p["diminish"].push_back(diminish);
        p["texcoord.x"].push_back(x), p["texcoord.y"].push_back(0.7f);
      }
    }
  }
  const auto out = run(*kernel, p).at("out.x");
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_TRUE(std::isfinite(out[i])) << p["lacunarity"][i] << " " << p["diminish"][i];
  }
}

template <int n>
void expect_worley(const char* category, const char* port, Type coordinate) {
  Columns p = points(port);
  p["jitter"] = {0.75f};
  const NodeUnderTest node{category,
                           {{port, coordinate}, {"jitter"}, {"style", Type::integer}},
                           {{"out", Type::vector3}}};
  p["style"] = {0.0f};
  const DoubleColumns distances = run_node(node, p);
  p["style"] = {1.0f};
  const DoubleColumns solid = run_node(node, p);
  for (std::size_t i = 0; i < 200; ++i) {
    const auto c = point(p, port, i, n);
    const reference::Vector3 expected = reference::worley(c, 0.75);
    const auto feature = reference::nearest_feature(c, 0.75);
    for (int k = 0; k < 3; ++k) {
      const std::string name = component_name("out", k, 3);
      EXPECT_NEAR(distances.at(name)[i], expected[static_cast<std::size_t>(k)], 1e-6);
      EXPECT_EQ(solid.at(name)[i], reference::cell_noise(feature, k));
    }
  }
}

TEST(Worley, FindsTheNearestFeaturesIn2d) {
  expect_worley<2>("worleynoise2d", "texcoord", Type::vector2);
}
TEST(Worley, FindsTheNearestFeaturesIn3d) {
  expect_worley<3>("worleynoise3d", "position", Type::vector3);
}

TEST(Worley, NoJitterMeasuresToTheMiddleOfTheCell) {
  const DoubleColumns out = run_node(
      {"worleynoise2d", {{"texcoord", Type::vector2}, {"jitter"}, {"style", Type::integer}}},
      {{"texcoord.x", {3.5f, 3.0f}}, {"texcoord.y", {-2.5f, -2.5f}}});
  EXPECT_NEAR(out.at("out")[0], 0.0, 1e-12);
  EXPECT_NEAR(out.at("out")[1], 0.5, 1e-12);
}

/// Forward mode through hashes, gradients and the loop over cells, against a
/// central difference in double.
TEST(Noise, DerivativesAreThoseOfTheFunction) {
  for (const char* category : {"noise2d", "worleynoise2d"}) {
    Recorder recorder;
    const NodeUnderTest node{category,
                             {{"amplitude"},
                              {"pivot"},
                              {"texcoord", Type::vector2},
                              {"jitter"},
                              {"style", Type::integer}}};
    const Float value(record_node(recorder, node).front().value.parts.front());
    const std::vector<SliceOutput> outputs{{"value", value.ref()},
                                           {"slope", footprint_derivative(value, 0).ref()}};
    const std::array<std::string_view, 1> more{"texcoord"};
    const auto kernel = make_reference(derive(slice(recorder.program(), "noise", outputs), more));
    Columns p{{"amplitude", {1.0f}}, {"jitter", {0.9f}}, {"dtexcoorddx.x", {1.0f}}};
    const float h = 0x1p-12f;
    for (int i = 0; i < 60; ++i) {
      const float x = 0.0625f * static_cast<float>(i) + 0.03125f;
      for (const float offset : {-h, 0.0f, h}) p["texcoord.x"].push_back(x + offset);
    }
    p["texcoord.y"] = {0.40625f};
    const DoubleColumns out = run_double(*kernel, p);
    int smooth = 0;
    for (std::size_t i = 1; i < 180; i += 3) {
      const double before = (out.at("value")[i] - out.at("value")[i - 1]) / static_cast<double>(h);
      const double after = (out.at("value")[i + 1] - out.at("value")[i]) / static_cast<double>(h);
      if (std::fabs(after - before) > 0.02) continue;  // A ridge between cells.
      ++smooth;
      EXPECT_NEAR(out.at("slope")[i], (before + after) / 2, 1e-4) << category << ' ' << i;
    }
    EXPECT_GT(smooth, 50) << category;
  }
}

TEST(Flake, CoversTheShareAskedFor) {
  const NodeUnderTest node{
      "flake3d",
      {{"size"},
       {"roughness"},
       {"coverage"},
       {"position", Type::vector3},
       {"normal", Type::vector3},
       {"tangent", Type::vector3},
       {"bitangent", Type::vector3}},
      {{"id", Type::integer}, {"rand"}, {"presence"}, {"flakenormal", Type::vector3}}};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-5.0f, 5.0f);
  Columns p{{"size", {0.1f}},
            {"roughness", {0.3f}},
            {"normal.z", {1.0f}},
            {"tangent.x", {1.0f}},
            {"bitangent.y", {1.0f}}};
  for (const char* name : {"position.x", "position.y", "position.z"}) {
    for (int i = 0; i < 2000; ++i) p[name].push_back(coordinate(random));
  }
  for (const float coverage : {0.0f, 0.3f, 0.7f, 1.0f}) {
    p["coverage"] = {coverage};
    const DoubleColumns out = run_node(node, p);
    int covered = 0;
    for (std::size_t i = 0; i < 2000; ++i) {
      covered += out.at("presence")[i] > 0.0;
      const double x = out.at("flakenormal.x")[i];
      const double y = out.at("flakenormal.y")[i];
      const double z = out.at("flakenormal.z")[i];
      ASSERT_NEAR(x * x + y * y + z * z, 1.0, 1e-6);
      ASSERT_GE(z, 0.0);
      const bool bare = out.at("presence")[i] == 0.0;
      ASSERT_TRUE(!bare || z == 1.0);
      ASSERT_EQ(out.at("id")[i], std::floor(out.at("rand")[i] * 16777215.0));
    }
    // Three standard deviations of 2000 correlated draws and the error of the fit.
    EXPECT_NEAR(covered / 2000.0, coverage, 0.05);
  }
}

}  // namespace
}  // namespace nacre
