// T-SPEC: specialised kernels of random documents against general ones.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nacre/nacre.h>

#include <algorithm>
#include <nacre/lobe_test/probe.hpp>
#include <nacre/nacre.hpp>

#include "tests/pbs/battery/document_trial.h"
#include "tests/support/material_text.h"

namespace nacre {
namespace {

class Documents : public testing::TestWithParam<int> {};

TEST_P(Documents, SpecialisedAreAsGeneralOnes) {
  for (int i = 0; i < 16; ++i) {
    const auto number = static_cast<std::uint64_t>(16 * GetParam() + i);
    try_document(daily_tier.seed + number, number % 2 == 0 ? NACRE_STANDARD : NACRE_PRECISE,
                 number % 8 == 0);
  }
}

/// A microfacet lobe named b.
std::string facets(const char* category, const char* mode, const char* roughness,
                   std::string_view more) {
  return element(category, "BSDF", "b",
                 value_of("scatter_mode", "string", mode) +
                     value_of("roughness", "vector2", roughness) + std::string(more));
}

// Next to an index of 1 sums over facets stand in for tables, of equal roughnesses; live ones, of
// which nobody knows that, once took the tables.
TEST(Documents, EqualRoughnessesAreThatKnownOrNot) {
  for (const char* mode : {"R", "T", "RT"}) {
    for (const char* index : {"1.003", "1.03", "0.98"}) {
      const std::string text =
          facets("dielectric_bsdf", mode, "0.4, 0.4", value_of("ior", "float", index));
      for (const int accuracy : {NACRE_STANDARD, NACRE_PRECISE}) {
        SCOPED_TRACE(fmt::format("{} {}", mode, index));
        try_material(material_of(text), 1, accuracy, false);
      }
    }
  }
}

// What reflects nothing: live, of which nobody knows it, 1e-16 came back; frozen, as the only lobe,
// it was sampled.
TEST(Documents, BlackMetalIsDarkKnownOrNot) {
  const std::string black = value_of("color0", "color3", "0, 0, 0") +
                            value_of("color90", "color3", "0, 0, 0") +
                            value_of("color82", "color3", "0, 0, 0");
  const std::string none =
      value_of("ior", "color3", "1, 1, 1") + value_of("extinction", "color3", "0, 0, 0");
  const std::string metal = value_of("metalness", "float", "1") +
                            value_of("base_color", "color3", "0, 0, 0") +
                            value_of("specular_roughness", "float", "0.65");
  const std::string brushed = metal + value_of("specular_anisotropy", "float", "1");
  for (const std::string& nodes :
       {facets("generalized_schlick_bsdf", "R", "0.3, 0.3", black),
        element("conductor_bsdf", "BSDF", "b", none + value_of("roughness", "vector2", "0.4, 0.1")),
        element("standard_surface", "surfaceshader", "S", metal),
        element("standard_surface", "surfaceshader", "S", brushed)}) {
    for (const int accuracy : {NACRE_STANDARD, NACRE_PRECISE}) {
      try_material(material_of(nodes), 1, accuracy, true);
    }
  }
}

// What passes white metal was once 0 or what its rounding left.
TEST(Documents, WhiteMetalHidesWhatIsBelow) {
  std::vector<Direction> wo, wi;
  for (int i = 0; i < 500; ++i) {
    wo.push_back(direction(0.17 * i, 31.0 * i));
    wi.push_back(direction(90.5 + 0.17 * i, 77.0 * i));
  }
  System system;
  for (const char* roughness : {"0.05, 0.05", "0.3, 0.3", "1, 1", "0.9, 0.2"}) {
    const std::string metal = element("generalized_schlick_bsdf", "BSDF", "metal",
                                      value_of("roughness", "vector2", roughness));
    const std::string below = element("translucent_bsdf", "BSDF", "below", "");
    const std::string both =
        element("layer", "BSDF", "b", from("top", "BSDF", "metal") + from("base", "BSDF", "below"));
    const Document document = Document::parse(material_of(metal + below + both));
    for (const int accuracy : {NACRE_STANDARD, NACRE_PRECISE}) {
      CompileOptions options;
      options.engine = NACRE_INTERPRETER;
      options.accuracy = accuracy;
      options.no_footprints = true;
      options.live = {"*"};
      const Shader shader = system.compile_material(document, "M", options);
      detail::LobeProbe probe(shader, nullptr, [](Binder&) {});
      EXPECT_EQ(std::ranges::max(probe.evaluate(wo, wi).f), 0.0f) << roughness << ' ' << accuracy;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Documents, testing::Range(0, 4));

}  // namespace
}  // namespace nacre
