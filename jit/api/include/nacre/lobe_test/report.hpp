/// \file
/// What is asked of lobes and what is found: part of <nacre/lobe_test.hpp>.
#ifndef NACRE_LOBE_TEST_REPORT_HPP
#define NACRE_LOBE_TEST_REPORT_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <nacre/binding.hpp>
#include <nacre/lobe_test/direction.hpp>
#include <string>
#include <vector>

namespace nacre {
inline namespace v0 {

struct LobeTestOptions {
  /// Where the material is looked at from: unit, normal z, tangent x.
  std::vector<Direction> wo = {direction(0), direction(30), direction(60), direction(80),
                               direction(85)};
  std::size_t samples = 100'000;  ///< Of each wo.
  std::uint64_t seed = 1;         ///< The same samples each time: a fault comes again.
  double most_energy = 1.01;      ///< What may leave of the light that arrives.
  double albedo_error = 1e-2;     ///< Of what NACRE_ALBEDO says, absolute.
  double weight_error = 1e-4;     ///< Of densities and weights, relative.
  double unit_error = 1e-3;       ///< Of the squared length of wi.
  const Instance* instance = nullptr;
  std::function<void(Binder&)> bind;  ///< What else the material reads; all other channels are 0.
};

/// A law that does not hold.
struct LobeFault {
  /// "finite": f, pdf, weights and directions are, and none of the numbers is negative.
  /// "lost": a sample that is not valid has weight and density 0. "unit": wi is. "flags": those of
  /// the side that wi is on. "sides": most samples are where the lobes' kinds say, but that what is
  /// glossy and transmits may reflect totally. "density": NACRE_SAMPLE and NACRE_EVALUATE say the
  /// same. "weight": f / pdf. "support": f is 0 where pdf is. "normalised": pdf integrates to the
  /// fraction of valid samples. "samples": they follow the density. "light": the mean weight is the
  /// integral of f. "energy": no more leaves than arrives. "albedo": that is what NACRE_ALBEDO
  /// says.
  std::string law;
  Direction wo;
  double found = 0.0, expected = 0.0;
  std::string text;  ///< All of it, in a line.
};

/// What leaves of the light from one direction.
struct LobeView {
  Direction wo;
  std::array<double, 3> energy{};  ///< Mean weight of the samples: red, green and blue.
  double deviation = 0.0;          ///< Of that mean, of the channel where it is the largest.
  std::array<double, 3> albedo{};  ///< What NACRE_ALBEDO says.
  double valid = 0.0;              ///< Fraction of the samples.
  double chi_square = 1.0;         ///< Probability of samples at least as far from the density.
  /// The greatest ratio of what scatters one way to what scatters the other: 1 for what is
  /// reciprocal, as models need not be.
  double reciprocity = 1.0;
  /// More than a 10,000th of the samples, and two of them, fall where the density is far more than
  /// its quadrature has seen, as of facets that are rough one way and smooth the other:
  /// "normalised", "samples" and "light" are not tried.
  bool is_too_thin = false;
};

struct LobeReport {
  std::vector<LobeView> views;
  std::vector<LobeFault> faults;  ///< At most one of each law for each view.
};

}  // namespace v0
}  // namespace nacre

#endif
