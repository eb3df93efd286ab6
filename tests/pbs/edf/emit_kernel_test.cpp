// The kernel `emit` beside the others: who asks, what it reads, and patterns that look along wo.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nacre/lobe_test/sphere_partition.hpp>

#include "tests/pbs/edf/emission_kernels.h"

namespace nacre {
namespace {

constexpr std::size_t sample_count = 50'000;

const EmissionCase glow{
    .name = "glow",
    .nodes =
        R"(<uniform_edf name="e" type="EDF"><input name="color" type="color3" value="1, 2, 3"/></uniform_edf>)"};

/// Mixed of all directions and a cone by how much the point is seen from above, and dim where it
/// is, as a branch says.
const EmissionCase seen_from_above{
    .name = "seen_from_above",
    .nodes =
        R"(<viewdirection name="v" type="vector3"><input name="space" type="string" value="world"/></viewdirection>
      <dotproduct name="d" type="float"><input name="in1" type="vector3" nodename="v"/>
        <input name="in2" type="vector3" value="0, 0, -1"/></dotproduct>
      <absval name="share" type="float"><input name="in" type="float" nodename="d"/></absval>
      <fractal3d name="noise" type="float"><input name="position" type="vector3" nodename="v"/></fractal3d>
      <add name="lit" type="float"><input name="in1" type="float" nodename="noise"/><input name="in2" type="float" value="2"/></add>
      <ifgreater name="level" type="float"><input name="value1" type="float" nodename="share"/>
        <input name="value2" type="float" value="0.7"/><input name="in1" type="float" nodename="lit"/>
        <input name="in2" type="float" value="1"/></ifgreater>
      <convert name="color" type="color3"><input name="in" type="float" nodename="level"/></convert>
      <uniform_edf name="a" type="EDF"><input name="color" type="color3" nodename="color"/></uniform_edf>
      <conical_edf name="c" type="EDF"><input name="color" type="color3" nodename="color"/>
        <input name="inner_angle" type="float" value="40"/><input name="outer_angle" type="float" value="80"/></conical_edf>
      <mix name="e" type="EDF"><input name="fg" type="EDF" nodename="c"/><input name="bg" type="EDF" nodename="a"/>
        <input name="mix" type="float" nodename="share"/></mix>)"};

bool reads(const BoundKernel& kernel, const std::string& group) {
  return std::ranges::any_of(kernel.program().inputs, [&](const Channel& input) {
    return input.name.starts_with(group + ".");
  });
}

std::vector<Direction> directions(const EmissionColumns& samples) {
  std::vector<Direction> list;
  for (std::size_t i = 0; i < samples.at("pdf").size(); ++i) {
    list.push_back(direction_of(samples, "emitted", i));
  }
  return list;
}

// Who does not ask has what he had.
TEST(EmitKernel, IsThereForThoseWhoAsk) {
  const EmissionKernels asked(glow, emission_options(Accuracy::standard));
  ASSERT_TRUE(asked.material().emit && asked.material().emission);
  ShaderOptions plain;
  const EmissionKernels usual(glow, plain);
  EXPECT_FALSE(usual.material().emit);
  ASSERT_TRUE(usual.material().emission);
  const auto& outputs = usual.material().emission->program().outputs;
  EXPECT_TRUE(
      std::ranges::none_of(outputs, [](const Channel& each) { return each.name == "pdf"; }));
  plain.kernels.entries = entry_emit;
  const EmissionKernels alone(glow, plain);
  EXPECT_TRUE(alone.material().emit);
  EXPECT_FALSE(alone.material().emission);
}

TEST(EmitKernel, IsAbsentWhereNothingShines) {
  const EmissionKernels dark(
      {.name = "dark",
       .nodes =
           R"(<uniform_edf name="e" type="EDF"><input name="color" type="color3" value="0, 0, 0"/></uniform_edf>)"},
      emission_options(Accuracy::standard));
  EXPECT_FALSE(dark.material().emit);
  EXPECT_FALSE(dark.material().emission);
  EXPECT_TRUE(std::ranges::count(dark.material().manifest, "emission: always black"));
}

TEST(EmitKernel, ReadsNoView) {
  for (const EmissionCase& row : {glow, seen_from_above}) {
    const EmissionKernels kernels(row, emission_options(Accuracy::standard));
    EXPECT_FALSE(reads(*kernels.material().emit, "wo")) << row.name;
    EXPECT_FALSE(reads(*kernels.material().emit, "emitted")) << row.name;
    EXPECT_FALSE(reads(*kernels.material().emission, "emitted")) << row.name;
    EXPECT_TRUE(reads(*kernels.material().emit, "u")) << row.name;
  }
  EXPECT_TRUE(reads(
      *EmissionKernels(seen_from_above, emission_options(Accuracy::standard)).material().emission,
      "wo"));
}

// What a pattern shows along the direction is what the light that leaves there has.
TEST(EmitKernel, PatternsAreSeenAlongTheDirection) {
  const EmissionKernels kernels(seen_from_above, emission_options(Accuracy::standard));
  const EmissionColumns point = tilted_point();
  const EmissionColumns samples = kernels.emit(point, sample_count, 1);
  const std::vector<Direction> w = directions(samples);
  const EmissionColumns seen = kernels.emission(point, w);
  const Direction n = direction_of(point, "Ng", 0);
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < sample_count; ++i) {
    ASSERT_GT(samples.at("pdf")[i], 0.0f);
    ASSERT_EQ(std::bit_cast<std::uint32_t>(samples.at("pdf")[i]),
              std::bit_cast<std::uint32_t>(seen.at("pdf")[i]));
    const double cosine =
        std::abs(double(n.x) * w[i].x + double(n.y) * w[i].y + double(n.z) * w[i].z);
    const double weight = samples.at("weight.x")[i];
    ASSERT_NEAR(weight, seen.at("emission.x")[i] * cosine / samples.at("pdf")[i],
                1e-4 * weight + 1e-6);
    sum += weight, squares += weight * weight;
  }
  const SpherePartition cells(
      [&](const std::vector<Direction>& wo) {
        EmissionColumns there = kernels.emission(point, wo);
        std::vector<float> light;
        for (std::size_t i = 0; i < wo.size(); ++i) {
          const float cosine = std::abs(n.x * wo[i].x + n.y * wo[i].y + n.z * wo[i].z);
          light.push_back(there.at("emission.x")[i] * cosine);
        }
        return SpherePartition::Densities{std::move(there.at("pdf")), std::move(light)};
      },
      w, double(sample_count));
  EXPECT_NEAR(cells.pdf_integral(), 1.0, 1e-3);
  const double mean = sum / sample_count;
  const double deviation = std::sqrt((squares / sample_count - mean * mean) / sample_count);
  EXPECT_NEAR(mean, cells.f_integral(), 5.5 * deviation);
}

// Radiance as far as floats go, and as near to nothing, has samples.
TEST(EmitKernel, ColoursOfAnySizeHaveDensities) {
  for (const char* color : {"3e38, 0, 1e-30", "1e-37, 0, 0"}) {
    EmissionCase row{.name = "far", .nodes = {}};
    row.nodes =
        std::string(
            R"(<uniform_edf name="a" type="EDF"><input name="color" type="color3" value=")") +
        color + R"("/></uniform_edf>
      <multiply name="m" type="EDF"><input name="in1" type="EDF" nodename="a"/><input name="in2" type="float" value="1e-1"/></multiply>
      <conical_edf name="c" type="EDF"><input name="color" type="color3" value="1, 1, 1"/></conical_edf>
      <add name="e" type="EDF"><input name="in1" type="EDF" nodename="m"/><input name="in2" type="EDF" nodename="c"/></add>)";
    const EmissionKernels kernels(row, emission_options(Accuracy::standard));
    const EmissionColumns samples = kernels.emit(upright_point(), 1000, 2);
    for (std::size_t i = 0; i < 1000; ++i) {
      ASSERT_GT(samples.at("pdf")[i], 0.0f);
      for (const char* k : {"weight.x", "weight.y", "weight.z"}) {
        ASSERT_TRUE(std::isfinite(samples.at(k)[i]) && samples.at(k)[i] >= 0.0f) << color;
      }
    }
    const std::vector<Direction> below{{0.6f, 0.0f, -0.8f}};
    EXPECT_GT(kernels.emission(upright_point(), below).at("pdf")[0], 0.0f) << color;
  }
}

