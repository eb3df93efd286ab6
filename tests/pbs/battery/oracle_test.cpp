// T-ORA and T-MONO: machine code against the formula of each closure, in double.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/pbs/battery/oracle_errors.h"
#include "tests/pbs/independent/fresnel.h"
#include "tests/pbs/independent/integral.h"
#include "tests/pbs/independent/microfacet.h"

namespace nacre {
namespace {

/// Where in the order of points, to repeat it.
std::string at(const OraclePoints& points, std::size_t i) {
  std::string text =
      fmt::format("f {} pdf {} albedo {} at", points.f[i], points.pdf[i], points.albedo[i]);
  for (const auto& [name, column] : points.columns) {
    if (column.size() > 1) text += fmt::format(" {}={}", name, column[i]);
  }
  return text;
}

bool full_run() { return std::getenv("NACRE_TEST_FULL") != nullptr; }

/// Errors that do not hang on the mode, as those of tables, are equal but for rounding, of which
/// `precise` has a little more than modes that contract. Of few views one decides: a sum of more
/// facets is no better at each.
void expect_ordered(const ErrorList& better, const ErrorList& worse, const char* what) {
  constexpr double rounding = 1e-4;
  const double scatter = full_run() ? 1.1 : 3.0;
  EXPECT_LE(better.usual(), scatter * worse.usual() + rounding) << what;
}

class Oracle : public testing::TestWithParam<OracleCase> {};

// Without NACRE_TEST_FULL fewer views are taken.
TEST_P(Oracle, LobesAreTheirFormulas) {
  const OracleCase& row = GetParam();
  const std::size_t views = full_run() ? 1000 : 60;
  const OraclePoints points = oracle_points(row, views, 32, 1);
  const auto measure = [&](Accuracy mode) {
    const auto kernel = oracle_kernel(row, mode);
    const OracleGate& gate = mode == Accuracy::fast ? row.fast : row.standard;
    OracleErrors errors = oracle_errors(points, *kernel, gate);
    const auto expect = [&](const char* what, const ErrorList& list) {
      EXPECT_LE(list.usual(), 1.0)
          << accuracy_name(mode) << ", parts of the gate of " << what << "; at worst "
          << list.most() << ": " << at(points, list.worst());
    };
    expect("f", errors.f_by_gate), expect("pdf", errors.pdf_by_gate);
    EXPECT_LE(errors.albedo.most(), row.albedo)
        << accuracy_name(mode) << ": " << at(points, errors.albedo.worst());
    return errors;
  };
  const OracleErrors precise = measure(Accuracy::precise), standard = measure(Accuracy::standard);
  expect_ordered(precise.f, standard.f, "f, precise and standard");
  expect_ordered(precise.pdf, standard.pdf, "pdf, precise and standard");
  if (!row.is_fast_too) return;
  const OracleErrors fast = measure(Accuracy::fast);
  expect_ordered(standard.f, fast.f, "f, standard and fast");
  expect_ordered(standard.pdf, fast.pdf, "pdf, standard and fast");
}

std::string case_name(const testing::TestParamInfo<OracleCase>& info) {
  std::string name;
  for (const char c : info.param.name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  return name;
}

/// Formulas by direction and sums over facets are two ways to one number.
TEST(OracleFormulas, AreWhatTheirIntegralsSay) {
  using namespace reference;
  const auto whole = [](const FacetLobe& lobe) {
    const auto below = [&](Vec wi) { return lobe.at({wi.x, wi.y, -wi.z}); };
    return integral([&](Vec wi) { return lobe.at(wi); }) + integral(below);
  };
  for (const bool beckmann : {false, true}) {
    for (const reference::Facets& facets :
         {reference::Facets{beckmann, 0.6, 0.6}, reference::Facets{beckmann, 1.0, 0.4}}) {
      for (const double index : {1.5, 1.0 / 1.5}) {
        for (const double sine : {0.3, 0.95}) {
          const Vec wo{0.6 * sine, 0.8 * sine, std::sqrt(1.0 - sine * sine)};
          const auto factor = [&](double c) { return fresnel(c, index); };
          const FacetReflection back(facets, wo, factor);
          EXPECT_NEAR(whole(back), back.albedo(), 2e-3) << index << " " << sine;
          const FacetTransmission through(facets, wo, index, index < 1.0);
          EXPECT_NEAR(whole(through), 1.0, 1e-2) << index << " " << sine;
          const FacetInterface both(facets, wo, index, factor);
          EXPECT_NEAR(whole(both), 1.0, 1e-2) << index << " " << sine;
        }
      }
    }
  }
}

/// nodes/DEVIATIONS.md: what a slab of two interfaces reflects, all orders in it added up, and a
/// thin wall does not.
TEST(OracleFormulas, WallsReflectLessThanSlabs) {
  const auto less = [](double cosine) {
    const double f = reference::fresnel(cosine, 1.5);
    double slab = f, inside = (1.0 - f) * (1.0 - f) * f;
    for (int order = 0; order < 2000; ++order, inside *= f * f) slab += inside;
    return slab - f;
  };
  double most = 0.0;
  for (int i = 1; i <= 1000; ++i) most = std::max(most, less(i * 1e-3));
  EXPECT_NEAR(less(1.0), 0.037, 5e-4);
  EXPECT_NEAR(most, 0.172, 5e-4);
}

INSTANTIATE_TEST_SUITE_P(All, Oracle, testing::ValuesIn(oracle_cases()), case_name);

}  // namespace
}  // namespace nacre
