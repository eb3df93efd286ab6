// Directions that light leaves along: samples, their density, radiance and power are one thing.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nacre/lobe_test/chi_square.hpp>
#include <nacre/lobe_test/sphere_partition.hpp>
#include <tuple>

#include "tests/pbs/edf/emission_kernels.h"

namespace nacre {
namespace {

constexpr std::uint64_t seed = 20261124;
constexpr std::size_t sample_count = 100'000;

double cosine(const EmissionColumns& point, Direction w) {
  const Direction n = direction_of(point, "Ng", 0);
  return std::abs(double(n.x) * w.x + double(n.y) * w.y + double(n.z) * w.z);
}

std::vector<Direction> directions(const EmissionColumns& samples) {
  std::vector<Direction> list;
  for (std::size_t i = 0; i < samples.at("pdf").size(); ++i) {
    list.push_back(direction_of(samples, "emitted", i));
  }
  return list;
}

SpherePartition cells_of(const EmissionKernels& kernels, const EmissionColumns& point) {
  return SpherePartition(
      [&](const std::vector<Direction>& wo) {
        EmissionColumns seen = kernels.emission(point, wo);
        std::vector<float> light = std::move(seen.at("emission.x"));
        for (std::size_t i = 0; i < wo.size(); ++i) {
          light[i] = static_cast<float>(light[i] * cosine(point, wo[i]));
        }
        return SpherePartition::Densities{std::move(seen.at("pdf")), std::move(light)};
      },
      directions(kernels.emit(point, 4096, ~seed)), double(sample_count));
}

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

using Parameter = std::tuple<EmissionCase, Accuracy>;

class Emission : public testing::TestWithParam<Parameter> {
 protected:
  const EmissionCase& row() const { return std::get<0>(GetParam()); }
  Accuracy accuracy() const { return std::get<1>(GetParam()); }
  /// Fast sines lose some of a narrow shape.
  double lost() const { return accuracy() == Accuracy::fast ? row().lost * 30 : row().lost; }

  void check_samples(const EmissionKernels& kernels, const EmissionColumns& point,
                     const EmissionColumns& samples) {
    const std::vector<Direction> w = directions(samples);
    const EmissionColumns seen = kernels.emission(point, w);
    double most = 0.0;
    std::size_t lost_count = 0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      ASSERT_NEAR(double(w[i].x) * w[i].x + double(w[i].y) * w[i].y + double(w[i].z) * w[i].z, 1.0,
                  1e-5);
      const float pdf = samples.at("pdf")[i];
      if (pdf == 0.0f) {
        ++lost_count;
        for (const char* k : {"weight.x", "weight.y", "weight.z"})
          ASSERT_EQ(samples.at(k)[i], 0.0f);
        continue;
      }
      // To the bit, but where LLVM orders sums as it likes.
      if (accuracy() == Accuracy::fast) {
        ASSERT_NEAR(seen.at("pdf")[i], pdf, 1e-3f * pdf);
      } else {
        ASSERT_EQ(bits(seen.at("pdf")[i]), bits(pdf)) << i;
      }
      for (const char* k : {"x", "y", "z"}) {
        const double light = seen.at(std::string("emission.") + k)[i] * cosine(point, w[i]);
        const double weight = samples.at(std::string("weight.") + k)[i];
        ASSERT_NEAR(weight, light / pdf, 2e-3 * weight + 1e-6) << i;
      }
      most = std::max(most, double(samples.at("weight.x")[i]));
    }
    EXPECT_LE(most, row().most_weight);
    EXPECT_LE(double(lost_count) / double(w.size()), lost());
  }

  void check_distribution(const EmissionKernels& kernels, const EmissionColumns& point,
                          double power) {
    const EmissionColumns samples = kernels.emit(point, sample_count, seed);
    check_samples(kernels, point, samples);
    const SpherePartition cells = cells_of(kernels, point);
    EXPECT_NEAR(cells.pdf_integral(), 1.0, 2e-3);
    std::vector<double> counts(cells.cells(), 0.0), expected(cells.cells());
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < sample_count; ++i) {
      const double weight = samples.at("weight.x")[i];
      sum += weight, squares += weight * weight;
      if (samples.at("pdf")[i] > 0.0f) {
        counts[cells.find(direction_of(samples, "emitted", i))] += 1.0;
      }
    }
    for (std::size_t c = 0; c < expected.size(); ++c) expected[c] = cells.pdf(c);
    EXPECT_GT(chi_square_probability(counts, expected),
              level_of_one(double(4 * emission_cases().size())));
    const double n = double(sample_count), mean = sum / n;
    const double deviation = std::sqrt(std::max(squares / n - mean * mean, 0.0) / n);
    EXPECT_NEAR(mean, cells.f_integral(), 5.5 * deviation + (2e-3 + lost()) * mean);
    if (power > 0.0) {
      EXPECT_NEAR(mean, power, 5.5 * deviation + (5e-4 + lost()) * power);
      if (row().spread > 0.0) {
        EXPECT_LE(deviation * std::sqrt(n), row().spread * mean);
      }
    }
  }
};

TEST_P(Emission, SamplesFollowTheDensityAndCarryThePower) {
  const EmissionKernels kernels(row(), emission_options(accuracy()));
  check_distribution(kernels, upright_point(), row().power);
}

// The cosine is to the surface itself, whatever normal it is shaded by.
TEST_P(Emission, HoldsWhereTheShadingNormalIsAnother) {
  const EmissionKernels kernels(row(), emission_options(accuracy()));
  check_distribution(kernels, tilted_point(), 0.0);
}

std::string case_name(const testing::TestParamInfo<Parameter>& info) {
  return std::get<0>(info.param).name + "_" + std::string(accuracy_name(std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(All, Emission,
                         testing::Combine(testing::ValuesIn(emission_cases()),
                                          testing::Values(Accuracy::standard, Accuracy::fast)),
                         case_name);

class EmissionEngines : public testing::TestWithParam<EmissionCase> {};

TEST_P(EmissionEngines, GiveTheSameBits) {
  constexpr std::size_t count = 517;
  const auto samples = [&](const ShaderOptions& options) {
    return EmissionKernels(GetParam(), options).emit(tilted_point(), count, seed);
  };
  const EmissionColumns one = samples(emission_options(Accuracy::standard, Backend::interpreter));
  for (const int lanes : {1, 4, 16}) {
    const EmissionColumns other =
        samples(emission_options(Accuracy::standard, Backend::jit, lanes));
    for (const auto& [name, column] : one) {
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(bits(column[i]), bits(other.at(name)[i])) << name << i << " of " << lanes;
      }
    }
  }
}

// Of the direction that floats lead to doubles give the density, too.
TEST_P(EmissionEngines, DensityIsThatOfTheReference) {
  const EmissionKernels kernels(GetParam(), emission_options(Accuracy::standard));
  const EmissionKernels reference(GetParam(),
                                  emission_options(Accuracy::standard, Backend::reference));
  const EmissionColumns samples = kernels.emit(tilted_point(), 1000, seed);
  const EmissionColumns found = reference.emission(tilted_point(), directions(samples));
  std::size_t apart = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const float pdf = samples.at("pdf")[i];
    if (std::abs(found.at("pdf")[i] - pdf) > 2e-3f * pdf) ++apart;
  }
  EXPECT_LE(double(apart), 1000 * std::max(0.005, 10 * GetParam().lost));
}

INSTANTIATE_TEST_SUITE_P(All, EmissionEngines, testing::ValuesIn(emission_cases()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace nacre
