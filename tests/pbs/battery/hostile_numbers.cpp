#include "tests/pbs/battery/hostile_numbers.h"

#include <bit>
#include <cmath>
#include <limits>

namespace nacre {

namespace {

constexpr float largest = std::numeric_limits<float>::max();
constexpr float nearly_one = 1.0f - 0x1p-24f;

using Numbers = std::vector<float>;

/// Where formulas of such inputs have their cases, limits and poles.
const Numbers& edges(Meaning meaning) {
  static const Numbers share{0.0f, 1.0f, 1e-6f, 0x1p-24f, nearly_one, 0.5f, 1e-30f, 1.5f};
  static const Numbers color{0.0f, 1.0f, 1e-6f, 0.999f, nearly_one, 0.5f, 1e-30f, 2.0f};
  static const Numbers alpha{0.0f,  1e-8f, 1e-6f, 1e-5f, 0.99e-4f, 1e-4f,
                             1e-3f, 0.01f, 0.1f,  0.3f,  1.0f,     nearly_one};
  static const Numbers index{1.0f, 1.000001f, 0.999999f, 1.001f,   0.999f, 1.05f,    1.33f,
                             1.5f, 2.5f,      40.0f,     1 / 1.5f, 0.1f,   1.00099f, 0.99901f,
                             0.0f, 1e-3f,     1e10f,     1.3f,     1.7f};
  static const Numbers extinction{0.0f, 1e-6f, 1.0f, 3.0f, 10.0f, 1e4f, 1e10f};
  static const Numbers anisotropy{0.0f,  1e-6f, -1e-6f, 0.5f,   0.95f, 0.99f,      0.999f,
                                  -0.6f, 1.0f,  -1.0f,  -0.99f, 0.6f,  nearly_one, -0.999f};
  static const Numbers film{0.0f,   1e-3f, 0.3f, 1.0f,   30.0f,  100.0f, 380.0f,
                            550.0f, 0.55f, 2e3f, 1e-10f, 999.9f, 1e6f,   29.99f};
  static const Numbers degrees{0.0f,  90.0f,  180.0f,   360.0f, 45.0f, 1.0f,
                               -1.0f, 720.0f, 179.999f, 0.01f,  0.25f, 0.5f};
  static const Numbers length{0.0f, 1e-38f, 1e-30f, 1e-20f, 1e-10f, 1e-6f,  1e-3f,
                              1.0f, 10.0f,  1e6f,   1e10f,  1e30f,  largest};
  static const Numbers position{0.0f, 1e-30f, 1e-20f, 1e-6f, 1.0f, -1.0f, 100.0f, 1e6f, 1e20f};
  static const Numbers direction{0.0f, 1.0f, -1.0f, 0.5f, 1e-20f, 1e20f};
  static const Numbers exponent{0.0f, 1.0f, 2.0f, 5.0f, 1e-6f, 0.5f, 100.0f, -1.0f, 1e6f, 50.0f};
  static const Numbers radiance{0.0f, 1.0f, 1e3f, 1e-30f, 1e10f, 1e20f, 1e30f, largest};
  static const Numbers any{0.0f, -0.0f, 1.0f, -1.0f, 0.5f, 2.0f, 1e10f, -1e10f, 1e-10f};
  switch (meaning) {
    case Meaning::share: return share;
    case Meaning::color: return color;
    case Meaning::alpha: return alpha;
    case Meaning::index: return index;
    case Meaning::extinction: return extinction;
    case Meaning::anisotropy: return anisotropy;
    case Meaning::film: return film;
    case Meaning::degrees: return degrees;
    case Meaning::length:
    case Meaning::coefficient: return length;
    case Meaning::position: return position;
    case Meaning::direction: return direction;
    case Meaning::exponent: return exponent;
    case Meaning::radiance: return radiance;
    case Meaning::any: return any;
  }
  return any;
}

double uniform(Random& random) { return static_cast<double>(random.word() >> 11) * 0x1p-53; }

float between(Random& random, double low, double high) {
  return static_cast<float>(low + (high - low) * uniform(random));
}

/// Evenly by its logarithm.
float magnitude(Random& random, double low, double high) {
  return static_cast<float>(low * std::pow(high / low, uniform(random)));
}

/// Anywhere in what such inputs are.
float ordinary(Random& random, Meaning meaning) {
  switch (meaning) {
    case Meaning::share:
    case Meaning::color: return between(random, 0, 1);
    case Meaning::alpha:
      return random.chance(0.5) ? between(random, 0, 1) : magnitude(random, 1e-5, 1);
    case Meaning::index:
      return random.chance(0.7) ? between(random, 0.3, 3) : magnitude(random, 0.1, 40);
    case Meaning::extinction: return between(random, 0, 10);
    case Meaning::anisotropy: return between(random, -1, 1);
    case Meaning::film:
      return random.chance(0.5) ? between(random, 0, 2000) : magnitude(random, 1e-3, 2);
    case Meaning::degrees: return between(random, -180, 180);
    case Meaning::length:
    case Meaning::coefficient: return magnitude(random, 1e-6, 1e6);
    case Meaning::position: return between(random, -10, 10);
    case Meaning::direction: return between(random, -1, 1);
    case Meaning::exponent: return between(random, 0, 10);
    case Meaning::radiance: return magnitude(random, 1e-3, 1e6);
    case Meaning::any: return between(random, -2, 2);
  }
  return 0.0f;
}

/// What arithmetic breaks at, or any bits.
float wild(Random& random) {
  static const Numbers corners{
      0.0f,       -0.0f,           1.0f,      -1.0f, 0x1p-149f, 0x1p-126f, 0x1p-24f,
      nearly_one, 1.0f + 0x1p-23f, 1e-10f,    1e10f, 1e30f,     -1e30f,    largest,
      -largest,   INFINITY,        -INFINITY, NAN,   -1e-10f,   1e-20f,    -0x1p-126f,
      1e20f,      -1e20f,          1e-30f,    2.0f,  0.5f};
  if (random.chance(0.5)) return random.pick(corners);
  return std::bit_cast<float>(static_cast<std::uint32_t>(random.word() >> 32));
}

}  // namespace

std::vector<Hostility> hostilities(Random& random, std::size_t count) {
  std::vector<Hostility> all(count);
  for (Hostility& each : all) {
    const std::uint32_t kind = random.below(4);
    each = kind < 2 ? Hostility::plausible : kind == 2 ? Hostility::mixed : Hostility::wild;
  }
  return all;
}

float hostile_number(Random& random, Meaning meaning, Hostility hostility) {
  const double share = hostility == Hostility::wild    ? 0.6
                       : hostility == Hostility::mixed ? 0.125
                                                       : 0.0;
  if (random.chance(share)) return wild(random);
  return random.chance(0.5) ? random.pick(edges(meaning)) : ordinary(random, meaning);
}

void hostile_direction(Random& random, Hostility hostility, int axis, double along, float out[3]) {
  const double share = hostility == Hostility::wild    ? 0.4
                       : hostility == Hostility::mixed ? 0.06
                                                       : 0.0;
  if (random.chance(share)) {
    for (int i = 0; i < 3; ++i) out[i] = wild(random);
    return;
  }
  static const std::vector<double> angles{0.0,  1e-4,  5.7e-3, 1.0,   30.0,    45.0,
                                          60.0, 80.0,  89.0,   89.9,  89.99,   89.9999,
                                          90.0, 90.01, 100.0,  135.0, 90.0001, 180.0};
  static const std::vector<double> turns{0.0, 90.0, 180.0, 270.0, 30.0, 45.0};
  constexpr double degree = 0.017453292519943295;
  double theta =
      random.chance(0.5) ? random.pick(angles) * degree : std::acos(2.0 * uniform(random) - 1.0);
  if (random.chance(along)) theta = 0.0;
  const double phi = (random.chance(0.3) ? random.pick(turns) : 360.0 * uniform(random)) * degree;
  out[axis] = static_cast<float>(std::cos(theta));
  out[1] = static_cast<float>(std::sin(theta) * std::sin(phi));
  out[2 - axis] = static_cast<float>(std::sin(theta) * std::cos(phi));
}

float hostile_unit(Random& random) {
  static const Numbers ends{0.0f, 0x1p-24f, nearly_one, 0.5f, 0x1p-126f};
  if (random.chance(0.1)) return random.pick(ends);
  return static_cast<float>(random.word() >> 40) * 0x1p-24f;
}

}  // namespace nacre
