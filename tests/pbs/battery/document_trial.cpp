#include "tests/pbs/battery/document_trial.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nacre/lobe_test/probe.hpp>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "tests/pbs/battery/random_document.h"
#include "tests/support/random.h"

namespace nacre {

namespace {

/// Each kernel is as near to double precision as RoundingBounds::value says of 999 of 1000 points,
/// so two are no further apart (specialization_test.cpp).
constexpr double most_apart = 2e-4;
constexpr std::size_t count = 600;

/// How a document is compiled.
struct Form {
  const char* name;
  int engine;
  bool live, varying;
};

System& system_of_all() {
  static System system;
  return system;
}

Shader compiled(const Document& document, const Form& form, int accuracy) {
  CompileOptions options;
  options.engine = form.engine;
  options.accuracy = accuracy;
  options.no_footprints = true;
  options.entries =
      1u << NACRE_BEGIN | 1u << NACRE_SAMPLE | 1u << NACRE_EVALUATE | 1u << NACRE_ALBEDO;
  if (form.live) options.live = {"*"};
  if (form.varying) options.varying = {"*"};
  return system_of_all().compile_material(document, "M", options);
}

/// Binds uv0 and P to a place, and parameters that come with the point to what the document says.
void bind_all(const Shader& shader, Binder& binder) {
  binder.constant("uv0", {0.3f, 0.7f}).constant("P", {0.35f, 1.6f, -0.4f});
  binder.constant("Po", {0.35f, 1.6f, -0.4f});
  for (const Parameter& parameter : shader.parameters()) {
    if (!parameter.is_varying) continue;
    std::vector<float> v = parameter.value;
    if (parameter.number_type != NACRE_FLOAT) {
      for (float& x : v) x = std::bit_cast<float>(static_cast<std::int32_t>(x));
    }
    switch (v.size()) {
      case 1: binder.constant(parameter.name, {v[0]}); break;
      case 2: binder.constant(parameter.name, {v[0], v[1]}); break;
      case 3: binder.constant(parameter.name, {v[0], v[1], v[2]}); break;
      default: binder.constant(parameter.name, {v[0], v[1], v[2], v[3]});
    }
  }
}

struct Answers {
  std::vector<float> f, pdf, albedo;
  detail::LobeProbe::Samples samples;
};

Answers answers_of(const Shader& shader, const std::vector<Direction>& wo,
                   const std::vector<Direction>& wi) {
  detail::LobeProbe probe(shader, nullptr, [&](Binder& binder) { bind_all(shader, binder); });
  Answers answers;
  detail::LobeProbe::Values values = probe.evaluate(wo, wi);
  answers.f = std::move(values.f), answers.pdf = std::move(values.pdf);
  for (std::size_t i = 0; i < 20; ++i) {
    for (const float share : probe.albedo(wo[i])) answers.albedo.push_back(share);
  }
  answers.samples = probe.sample(wo[0], count, 1);
  return answers;
}

/// The relative difference that 999 of 1000 stay below, of numbers that are at least a millionth of
/// the largest.
double apart(const std::vector<float>& a, const std::vector<float>& b) {
  const double peak = *std::ranges::max_element(a);
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double scale = std::max({double(std::abs(a[i])), 1e-6 * peak, 1e-30});
    differences.push_back(std::abs(double(a[i]) - b[i]) / scale);
  }
  std::ranges::sort(differences);
  return differences[static_cast<std::size_t>(0.999 * static_cast<double>(a.size() - 1))];
}

/// The share of samples that are others: rounding may choose another lobe, but seldom.
double other_samples(const detail::LobeProbe::Samples& a, const detail::LobeProbe::Samples& b) {
  std::size_t others = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Direction v = a.wi[i], w = b.wi[i];
    const bool is_valid = (a.flags[i] & NACRE_SAMPLE_VALID) != 0;
    bool same = a.flags[i] == b.flags[i];
    if (same && is_valid) {
      same = std::abs(v.x - w.x) + std::abs(v.y - w.y) + std::abs(v.z - w.z) < 1e-3f;
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
        same = same && std::abs(a.weight[c] - b.weight[c]) <= 1e-2f * std::abs(a.weight[c]) + 1e-5f;
      }
    }
    others += !same;
  }
  return static_cast<double>(others) / static_cast<double>(count);
}

void expect_near(const Answers& found, const Answers& expected) {
  EXPECT_LE(apart(expected.f, found.f), most_apart);
  EXPECT_LE(apart(expected.pdf, found.pdf), most_apart);
  EXPECT_LE(apart(expected.albedo, found.albedo), most_apart);
  EXPECT_LE(other_samples(expected.samples, found.samples), 5e-3);
}

void expect_same(const Answers& found, const Answers& expected) {
  EXPECT_EQ(found.f, expected.f);
  EXPECT_EQ(found.pdf, expected.pdf);
  EXPECT_EQ(found.albedo, expected.albedo);
  EXPECT_EQ(found.samples.weight, expected.samples.weight);
}

/// Every lobe of the general kernels is in those for the constants, or in what they leave out.
void expect_manifest(const Shader& pruned, const Shader& general) {
  const std::vector<LobeInfo> there = pruned.lobes();
  const std::vector<std::string> lines = pruned.left_out();
  for (const LobeInfo& lobe : general.lobes()) {
    const bool is_there =
        std::ranges::any_of(there, [&](const LobeInfo& other) { return other.path == lobe.path; });
    const bool is_named =
        std::ranges::count(lines, lobe.name + " at " + lobe.path + ": weight 0") > 0;
    EXPECT_NE(is_there, is_named) << lobe.name << " at " << lobe.path;
  }
}

}  // namespace

void try_document(std::uint64_t seed, int accuracy, bool by_machine_code) {
  try_material(random_document(seed), seed, accuracy, by_machine_code);
}

void try_material(const std::string& text, std::uint64_t seed, int accuracy, bool by_machine_code) {
  SCOPED_TRACE(fmt::format("seed {} accuracy {}\n{}", seed, accuracy, text));
  const Document document = Document::parse(text);
  const Shader pruned = compiled(document, {"frozen", NACRE_INTERPRETER, false, false}, accuracy);
  const Shader live = compiled(document, {"live", NACRE_INTERPRETER, true, false}, accuracy);
  expect_manifest(pruned, live);
  Random random(seed);
  const auto number = [&] { return static_cast<double>(random.word() >> 40) * 0x1p-24; };
  std::vector<Direction> wo, wi;
  for (std::size_t i = 0; i < count; ++i) {
    wo.push_back(direction(89.0 * number(), 360.0 * number()));
    wi.push_back(direction(180.0 * number(), 360.0 * number()));
  }
  if (!pruned.has(NACRE_EVALUATE)) {
    // All of it is dark: so says what may change.
    if (!live.has(NACRE_EVALUATE)) return;
    const Answers dark = answers_of(live, wo, wi);
    EXPECT_EQ(*std::ranges::max_element(dark.f), 0.0f);
    return;
  }
  const Answers expected = answers_of(live, wo, wi);
  const Answers found = answers_of(pruned, wo, wi);
  {
    SCOPED_TRACE("frozen against live");
    expect_near(found, expected);
  }
  const Shader varying = compiled(document, {"varying", NACRE_INTERPRETER, true, true}, accuracy);
  {
    SCOPED_TRACE("varying against live");
    expect_near(answers_of(varying, wo, wi), expected);
  }
  if (!by_machine_code) return;
  SCOPED_TRACE("machine code against the interpreter");
  expect_same(
      answers_of(compiled(document, {"machine", NACRE_JIT, false, false}, accuracy), wo, wi),
      found);
}

}  // namespace nacre
