#include "pbs/thin_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "tests/pbs/independent/thin_film.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

struct Film {
  double thickness, index;
  std::complex<double> substrate;
};

std::vector<Film> films() {
  std::vector<Film> out;
  for (const double index : {1.25, 1.5, 2.2}) {
    for (const std::complex<double> substrate :
         {std::complex<double>(1.5, 0.0), {0.2, 3.4}, {2.9, 3.1}}) {
      for (const double thickness : {100.0, 250.0, 400.0, 700.0, 1500.0, 1e6}) {
        out.push_back({thickness, index, substrate});
      }
    }
  }
  return out;
}

constexpr double cosines[] = {1.0, 0.8, 0.5, 0.25, 0.1};

std::array<double, 3> reflect(const Film& film, double cosine, Accuracy accuracy) {
  const auto out = evaluate({{"c", {static_cast<float>(cosine)}}}, [&](Recorder& r) {
    const ThinFilm thin(film.thickness, film.index, accuracy);
    const Color3 f = thin.reflectance(input(r, "c"), 1.0f, Color3(film.substrate.real()),
                                      Color3(film.substrate.imag()), Color3(0.5f));
    return std::vector<SliceOutput>{{"r", f.x.ref()}, {"g", f.y.ref()}, {"b", f.z.ref()}};
  });
  return {out.at("r")[0], out.at("g")[0], out.at("b")[0]};
}

TEST(ThinFilm, ThickFilmsReflectTheMeanOverAllPhases) {
  for (const Film& film : films()) {
    if (film.thickness < 1e6) continue;
    for (const double cosine : cosines) {
      const double mean =
          reference::mean_over_phases(static_cast<float>(cosine), film.index, film.substrate);
      const auto rgb = reflect(film, cosine, Accuracy::standard);
      for (const double x : rgb) EXPECT_NEAR(x, mean, 2e-6) << film.index << " " << cosine;
    }
  }
}

/// Airy's formula at each of many wave numbers, weighted by the same Gaussians.
TEST(ThinFilm, OrdersOfInterferenceAddUpToAirysFormula) {
  for (const Accuracy accuracy : {Accuracy::fast, Accuracy::standard, Accuracy::precise}) {
    double worst = 0.0;
    for (const Film& film : films()) {
      if (film.thickness >= 1e6) continue;
      for (const double cosine : cosines) {
        const auto expected = reference::thin_film_rgb(
            cosine, film.thickness, film.index, film.substrate, reference::gaussian_sensitivity);
        const auto rgb = reflect(film, cosine, accuracy);
        for (std::size_t c = 0; c < 3; ++c) {
          worst = std::max(worst, std::abs(rgb[c] - std::clamp(expected[c], 0.0, 1.0)));
        }
      }
    }
    // What the orders left out amount to, at worst: index 2.2 on metal at 75 degrees.
    EXPECT_LT(worst, accuracy == Accuracy::fast       ? 0.085
                     : accuracy == Accuracy::standard ? 0.05
                                                      : 0.006);
  }
}

/// Any film on anything, and those that a search found to be the worst for the orders left out:
/// where both interfaces reflect nearly all light, it takes many of them.
TEST(ThinFilm, IsAsFarFromAirysFormulaAsItSaysAtMost) {
  struct Case {
    Film film;
    double cosine;
  };
  std::vector<Case> cases{{{30.0105, 1.80983, {0.645502, 0.0536793}}, 0.0352397},
                          {{53.5273, 1.47983, {0.65623, 0.057047}}, 0.03052},
                          {{35.1, 2.229, {0.194, 1.417}}, 0.0815},
                          {{37.0, 1.744, {0.405, 0.105}}, 0.031},
                          {{58.0, 2.41, {1.0, 6.5}}, 0.2588}};
  std::mt19937 random(11);
  const auto number = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 8) * 0x1p-24);
  };
  for (int i = 0; i < 400; ++i) {
    const double thickness = 30.0 * std::pow(10.0, number(0.0, 2.0));
    const double index = number(1.0, 3.0), n = number(0.05, 4.0);
    const std::complex<double> substrate(n, i % 3 == 0 ? 0.0 : number(0.0, 6.0));
    cases.push_back(
        {{thickness, index, substrate}, i % 2 == 0 ? number(0.02, 0.3) : number(0.02, 1)});
  }
  for (const auto& [accuracy, bound] :
       {std::pair(Accuracy::fast, 0.48), {Accuracy::standard, 0.41}, {Accuracy::precise, 0.005}}) {
    double worst = 0.0;
    for (const Case& each : cases) {
      const auto expected = reference::thin_film_rgb(
          static_cast<float>(each.cosine), each.film.thickness, each.film.index,
          each.film.substrate, reference::gaussian_sensitivity);
      const auto rgb = reflect(each.film, each.cosine, accuracy);
      for (std::size_t c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(rgb[c] - std::clamp(expected[c], 0.0, 1.0)));
      }
    }
    EXPECT_LT(worst, bound) << static_cast<int>(accuracy);
    if (accuracy != Accuracy::precise) {
      EXPECT_GT(worst, 0.95 * bound);
    }
  }
}

