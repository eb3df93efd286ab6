#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "nodes/nodes.h"
#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

using Colour = std::array<double, 4>;

const std::vector<std::vector<float>> colours{{0.2f, 0.5f, 0.7f, 0.75f},
                                              {0.9f, 0.1f, 0.0f, 0.5f},
                                              {0.0f, 0.0f, 0.0f, 0.0f},
                                              {1.0f, 1.0f, 1.0f, 1.0f},
                                              {1.5f, -0.5f, 0.25f, 0.125f}};

/// Operators on one channel, fg before bg: MaterialX 1.39 Standard Nodes,
/// "Compositing Nodes".
const std::map<std::string, std::function<double(double, double)>>& channel_operators() {
  static const std::map<std::string, std::function<double(double, double)>> operators{
      {"plus", [](double f, double b) { return b + f; }},
      {"minus", [](double f, double b) { return b - f; }},
      {"difference", [](double f, double b) { return std::fabs(b - f); }},
      {"screen", [](double f, double b) { return 1 - (1 - f) * (1 - b); }}};
  return operators;
}

/// Factors of fg and bg by their alphas: Porter and Duff, "Compositing Digital
/// Images", 1984, with mask for "in" the other way round.
const std::map<std::string, std::function<std::array<double, 2>(double, double)>>& factors() {
  static const std::map<std::string, std::function<std::array<double, 2>(double, double)>> table{
      {"in", [](double, double b) { return std::array{b, 0.0}; }},
      {"out", [](double, double b) { return std::array{1 - b, 0.0}; }},
      {"mask", [](double f, double) { return std::array{0.0, f}; }},
      {"over", [](double f, double) { return std::array{1.0, 1 - f}; }}};
  return table;
}

std::vector<double> composite(const std::string& category, const std::vector<float>& fg,
                              const std::vector<float>& bg, float mix) {
  return call_node(
      category, {{"fg", Type::color4, fg}, {"bg", Type::color4, bg}, {"mix", Type::float_, {mix}}},
      Type::color4);
}

TEST(Compositing, ChannelOperatorsFollowTheirFormulas) {
  for (const auto& [category, formula] : channel_operators()) {
    for (const auto& fg : colours) {
      for (const auto& bg : colours) {
        const std::vector<double> out = composite(category, fg, bg, 0.25f);
        for (std::size_t k = 0; k < 4; ++k) {
          const double expected = 0.25 * formula(fg[k], bg[k]) + 0.75 * bg[k];
          EXPECT_NEAR(out[k], expected, 1e-12) << category;
        }
      }
    }
  }
}

TEST(Compositing, AlphaOperatorsAreThoseOfPorterAndDuff) {
  for (const auto& [category, factor] : factors()) {
    for (const auto& fg : colours) {
      for (const auto& bg : colours) {
        const auto [f, b] = factor(fg[3], bg[3]);
        const std::vector<double> out = composite(category, fg, bg, 0.625f);
        for (std::size_t k = 0; k < 4; ++k) {
          const double expected = 0.625 * (f * fg[k] + b * bg[k]) + 0.375 * bg[k];
          EXPECT_NEAR(out[k], expected, 1e-12) << category;
        }
      }
    }
  }
}

TEST(Compositing, MatteIsOverForUnmultipliedColour) {
  const std::vector<double> out = composite("matte", colours[0], colours[1], 1.0f);
  EXPECT_NEAR(out[0], 0.2 * 0.75 + 0.9 * 0.25, 1e-7);
  EXPECT_NEAR(out[3], 0.75 + 0.5 * 0.25, 1e-7);
}

TEST(Compositing, DisjointOverAddsWhatDoesNotOverlap) {
  // Alphas of 0.5 and 0.125 fit side by side; 0.75 and 0.5 leave half of the second.
  const std::vector<double> fits = composite("disjointover", colours[1], colours[4], 1.0f);
  EXPECT_NEAR(fits[0], 0.9 + 1.5, 1e-7);
  EXPECT_NEAR(fits[3], 0.625, 1e-7);
  const std::vector<double> overlaps = composite("disjointover", colours[0], colours[1], 1.0f);
  EXPECT_NEAR(overlaps[0], 0.2 + 0.9 * 0.25 / 0.5, 1e-7);
  EXPECT_NEAR(overlaps[3], 1.0, 1e-7);
  // Nothing to divide by.
  const std::vector<double> empty = composite("disjointover", {1, 1, 1, 1.5f}, {1, 1, 1, 0}, 1.0f);
  EXPECT_EQ(empty[0], 0.0);
}

TEST(Compositing, BurnAndDodgeOfWhatTheyDivideByAreZero) {
  const auto blend = [](const char* category, float fg, float bg) {
    return call_scalar(category, {{"fg", fg}, {"bg", bg}, {"mix", 1.0f}});
  };
  EXPECT_EQ(blend("burn", 0.5f, 0.75f), 0.5);
  EXPECT_EQ(blend("burn", 0.0f, 0.75f), 0.0);
  EXPECT_EQ(blend("dodge", 0.5f, 0.25f), 0.5);
  EXPECT_EQ(blend("dodge", 1.0f, 0.25f), 0.0);
}

TEST(Compositing, UnpremultiplyPassesWhatHasNoAlpha) {
  const auto unpremult = [](const std::vector<float>& in) {
    return call_node("unpremult", {{"in", Type::color4, in}}, Type::color4);
  };
  EXPECT_EQ(unpremult({0.5f, 1, 2, 0.5f}), (std::vector<double>{1, 2, 4, 0.5}));
  EXPECT_EQ(unpremult({0.5f, 1, 2, 0}), (std::vector<double>{0.5, 1, 2, 0}));
}

/// Records mix of channels fg and bg by a literal.
Ref mix_by(Recorder& recorder, float amount) {
  std::vector<NodeCall::Port> inputs{{"fg", {Type::float_, input(recorder, "fg")}},
                                     {"bg", {Type::float_, input(recorder, "bg")}},
                                     {"mix", {Type::float_, Float(amount)}}};
  NodeCall::Port out{"out", {}};
  out.value.type = Type::float_;
  Diagnostics diagnostics;
  NodeCall call(recorder, "mix", "ND_mix_float", inputs, {out}, Accuracy::precise, nullptr,
                diagnostics, {});
  for (const NodeBody& body : standard_nodes()) {
    if (body.category == "mix") body.record(call);
  }
  return call.outputs().front().value.parts.front();
}

TEST(Compositing, MixByALiteralEndRecordsNothing) {
  for (const float amount : {0.0f, 1.0f}) {
    Recorder recorder;
    const Ref mixed = mix_by(recorder, amount);
    const Ref side = recorder.input(amount == 0.0f ? "bg" : "fg", Scalar::f32);
    EXPECT_EQ(mixed.id, side.id);
    EXPECT_FALSE(mixed.is_constant());
  }
}

}  // namespace
}  // namespace nacre
