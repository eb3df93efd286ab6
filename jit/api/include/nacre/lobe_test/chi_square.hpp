/// \file
/// Pearson's test: part of <nacre/lobe_test.hpp>.
#ifndef NACRE_LOBE_TEST_CHI_SQUARE_HPP
#define NACRE_LOBE_TEST_CHI_SQUARE_HPP

#include <cmath>
#include <cstddef>
#include <vector>

namespace nacre {
inline namespace v0 {

namespace detail {

/// Regularised upper incomplete gamma function (DLMF 8.11.4 and 8.9.2).
inline double upper_gamma(double a, double x) {
  if (x <= 0.0) return 1.0;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-15; ++n) sum += term *= x / (a + n);
    return 1.0 - scale * sum;
  }
  // The continued fraction, by the modified Lentz method.
  double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-14) break;
  }
  return scale * h;
}

}  // namespace detail

/// Probability that a chi-square variable of so many degrees of freedom exceeds x.
inline double chi_square_tail(double x, double degrees) {
  return detail::upper_gamma(0.5 * degrees, 0.5 * x);
}

/// Pearson's test: the probability of counts at least as far from `expected`, which is scaled to
/// the same sum. Neighbours are pooled until 8 are expected.
inline double chi_square_probability(const std::vector<double>& counts,
                                     const std::vector<double>& expected) {
  double all = 0.0, mass = 0.0;
  for (const double n : counts) all += n;
  for (const double e : expected) mass += e;
  const double scale = all / mass;
  double n = 0.0, e = 0.0, last_n = 0.0, last_e = 0.0, x = 0.0;
  int bins = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    n += counts[i], e += expected[i] * scale;
    if (e < 8.0) continue;
    if (bins++ > 0) x += (last_n - last_e) * (last_n - last_e) / last_e;
    last_n = n, last_e = e, n = 0.0, e = 0.0;
  }
  last_n += n, last_e += e;
  x += (last_n - last_e) * (last_n - last_e) / last_e;
  return bins < 2 ? 1.0 : chi_square_tail(x, bins - 1);
}

/// The level of one of `tests` so that all of them together fail by chance with probability 1e-3
/// (Sidak 1967).
inline double level_of_one(double tests) { return -std::expm1(std::log1p(-1e-3) / tests); }

}  // namespace v0
}  // namespace nacre

#endif
