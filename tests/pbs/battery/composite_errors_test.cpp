// T-ORA of what is made of several closures: machine code beside the same in double precision, with
// everything as exact as there is. Closures' own formulas are held to the papers' in
// oracle_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <nacre/nacre.hpp>

#include "tests/pbs/battery/composite_trial.h"
#include "tests/support/material_text.h"
#include "tests/support/random.h"

namespace nacre {
namespace {

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// Whether a mode promises rounding alone: sums over facets (unequal roughness, indices near 1) and
/// films have errors of their own (bench/results/lobes.md).
bool is_plain(const CompositeAxis& axis, const std::string& value) {
  if (has(axis.name, "nisotrop"))
    return value == (axis.name == "specular1Anisotropy" ? "0.5" : "0");
  const bool is_film = has(axis.name, "film_thickness") || has(axis.name, "film_weight") ||
                       axis.name == "thinfilm_thickness" || axis.name == "iridescence";
  if (is_film) return value == "0";
  for (const char* index : {"IOR", "Ior", "ior"}) {
    if (has(axis.name, index)) return std::stod(value) >= 1.3 && std::stod(value) <= 2.5;
  }
  if (axis.type != "vector2") return true;
  const std::size_t comma = value.find(", ");
  return value.substr(0, comma) == value.substr(comma + 2);
}

std::string plain_inputs(const Composite& row, Random& random) {
  std::string text;
  for (const CompositeAxis& axis : row.axes) {
    std::vector<std::string> values;
    std::ranges::copy_if(axis.values, std::back_inserter(values),
                         [&](const std::string& value) { return is_plain(axis, value); });
    EXPECT_FALSE(values.empty()) << axis.name;
    const std::string& value = random.pick(values);
    if (!value.empty()) text += value_of(axis.name, axis.type, value);
  }
  return text;
}

class CompositeErrors : public testing::TestWithParam<Composite> {};

// For 999 of 1000 numbers, relative, of no less than a hundredth of the largest.
TEST_P(CompositeErrors, AreThoseOfTheMode) {
  const Composite& row = GetParam();
  static System system;
  Random random(11);
  constexpr int configurations = 3;
  for (int i = 0; i < configurations; ++i) {
    const std::string text = material_of(filled(row.nodes, plain_inputs(row, random)));
    SCOPED_TRACE(text);
    const auto error = [&](int accuracy) {
      CompileOptions options;
      options.accuracy = accuracy;
      options.measure_error = true;
      options.no_footprints = true;
      options.entries =
          1u << NACRE_BEGIN | 1u << NACRE_SAMPLE | 1u << NACRE_EVALUATE | 1u << NACRE_ALBEDO;
      const Shader shader = system.compile_material(Document::parse(text), "M", options);
      EXPECT_TRUE(shader.error()) << accuracy;
      return shader.error().value_or(ShaderError{});
    };
    const ShaderError standard = error(NACRE_STANDARD), fast = error(NACRE_FAST);
    EXPECT_LE(standard.p999, row.standard_error) << standard.worst;
    EXPECT_LE(fast.p999, 1e-2) << fast.worst;
    EXPECT_LE(standard.p999, fast.p999 + 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CompositeErrors,
                         testing::ValuesIn(composites().begin(), composites().end()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace nacre
