#include <gtest/gtest.h>

#include <cmath>
#include <nacre/lobe_test/chi_square.hpp>
#include <nacre/lobe_test/sphere_partition.hpp>

#include "tests/support/random.h"

namespace nacre {
namespace {

// Abramowitz and Stegun, table 26.8.
TEST(Statistics, ChiSquareTailHasPublishedQuantiles) {
  EXPECT_NEAR(chi_square_tail(3.84146, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(23.2093, 10), 0.01, 1e-6);
  EXPECT_NEAR(chi_square_tail(124.342, 100), 0.05, 1e-5);
  EXPECT_NEAR(chi_square_tail(149.449, 100), 0.001, 1e-6);
  EXPECT_NEAR(chi_square_tail(20.0, 40), 0.99655, 1e-4);
}

TEST(Statistics, LevelsOfManyTestsMultiplyToOne) {
  EXPECT_NEAR(1.0 - std::pow(1.0 - level_of_one(500), 500), 1e-3, 1e-12);
}

/// Samples of a density 1 + bias cos(theta) on the sphere, tested against `claimed`.
double probability(double bias, double claimed) {
  const std::size_t n = 100'000;
  Random random(3);
  const auto number = [&] { return static_cast<double>(random.word() >> 11) * 0x1p-53; };
  const SpherePartition cells(
      [&](const std::vector<Direction>& wi) {
        SpherePartition::Densities out;
        for (const Direction& w : wi) {
          out.pdf.push_back(static_cast<float>((1.0 + claimed * w.z) * 0.25 / 3.14159265358979));
        }
        out.f = out.pdf;
        return out;
      },
      {}, static_cast<double>(n));
  EXPECT_NEAR(cells.pdf_integral(), 1.0, 1e-6);
  std::vector<double> counts(cells.cells(), 0.0), expected;
  for (std::size_t c = 0; c < cells.cells(); ++c) expected.push_back(cells.pdf(c));
  for (std::size_t i = 0; i < n;) {
    const double z = 2.0 * number() - 1.0;
    const double azimuth = 360.0 * number();
    if (number() * (1.0 + bias) > 1.0 + bias * z) continue;
    counts[cells.find(direction(std::acos(z) * 57.29577951308232, azimuth))] += 1.0;
    ++i;
  }
  return chi_square_probability(counts, expected);
}

TEST(Statistics, TheTestAcceptsTheRightDensityAndNoOther) {
  EXPECT_GT(probability(0.5, 0.5), 1e-3);
  EXPECT_LT(probability(0.5, 0.4), 1e-6);
}

}  // namespace
}  // namespace nacre
