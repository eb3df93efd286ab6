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

/// A lobe as wide as `deviation` about a direction, which is so many deviations above the equator,
/// where cells end, and drawn from so often: what the cells hold of it.
double seen_of_lobe(double deviations, std::size_t pilots) {
  constexpr double deviation = 1e-3, pi = 3.14159265358979;
  Random random(5);
  const auto number = [&] { return static_cast<double>((random.word() >> 11) + 1) * 0x1p-53; };
  const double azimuth = 1.0, height = deviations * deviation;
  const auto offset = [&](double along, double up) {
    const double a = azimuth + along, y = height + up, across = std::sqrt(1.0 - y * y);
    return Direction{static_cast<float>(across * std::cos(a)), static_cast<float>(y),
                     static_cast<float>(across * std::sin(a))};
  };
  std::vector<Direction> pilot;
  for (std::size_t i = 0; i < pilots; ++i) {
    const double r = deviation * std::sqrt(-2.0 * std::log(number())), t = 2.0 * pi * number();
    pilot.push_back(offset(r * std::cos(t), r * std::sin(t)));
  }
  const SpherePartition cells(
      [&](const std::vector<Direction>& wi) {
        SpherePartition::Densities out;
        for (const Direction& w : wi) {
          const double along =
              std::remainder(std::atan2(double(w.z), double(w.x)) - azimuth, 2.0 * pi);
          const double up = double(w.y) - height;
          const double squared = (along * along + up * up) / (deviation * deviation);
          out.pdf.push_back(
              static_cast<float>(std::exp(-0.5 * squared) / (2.0 * pi * deviation * deviation)));
        }
        out.f = out.pdf;
        return out;
      },
      pilot, 1e6);
  return cells.pdf_integral();
}

// 3.8 deviations from its middle a lobe has 7.2e-5 left: 72 of a million samples, in a cell that is
// wide as the sphere's 128th part and has no node of the quadrature that near.
TEST(Statistics, CornersOfNarrowLobesAreSeen) {
  for (const double deviations : {3.0, 3.4, 3.8}) {
    EXPECT_NEAR(seen_of_lobe(deviations, 62'500), 1.0, 1e-5) << deviations;
  }
}

}  // namespace
}  // namespace nacre
