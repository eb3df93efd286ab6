#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/pbs/battery/furnace.h"
#include "tests/support/random.h"

namespace nacre {
namespace {

struct Film {
  float alpha, index, thickness, film_index;
};

/// What bench/results/furnace.md draws its films from.
Film any_film(Random& random) {
  const auto between = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * 0x1p-32 * double(random.word() >> 32));
  };
  const float alpha = std::exp(between(std::log(0.02), 0.0));
  const float index = between(1.1, 2.5), thickness = between(20.0, 1500.0);
  return {alpha, index, thickness, between(1.1, 2.5)};
}

BsdfPtr under_film(Recorder& recorder, const Film& film, const char* mode) {
  return microfacet_bsdf(recorder, "dielectric_bsdf",
                         {{"ior", number(film.index)},
                          {"roughness", roughness(film.alpha, film.alpha)},
                          {"thinfilm_thickness", number(film.thickness)},
                          {"thinfilm_ior", number(film.film_index)},
                          {"scatter_mode", text(mode)}});
}

// Reflectances that go up and down with the angle: by two cosines for all facets there was up to
// 4.4 % too much light or too little, from inside 4.6 %.
TEST(FurnaceFilms, AnyFilmKeepsTheLight) {
  Random random(11);
  constexpr int films = 24, samples = 1 << 16;
  for (int i = 0; i < films; ++i) {
    const Film film = any_film(random);
    const Furnace over_white([&](Recorder& r) {
      return std::make_shared<LayerBsdf>(under_film(r, film, "R"), white_diffuse(r));
    });
    const Furnace joint([&](Recorder& r) { return under_film(r, film, "RT"); });
    for (const double angle : {0.0, 60.0, 75.0, 85.0, 88.0, 89.5}) {
      SCOPED_TRACE(testing::Message()
                   << "alpha " << film.alpha << " index " << film.index << ", " << film.thickness
                   << " nm of " << film.film_index << ", angle " << angle);
      EXPECT_NEAR(over_white.light(angle, 30.0, samples), 1.0, 2e-2);
      EXPECT_NEAR(joint.light(angle, 30.0, samples), 1.0, 2e-2);
      EXPECT_NEAR(joint.light(180.0 - angle, 30.0, samples), 1.0, 3e-2) << "from inside";
    }
  }
}

// All that there is to see at grazing is the film's, which is a mirror there: no base below it is
// to be brighter than the light, however little the tables know of facets so near to smooth.
TEST(FurnaceFilms, OnNothingMakeNoLightAtGrazing) {
  for (const float index : {1.001f, 1.003f, 1.05f}) {
    const Furnace over_white([&](Recorder& r) {
      const Film film{.alpha = 0.01f, .index = index, .thickness = 550.0f, .film_index = 1.3f};
      return std::make_shared<LayerBsdf>(under_film(r, film, "R"), white_diffuse(r));
    });
    for (const double angle : {88.0, 89.0, 89.5, 89.9, 89.99}) {
      const double light = over_white.light(angle, 30.0, 1 << 16);
      EXPECT_LE(light, 1.02) << index << " angle " << angle;
      EXPECT_GE(light, 0.95) << index << " angle " << angle;
    }
  }
}

}  // namespace
}  // namespace nacre
