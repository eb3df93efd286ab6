// What a shader leaves out because the document says so has no part in the picture.
#include <gtest/gtest.h>

#include <cmath>
#include <nacre/lobe_test.hpp>
#include <nacre/nacre.hpp>
#include <random>
#include <string>
#include <vector>

namespace nacre {
namespace {

Document document_of(const std::string& category, const std::string& inputs) {
  const std::string text = R"(<materialx version="1.39"><)" + category +
                           R"( name="S" type="surfaceshader">)" + inputs + "</" + category + ">" +
                           R"(<surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)";
  return Document::parse(text);
}

struct Case {
  const char* category;
  const char* inputs;
};
constexpr Case cases[] = {
    {"standard_surface", ""},
    {"standard_surface", R"(<input name="specular" type="float" value="0"/>)"},
    {"standard_surface", R"(<input name="metalness" type="float" value="1"/>)"},
    {"standard_surface", R"(<input name="transmission" type="float" value="1"/>
                            <input name="coat" type="float" value="0.5"/>)"},
    {"open_pbr_surface", ""},
    {"open_pbr_surface", R"(<input name="specular_weight" type="float" value="0"/>)"},
    {"open_pbr_surface", R"(<input name="fuzz_weight" type="float" value="1"/>)"},
    {"gltf_pbr", ""},
    {"UsdPreviewSurface", ""},
    {"disney_principled", ""},
};

// All parameters live, the general kernel, against those that the document has folded in.
TEST(Pruning, TheGeneralKernelHasTheSameLight) {
  System system;
  std::mt19937 random(4);
  const auto number = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
  std::vector<Direction> wo, wi;
  for (int i = 0; i < 400; ++i) {
    wo.push_back(direction(89.0 * number(), 360.0 * number()));
    wi.push_back(direction(180.0 * number(), 360.0 * number()));
  }
  for (const Case& each : cases) {
    const Document document = document_of(each.category, each.inputs);
    CompileOptions general;
    general.live = {"*"};
    const Shader pruned = system.compile_material(document, "M");
    const Shader whole = system.compile_material(document, "M", general);
    EXPECT_LT(pruned.lobes().size(), whole.lobes().size()) << each.category << each.inputs;
    detail::LobeProbe of_pruned(pruned, nullptr, {}), of_whole(whole, nullptr, {});
    const auto found = of_pruned.evaluate(wo, wi), expected = of_whole.evaluate(wo, wi);
    for (std::size_t i = 0; i < found.f.size(); ++i) {
      ASSERT_NEAR(found.f[i], expected.f[i], 2e-5f * std::fabs(expected.f[i]) + 1e-6f)
          << each.category << each.inputs << i;
    }
    for (std::size_t i = 0; i < 20; ++i) {
      const auto light = of_pruned.albedo(wo[i]), all = of_whole.albedo(wo[i]);
      for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(light[c], all[c], 2e-5f) << each.category;
    }
  }
}

}  // namespace
}  // namespace nacre