// A profile's samples keep to where it shines, whatever numbers they are drawn by.
TEST(EmitKernel, NumbersOfAnyBitsGiveDirectionsOrNone) {
  const float infinite = std::numeric_limits<float>::infinity();
  const float numbers[] = {0.0f,
                           1.0f,
                           -1.0f,
                           0x1.fffffep-1f,
                           infinite,
                           -infinite,
                           std::numeric_limits<float>::quiet_NaN(),
                           1e-40f,
                           0.5f};
  for (const EmissionCase& row : emission_cases()) {
    const EmissionKernels kernels(row, emission_options(Accuracy::standard));
    EmissionColumns in = upright_point();
    for (const float x : numbers) {
      for (const float y : numbers) {
        for (const float z : numbers) {
          in["u.x"].push_back(x), in["u.y"].push_back(y), in["u.z"].push_back(z);
        }
      }
    }
    const std::size_t count = in.at("u.x").size();
    const EmissionColumns out = EmissionKernels::run(*kernels.material().emit, in, count);
    for (std::size_t i = 0; i < count; ++i) {
      const Direction w = direction_of(out, "emitted", i);
      ASSERT_NEAR(w.x * w.x + w.y * w.y + w.z * w.z, 1.0f, 1e-5f) << row.name << i;
      ASSERT_TRUE(out.at("pdf")[i] >= 0.0f && std::isfinite(out.at("pdf")[i])) << row.name << i;
      ASSERT_TRUE(out.at("weight.x")[i] >= 0.0f && out.at("weight.x")[i] <= 1.01 * row.most_weight)
          << row.name << i << " " << out.at("weight.x")[i];
    }
  }
}

TEST(EmitKernel, ViewsOfAnyBitsHaveADensity) {
  const float infinite = std::numeric_limits<float>::infinity();
  const float numbers[] = {
      0.0f,  1.0f,   -1.0f,      infinite, std::numeric_limits<float>::quiet_NaN(),
      3e38f, 1e-38f, 0.70710678f};
  std::vector<Direction> wo;
  for (const float x : numbers) {
    for (const float y : numbers) {
      for (const float z : numbers) wo.push_back({x, y, z});
    }
  }
  for (const EmissionCase& row : emission_cases()) {
    const EmissionKernels kernels(row, emission_options(Accuracy::standard));
    const EmissionColumns seen = kernels.emission(tilted_point(), wo);
    for (std::size_t i = 0; i < wo.size(); ++i) {
      const float pdf = seen.at("pdf")[i], light = seen.at("emission.x")[i];
      ASSERT_TRUE(pdf >= 0.0f && std::isfinite(pdf)) << row.name << i << " " << pdf;
      ASSERT_TRUE(light >= 0.0f && std::isfinite(light)) << row.name << i << " " << light;
    }
  }
}

}  // namespace
}  // namespace nacre
