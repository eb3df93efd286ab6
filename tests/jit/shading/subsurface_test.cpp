// Light that goes below surfaces: what sample, evaluate and the kernel of its medium say of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>

#include "tests/jit/shading/own_library.h"

namespace nacre {
namespace {

class Subsurface : public OwnLibrary {
 protected:
  /// The material of a BSDF b, with the kernel.
  void compile(const std::string& nodes) {
    options_.kernels.entries |= entry_subsurface;
    kernels_ = material(nodes);
    ASSERT_NE(kernels_, nullptr) << diagnostics_.to_string();
  }

  static std::string flesh(const std::string& name, const std::string& radius,
                           const std::string& color = "0.5, 0.25, 1") {
    return "<subsurface_bsdf name=\"" + name + "\" type=\"BSDF\">" +
           "<input name=\"color\" type=\"color3\" value=\"" + color + "\"/>" +
           "<input name=\"radius\" type=\"color3\" value=\"" + radius + "\"/></subsurface_bsdf>";
  }

  /// With what `begin` finds at a point seen from straight above.
  Numbers at_point(const BoundKernel& kernel, Numbers point) {
    point["wo.z"] = 1.0f;
    const Numbers state = kernels_->begin ? run(*kernels_->begin, point) : Numbers();
    point.insert(state.begin(), state.end());
    return run(kernel, point);
  }
  Numbers sample(float u) {
    return at_point(*kernels_->sample, {{"u.x", 0.3f}, {"u.y", 0.7f}, {"u.z", u}});
  }
  static std::int32_t flags(const Numbers& sample) {
    return std::bit_cast<std::int32_t>(sample.at("flags"));
  }
  bool says_radius() const {
    return std::ranges::any_of(kernels_->manifest, [](const std::string& line) {
      return line.find("radius and anisotropy") != line.npos;
    });
  }

