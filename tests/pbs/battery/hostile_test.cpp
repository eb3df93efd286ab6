#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/pbs/battery/lobe_kernels.h"
#include "tests/support/random.h"

namespace nacre {
namespace {

constexpr std::size_t count = 40'000;

/// 40 % any bits, 40 % values at which arithmetic breaks, 20 % plausible ones.
float hostile(Random& random) {
  static const std::vector<float> corners{
      0.0f,   -0.0f, 1.0f,  -1.0f,  0x1p-149f, 0x1p-126f, 0x1p-24f, 1.0f - 0x1p-24f,
      1e-10f, 1e10f, 1e30f, -1e30f, 3.4e38f,   -3.4e38f,  INFINITY, -INFINITY,
      NAN,    0.5f,  1e-4f, 1e-3f};
  const std::uint32_t kind = random.below(10);
  if (kind < 4) return std::bit_cast<float>(static_cast<std::uint32_t>(random.word() >> 32));
  if (kind < 8) return random.pick(corners);
  return static_cast<float>(random.word() >> 40) * 0x1p-24f;
}

/// Half of the directions are unit vectors, so that the parameters get their turn.
void hostile_directions(Columns& columns, const std::string& name, Random& random) {
  std::vector<Direction> w(count);
  for (Direction& d : w) {
    if (random.chance(0.5)) {
      const double z = 2.0 * static_cast<double>(random.word() >> 11) * 0x1p-53 - 1.0;
      d = direction(std::acos(z) * 57.29577951308232, random.below(360));
    } else {
      d = {hostile(random), hostile(random), hostile(random)};
    }
  }
  set_directions(columns, name, w);
}

Columns hostile_columns(std::uint64_t seed) {
  Random random(seed);
  Columns columns = lobe_columns(0.0f);
  for (const char* name : {"roughness", "color.x", "color.y", "color.z", "weight", "index"}) {
    std::vector<float>& column = columns[name];
    column.resize(count);
    for (float& x : column) x = hostile(random);
  }
  for (const char* name : {"wo", "wi", "normal"}) hostile_directions(columns, name, random);
  set_random(columns, count, seed);
  return columns;
}

bool sane(float x) { return x >= 0.0f && x <= 3.4028235e38f; }

class HostileLobes : public testing::TestWithParam<std::tuple<LobeCase, Accuracy>> {};

TEST_P(HostileLobes, AnyBitsGiveFiniteLight) {
  const auto& [row, accuracy] = GetParam();
  LobePrograms programs = lobe_programs(row, accuracy, {.hostile = true});
  const Columns in = hostile_columns(7);
  const Columns f = run(*lobe_kernel(std::move(programs.evaluate), accuracy), in);
  for (std::size_t i = 0; i < count; ++i) {
    for (const char* name : {"f.x", "f.y", "f.z", "pdf", "pdf_reverse"}) {
      ASSERT_TRUE(sane(f.at(name)[i])) << name << " " << f.at(name)[i] << " point " << i;
    }
    const float light = std::max({f.at("f.x")[i], f.at("f.y")[i], f.at("f.z")[i]});
    ASSERT_TRUE(light == 0.0f || f.at("pdf")[i] > 0.0f) << light << " point " << i;
  }
  const Columns s = run(*lobe_kernel(std::move(programs.sample), accuracy), in);
  for (std::size_t i = 0; i < count; ++i) {
    for (const char* name : {"weight.x", "weight.y", "weight.z", "pdf", "pdf_reverse"}) {
      ASSERT_TRUE(sane(s.at(name)[i])) << name << " " << s.at(name)[i] << " point " << i;
    }
    if ((static_cast<int>(s.at("flags")[i]) & sample_valid) == 0) continue;
    const float x = s.at("wi.x")[i], y = s.at("wi.y")[i], z = s.at("wi.z")[i];
    ASSERT_NEAR(x * x + y * y + z * z, 1.0f, 1e-5f) << "point " << i;
  }
  const Columns e = run(*lobe_kernel(std::move(programs.albedo), accuracy), in);
  for (const float x : e.at("albedo.x")) ASSERT_TRUE(sane(x) && x <= 1.0f) << x;
}

std::string case_name(const testing::TestParamInfo<std::tuple<LobeCase, Accuracy>>& info) {
  return std::get<0>(info.param).name + "_" + std::string(accuracy_name(std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(All, HostileLobes,
                         testing::Combine(testing::ValuesIn(lobe_cases()),
                                          testing::Values(Accuracy::standard, Accuracy::fast)),
                         case_name);

}  // namespace
}  // namespace nacre
