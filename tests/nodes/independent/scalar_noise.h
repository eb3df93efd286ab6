#pragma once

#include <array>
#include <cstdint>
#include <vector>

/// The noises of the standard library, written once more for tests: one point at a
/// time, in double, with tables and loops instead of selections.
namespace nacre::reference {

using Vector2 = std::array<double, 2>;
using Vector3 = std::array<double, 3>;

/// lookup3's hashword() with the length in bytes given apart, so that its published
/// values for texts can be checked: Jenkins, lookup3.c, 2006.
std::uint32_t lookup3(const std::vector<std::uint32_t>& words, std::uint32_t bytes,
                      std::uint32_t initial);
/// lookup3 of whole words, initial value 13.
std::uint32_t hash(const std::vector<std::int32_t>& key);

double cell_noise(const std::vector<double>& p);
/// Component k of the noise with three of them.
double cell_noise(std::vector<double> p, int k);

double perlin(Vector2 p);
double perlin(Vector3 p);
/// Component k of the noise with three of them.
double perlin(Vector2 p, int k);
double perlin(Vector3 p, int k);

/// Distances to the three nearest feature points, in order.
Vector3 worley(const std::vector<double>& p, double jitter);
/// The nearest feature point.
std::vector<double> nearest_feature(const std::vector<double>& p, double jitter);

}  // namespace nacre::reference