  std::unique_ptr<MaterialKernels> kernels_;
};

// All of it enters: what comes back is the walk's.
TEST_F(Subsurface, SampleGoesBelow) {
  compile(flesh("b", "1, 0.5, 0.25"));
  const Numbers down = sample(0.5f);
  EXPECT_EQ(flags(down), sample_valid | sample_delta | sample_transmission | sample_subsurface);
  EXPECT_LT(down.at("wi.z"), 0.0f);
  for (const char* channel : {"weight.x", "weight.y", "weight.z", "pdf"}) {
    EXPECT_FLOAT_EQ(down.at(channel), 1.0f) << channel;
  }
  const Numbers along = at_point(*kernels_->evaluate, {{"wi.z", 1.0f}});
  EXPECT_EQ(along.at("f.x"), 0.0f);
  EXPECT_EQ(along.at("pdf"), 0.0f);
  EXPECT_FALSE(says_radius());
}

TEST_F(Subsurface, MediumHasItsRadius) {
  compile(flesh("b", "1, 0.5, 0.25"));
  ASSERT_TRUE(kernels_->subsurface);
  const Numbers below = run(*kernels_->subsurface, {{"wo.z", 1.0f}});
  EXPECT_NEAR(below.at("absorption.x") + below.at("scattering.x"), 1.0f, 1e-5f);
  EXPECT_NEAR(below.at("absorption.y") + below.at("scattering.y"), 2.0f, 1e-5f);
  EXPECT_NEAR(below.at("absorption.z") + below.at("scattering.z"), 4.0f, 1e-5f);
  EXPECT_EQ(below.at("absorption.z"), 0.0f);  // Blue is white.
  EXPECT_FLOAT_EQ(below.at("albedo.y"), 0.25f);
  EXPECT_FLOAT_EQ(below.at("normal.z"), 1.0f);
}

// Two of them: `lobe` says which one light went below by.
TEST_F(Subsurface, MediumIsOfTheLobeThatWasSampled) {
  compile(flesh("thin", "1, 1, 1") + flesh("deep", "4, 4, 4") +
          R"(<mix name="b" type="BSDF"><input name="fg" type="BSDF" nodename="thin"/>
             <input name="bg" type="BSDF" nodename="deep"/>
             <input name="mix" type="float" value="0.25"/></mix>)");
  for (const float u : {0.1f, 0.9f}) {
    const Numbers down = sample(u);
    EXPECT_NE(flags(down) & sample_subsurface, 0);
    EXPECT_FLOAT_EQ(down.at("weight.x"), 1.0f);
    const Numbers below =
        run(*kernels_->subsurface, {{"wo.z", 1.0f}, {"of_lobe", down.at("lobe")}});
    EXPECT_NEAR(below.at("absorption.x") + below.at("scattering.x"), u < 0.25f ? 1.0f : 0.25f,
                1e-5f);
  }
}

// Under a coat, and beside diffuse: what enters is the share of the lobe, and the rest of f stays.
TEST_F(Subsurface, SharesTheLightWithOtherLobes) {
  const std::string nodes = flesh("flesh", "1, 1, 1", "0.8, 0.8, 0.8") + R"(
    <oren_nayar_diffuse_bsdf name="paint" type="BSDF">
      <input name="color" type="color3" value="0.8, 0.8, 0.8"/></oren_nayar_diffuse_bsdf>
    <mix name="base" type="BSDF"><input name="fg" type="BSDF" nodename="flesh"/>
      <input name="bg" type="BSDF" nodename="paint"/>
      <input name="mix" type="float" value="0.5"/></mix>
    <dielectric_bsdf name="coat" type="BSDF"><input name="scatter_mode" type="string" value="R"/>
      </dielectric_bsdf>
    <layer name="b" type="BSDF"><input name="top" type="BSDF" nodename="coat"/>
      <input name="base" type="BSDF" nodename="base"/></layer>)";
  compile(nodes);
  // Mean of the weights over the number that chooses the lobe: light that enters, unweakened.
  double enters = 0;
  const int n = 2000;
  for (int i = 0; i < n; ++i) {
    const Numbers s = sample((static_cast<float>(i) + 0.5f) / n);
    if ((flags(s) & sample_subsurface) != 0) enters += static_cast<double>(s.at("weight.x")) / n;
  }
  // A dielectric of 1.5 reflects 4 % here.
  EXPECT_NEAR(enters, 0.5 * 0.96, 5e-3);
  const float with_walk = at_point(*kernels_->evaluate, {{"wi.x", 0.6f}, {"wi.z", 0.8f}}).at("f.x");
  options_.kernels.entries = entry_usual;
  kernels_ = material(nodes);
  ASSERT_NE(kernels_, nullptr);
  const float without = at_point(*kernels_->evaluate, {{"wi.x", 0.6f}, {"wi.z", 0.8f}}).at("f.x");
  // What is missing is Lambert of half of the light that gets through the coat.
  EXPECT_NEAR(without - with_walk, 0.5 * 0.96 * 0.8 * 0.8 / 3.14159265, 1e-3);
  EXPECT_FALSE(kernels_->subsurface);
  EXPECT_TRUE(says_radius());
}

TEST_F(Subsurface, EnginesAgreeToTheBit) {
  const std::string nodes = flesh("b", "1, 0.5, 0.25");
  options_.compile.accuracy = Accuracy::standard;
  std::vector<Numbers> results;
  for (const Backend backend : {Backend::interpreter, Backend::jit}) {
    options_.compile.backend = backend;
    compile(nodes);
    for (const float u : {0.0f, 0.3f, 0.9999f}) results.push_back(sample(u));
    results.push_back(run(*kernels_->subsurface, {{"wo.x", 0.6f}, {"wo.z", -0.8f}}));
  }
  for (std::size_t i = 0; i < results.size() / 2; ++i) {
    EXPECT_EQ(results[i], results[i + results.size() / 2]) << i;
  }
}

TEST_F(Subsurface, IsNotThereWhereLightStays) {
  compile(flesh("b", "0, 0, 0"));
  EXPECT_FALSE(kernels_->subsurface);
  EXPECT_EQ(flags(sample(0.5f)), sample_valid);
  EXPECT_FALSE(says_radius());
  compile(R"(<oren_nayar_diffuse_bsdf name="b" type="BSDF"/>)");
  EXPECT_FALSE(kernels_->subsurface);
}

}  // namespace
}  // namespace nacre
