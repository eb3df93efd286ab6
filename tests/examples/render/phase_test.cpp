// T-CHI-X of the phase function: media that scatter light almost straight on, or back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "examples/render/medium.h"
#include "tests/support/chi_squares.h"
#include "tests/support/random.h"

namespace nacre::host {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int rows = 24, columns = 12;

/// Directions about `along` by the logarithm of 1 + g^2 - 2 g cos, in which the density is wide.
class Rings {
 public:
  Rings(double g, Vec3 along) : g_(g), along_(along), x_(perpendicular(along)) {
    y_ = cross(along, x_);
    least_ = 2.0 * std::log(1.0 - std::abs(g));
    most_ = 2.0 * std::log(1.0 + std::abs(g));
  }

  std::size_t cell(Vec3 w) const {
    const double row = (std::log(base(w)) - least_) / (most_ - least_) * rows;
    const double phi = std::atan2(double(dot(w, y_)), double(dot(w, x_))) / (2.0 * pi);
    const double column = (phi < 0.0 ? phi + 1.0 : phi) * columns;
    return static_cast<std::size_t>(std::clamp(static_cast<int>(row), 0, rows - 1) * columns +
                                    std::clamp(static_cast<int>(column), 0, columns - 1));
  }

  /// The integral of the host's density over a cell.
  double mass(int row, int column) const {
    constexpr int steps = 64, turns = 4;
    const double width = (most_ - least_) / rows;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double at = std::exp(least_ + (row + (i + 0.5) / steps) * width);
      for (int k = 0; k < turns; ++k) {
        const double phi = 2.0 * pi * (column + (k + 0.5) / turns) / columns;
        // d cos = base d log(base) / (2 g).
        sum += phase(static_cast<float>(g_), along_, direction(at, phi)) * at;
      }
    }
    return sum * width / (2.0 * std::abs(g_)) * (2.0 * pi / columns) / (steps * turns);
  }

 private:
  double side() const { return g_ < 0.0 ? -1.0 : 1.0; }

  double base(Vec3 w) const {
    const double s = side();
    const double x = w.x - s * along_.x, y = w.y - s * along_.y, z = w.z - s * along_.z;
    const double g = std::abs(g_);
    return (1.0 - g) * (1.0 - g) + g * (x * x + y * y + z * z);
  }

  Vec3 direction(double at, double phi) const {
    const double g = std::abs(g_);
    const double apart = std::clamp((at - (1.0 - g) * (1.0 - g)) / (2.0 * g), 0.0, 2.0);
    const double sine = std::sqrt(apart * (2.0 - apart)), cosine = side() * (1.0 - apart);
    const double c = sine * std::cos(phi), s = sine * std::sin(phi);
    const auto sum = [&](float a, float b, float d) {
      return static_cast<float>(cosine * a + c * b + s * d);
    };
    return {sum(along_.x, x_.x, y_.x), sum(along_.y, x_.y, y_.y), sum(along_.z, x_.z, y_.z)};
  }

  double g_, least_, most_;
  Vec3 along_, x_, y_;
};

TEST(NarrowPhase, SamplesFollowTheDensity) {
  constexpr std::size_t count = 400'000;
  std::uint64_t seed = 20261121;
  const double narrow[] = {-0.999, -0.99, -0.9, 0.9, 0.99, 0.999};
  EXPECT_LE(std::size(narrow), chi_squares_of::phases);
  for (const double g : narrow) {
    const Vec3 along = normalize({0.3f, -0.5f, 0.8f});
    const Rings rings(g, along);
    Random random(++seed);
    const auto number = [&] { return static_cast<float>(random.word() >> 40) * 0x1p-24f; };
    std::vector<double> counts(rows * columns, 0.0), expected;
    for (std::size_t i = 0; i < count; ++i) {
      const float u = number(), v = number();
      const Scattered to = sample_phase(static_cast<float>(g), along, {u, v});
      counts[rings.cell(to.direction)] += 1.0;
      const double again = phase(static_cast<float>(g), along, to.direction);
      // What a float direction leaves of the angle to where most light goes.
      ASSERT_NEAR(to.pdf / again, 1.0, 1e-4 + 1e-6 / (1.0 - std::abs(g))) << g << ' ' << u;
    }
    double mass = 0.0;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) expected.push_back(rings.mass(row, column));
    }
    for (const double share : expected) mass += share;
    EXPECT_NEAR(mass, 1.0, 2e-3) << g;
    EXPECT_GT(chi_square_probability(counts, expected), chi_square_level()) << g;
  }
}

/// T-CON: light is scattered evenly where g is 0, and nearly so next to it.
TEST(NarrowPhase, NothingJumpsWhereLightIsScatteredEvenly) {
  const Vec3 along = normalize({0.3f, -0.5f, 0.8f});
  for (const float g : {0.f, 1e-7f, -1e-7f, 1e-5f, -1e-5f, 1e-4f}) {
    for (int i = 0; i < 64; ++i) {
      const Uniform2 u{(static_cast<float>(i) + 0.5f) / 64, 0.3f};
      // Of even scattering the cosine is uniform.
      const float cosine = dot(sample_phase(g, along, u).direction, along);
      EXPECT_NEAR(cosine, 2.f * u.x - 1.f, 2e-4f) << g;
      EXPECT_NEAR(sample_phase(g, along, u).pdf * 4.f * static_cast<float>(pi), 1.f, 1e-3f) << g;
    }
  }
}

}  // namespace
}  // namespace nacre::host
