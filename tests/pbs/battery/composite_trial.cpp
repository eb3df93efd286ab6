#include "tests/pbs/battery/composite_trial.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nacre/lobe_test.hpp>
#include <nacre/nacre.hpp>

#include "tests/support/chi_squares.h"
#include "tests/support/material_text.h"
#include "tests/support/random.h"

namespace nacre {

namespace {

constexpr std::size_t whole_configurations = 30, daily_configurations = 1;

std::vector<Direction> views(const Composite& row, const Tier& tier, std::size_t number) {
  std::vector<double> angles{0.0, 1e-4, 45.0, 80.0, 89.0, 89.99};
  if (row.has_inside) angles.insert(angles.end(), {180.0, 130.0, 91.0});
  std::vector<Direction> wo;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (tier.whole || i % 3 == number % 3) wo.push_back(direction(angles[i]));
  }
  return wo;
}

/// Each axis at random: over a night all pairs of values meet.
std::string inputs_of(const Composite& row, Random& random) {
  std::string text;
  for (const CompositeAxis& axis : row.axes) {
    const std::string& value = random.pick(axis.values);
    if (!value.empty()) text += value_of(axis.name, axis.type, value);
  }
  return text;
}

/// The battery's own bounds where test_lobes(), which knows of one call alone, has narrower ones:
/// the level of all chi-squares of a night; what quadrature finds of the narrow lobes of fuzz; and
/// that what transmits turns back from inside, beyond the critical angle.
bool is_within_bounds(const LobeFault& fault) {
  if (fault.law == "samples") return fault.found > chi_square_level();
  if (fault.law == "sides") return fault.wo.z < 0.0f;
  return fault.law == "normalised" && std::abs(fault.found - fault.expected) <= 2e-3;
}

void try_configuration(const Composite& row, const std::string& inputs, const Tier& tier,
                       std::size_t number) {
  static System system;
  const std::string text = material_of(filled(row.nodes, inputs));
  SCOPED_TRACE(fmt::format("{} seed {}\n{}", row.name, tier.seed + number, text));
  CompileOptions compiled;
  compiled.entries =
      1u << NACRE_BEGIN | 1u << NACRE_SAMPLE | 1u << NACRE_EVALUATE | 1u << NACRE_ALBEDO;
  compiled.no_footprints = true;
  const Shader shader = system.compile_material(Document::parse(text), "M", compiled);
  if (!shader.has(NACRE_SAMPLE)) return;  // All of it is black.
  LobeTestOptions options;
  options.wo = views(row, tier, number);
  options.samples = tier.whole ? 200'000 : 30'000;
  options.seed = tier.seed + number;
  options.most_energy = row.most_energy;
  options.albedo_error = row.albedo_error;
  const LobeReport report = test_lobes(shader, options);
  for (const LobeFault& fault : report.faults) {
    if (!is_within_bounds(fault)) ADD_FAILURE() << fault.text;
  }
  if (!row.is_preserving) return;
  for (const LobeView& view : report.views) {
    for (const double energy : view.energy) {
      EXPECT_NEAR(energy, 1.0, 2e-2 + 5.5 * view.deviation) << "wo.z " << view.wo.z;
    }
  }
}

}  // namespace

void try_composite(const Composite& row, const Tier& tier) {
  Random random(tier.seed);
  const std::size_t count =
      tier.whole ? number_of("NACRE_TEST_POINTS", whole_configurations) : daily_configurations;
  for (std::size_t i = 0; i < count; ++i) {
    try_configuration(row, inputs_of(row, random), tier, i);
  }
}

int composite_chi_squares() {
  std::size_t count = 0;
  for (const Composite& row : composites()) {
    count += whole_configurations * views(row, {.whole = true, .seed = 0}, 0).size();
  }
  return static_cast<int>(count);
}

}  // namespace nacre