/// The same against the CIE 1931 observer, wavelength by wavelength.
TEST(ThinFilm, LooksAsTheStandardObserverSeesIt) {
  double sum = 0.0;
  double worst = 0.0;
  int count = 0;
  for (const Film& film : films()) {
    if (film.thickness >= 1e6) continue;
    for (const double cosine : cosines) {
      const auto expected = reference::thin_film_rgb(
          cosine, film.thickness, film.index, film.substrate, reference::observer_sensitivity);
      const auto rgb = reflect(film, cosine, Accuracy::standard);
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = std::abs(rgb[c] - std::clamp(expected[c], 0.0, 1.0));
        sum += error, worst = std::max(worst, error), ++count;
      }
    }
  }
  EXPECT_LT(sum / count, 0.01);
  EXPECT_LT(worst, 0.1);
}

TEST(ThinFilm, FadesInWithoutASeam) {
  Columns in{{"c", {0.6f}}};
  for (int i = 0; i <= 400; ++i) in["d"].push_back(0.1f * static_cast<float>(i));
  const auto out = evaluate(in, [&](Recorder& r) {
    const ThinFilm thin(input(r, "d"), 1.4f, Accuracy::standard);
    return std::vector<SliceOutput>{
        {"f",
         thin.reflectance(input(r, "c"), 1.0f, Color3(1.5f), Color3(0.0f), Color3(0.2f)).x.ref()}};
  });
  const auto& f = out.at("f");
  EXPECT_NEAR(f[0], 0.2, 1e-7);
  for (std::size_t i = 1; i < f.size(); ++i) EXPECT_LT(std::abs(f[i] - f[i - 1]), 2e-3) << i;
}

TEST(ThinFilm, IsAReflectanceForAnyBits) {
  std::mt19937 random(7);
  const float edges[] = {0.0f,
                         1.0f,
                         1e-38f,
                         1e30f,
                         -1.0f,
                         std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::quiet_NaN()};
  Columns in;
  for (int i = 0; i < 4000; ++i) {
    for (const char* name : {"d", "i", "n", "k"}) {
      in[name].push_back(i % 2 == 0 ? std::bit_cast<float>(static_cast<std::uint32_t>(random()))
                                    : edges[random() % std::size(edges)]);
    }
    in["c"].push_back(static_cast<float>(random() % 1001) / 1000.0f);
    in["before"].push_back(i % 3 == 0 ? 1.0f : 1.5f);
  }
  const auto out = evaluate(in, [&](Recorder& r) {
    const ThinFilm thin(input(r, "d"), input(r, "i"), Accuracy::standard);
    const Color3 n(clamp(input(r, "n"), 0.0f, 1e4f));
    const Color3 k(clamp(input(r, "k"), 0.0f, 1e4f));
    return std::vector<SliceOutput>{
        {"f", thin.reflectance(input(r, "c"), input(r, "before"), n, k, Color3(0.5f)).y.ref()}};
  });
  for (const double f : out.at("f")) EXPECT_TRUE(f >= 0.0 && f <= 1.0) << f;
}

}  // namespace
}  // namespace nacre
