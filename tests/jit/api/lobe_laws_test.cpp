// <nacre/lobe_test.hpp>: finds each fault that a host's lobe may have, and none where there is
// none.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nacre/lobe_test.hpp>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

constexpr const char* pack = R"(<materialx version="1.39">
  <nodedef name="ND_planted" node="planted"><input name="weight" type="float" value="1"/>
    <output name="out" type="BSDF"/></nodedef>
</materialx>)";

std::string material(const std::string& bsdf) {
  return "<materialx version=\"1.39\">" + bsdf +
         R"(<surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/>
    </surface><surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)";
}

std::string laws(const LobeReport& report) {
  std::string all;
  for (const LobeFault& fault : report.faults) {
    if (all.find(fault.law) == std::string::npos) all += (all.empty() ? "" : " ") + fault.law;
  }
  return all;
}

std::string texts(const LobeReport& report) {
  std::string all;
  for (const LobeFault& fault : report.faults) all += fault.text + '\n';
  return all;
}

LobeReport report_of(const std::string& bsdf, const LobeTestOptions& options = {},
                     const CompileOptions& compiled = {}) {
  System system;
  const Shader shader =
      system.compile_material(Document::parse(material(bsdf).c_str()), "M", compiled);
  return test_lobes(shader, options);
}

/// A white diffuse reflector, about z, with one thing wrong.
struct Planted final : Lobe {
  int kind = NACRE_DIFFUSE_REFLECTION;
  float reflectance = 1;
  float claimed_albedo = 1;
  std::function<LobeValue(Float3 wi, LobeValue right)> evaluated;
  std::function<Float3(Float3 wi)> sampled;

  const char* name() const override { return "planted"; }
  int kinds() const override { return kind; }
  LobeValue evaluate(const View&, Float3 wi) const override {
    const Float pdf = max(wi.z, 0.0f) * 0.318309886f;
    const LobeValue right{Float3(reflectance * pdf), pdf};
    return evaluated ? evaluated(wi, right) : right;
  }
  LobeSample sample(const View&, Float3 u) const override {
    // Malley's method.
    const Float r = sqrt(u.x);
    const Float angle = 6.283185307f * u.y;
    const Float3 wi{r * cos(angle), r * sin(angle), sqrt(max(1.0f - u.x, 0.0f))};
    return {sampled ? sampled(wi) : wi, true};
  }
  Float3 albedo(const View&) const override { return Float3(claimed_albedo); }
};

LobeReport report_of(const Planted& planted, const LobeTestOptions& options = {}) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "pack.mtlx";
  std::ofstream(file) << pack;
  SystemOptions system_options;
  system_options.libraries = {data_library(), file};
  system_options.bodies = {
      {"ND_planted", [&](Node& node) { node.set_lobe(std::make_shared<Planted>(planted)); }}};
  System system(system_options);
  const Document document = Document::parse(material(R"(<planted name="b" type="BSDF"/>)").c_str());
  return test_lobes(system.compile_material(document, "M"), options);
}

TEST(LobeLaws, HoldForARightLobe) {
  const LobeReport report = report_of(Planted());
  EXPECT_EQ(texts(report), "");
  ASSERT_EQ(report.views.size(), LobeTestOptions().wo.size());
  for (const LobeView& view : report.views) {
    EXPECT_EQ(view.valid, 1.0);
    for (const double energy : view.energy) EXPECT_NEAR(energy, 1.0, 1e-5);
    EXPECT_NEAR(view.reciprocity, 1.0, 1e-4);
    EXPECT_GT(view.chi_square, 1e-3);
  }
}

// Its kind is transmission alone, and beyond the critical angle most facets reflect.
TEST(LobeLaws, HoldWhereFacetsReflectTotally) {
  LobeTestOptions options;
  options.wo = {direction(85, 30)};
  const LobeReport report = report_of(R"(<dielectric_bsdf name="b" type="BSDF">
    <input name="ior" type="float" value="0.7"/>
    <input name="roughness" type="vector2" value="0.3, 0.3"/>
    <input name="scatter_mode" type="string" value="T"/></dielectric_bsdf>)",
                                      options);
  EXPECT_EQ(texts(report), "");
  EXPECT_NEAR(report.views.at(0).energy.at(0), 1, 1e-2);
}

TEST(LobeLaws, FindWhatIsWrong) {
  Planted gains;
  gains.reflectance = 1.02f;
  gains.claimed_albedo = 1;
  EXPECT_EQ(laws(report_of(gains)), "energy");

  Planted claims_less;
  claims_less.claimed_albedo = 0.98f;
  EXPECT_EQ(laws(report_of(claims_less)), "albedo");

  Planted normalised_wrongly;
  normalised_wrongly.evaluated = [](Float3, LobeValue right) {
    return LobeValue{right.f, right.pdf * 0.99f};
  };
  EXPECT_NE(laws(report_of(normalised_wrongly)).find("normalised"), std::string::npos);

  // Where y is large they are 5 degrees off.
  Planted leans;
  leans.sampled = [](Float3 wi) {
    const Float3 turned{0.99619f * wi.x - 0.08716f * wi.z, wi.y, 0.08716f * wi.x + 0.99619f * wi.z};
    return select(wi.y > 0.4f, turned, wi);
  };
  EXPECT_NE(laws(report_of(leans)).find("samples"), std::string::npos);

  Planted too_long;
  // Small errors the kernel makes good.
  too_long.sampled = [](Float3 wi) { return Float3(1.2f) * wi; };
  EXPECT_NE(laws(report_of(too_long)).find("unit"), std::string::npos);

  Planted infinite;
  infinite.evaluated = [](Float3 wi, LobeValue right) {
    return LobeValue{Float3(right.pdf / max(wi.z - 0.5f, 0.0f)), right.pdf};
  };
  EXPECT_NE(laws(report_of(infinite)).find("finite"), std::string::npos);

  Planted shines_below;
  shines_below.evaluated = [](Float3 wi, LobeValue right) {
    return LobeValue{select(wi.z < 0.0f, Float3(0.1f), right.f), right.pdf};
  };
  EXPECT_EQ(laws(report_of(shines_below)), "support");

  Planted on_no_side;
  on_no_side.kind = NACRE_GLOSSY_TRANSMISSION;
  EXPECT_EQ(laws(report_of(on_no_side)), "sides");
}

TEST(LobeLaws, SayWhereAndHowMuch) {
  Planted gains;
  gains.reflectance = 1.5f;
  LobeTestOptions options;
  options.wo = {direction(60, 0)};
  const LobeReport report = report_of(gains, options);
  ASSERT_FALSE(report.faults.empty());
  const LobeFault& fault = report.faults.front();
  EXPECT_EQ(fault.law, "energy");
  EXPECT_NEAR(fault.found, 1.5, 1e-4);
  EXPECT_EQ(fault.expected, 1.01);
  EXPECT_EQ(fault.text.substr(0, 41), "energy: found 1.5, expected 1.01, wo (0.8") << fault.text;
  // A model that is known to gain says by how much.
  options.most_energy = 1.5;
  EXPECT_EQ(laws(report_of(gains, options)), "");
}

TEST(LobeLaws, HoldForTheLibrarysOwn) {
  EXPECT_EQ(texts(report_of(R"(<conductor_bsdf name="b" type="BSDF">
      <input name="roughness" type="vector2" value="0.04, 0.04"/></conductor_bsdf>)")),
            "");
  EXPECT_EQ(texts(report_of(R"(<dielectric_bsdf name="b" type="BSDF">
      <input name="roughness" type="vector2" value="0.2, 0.2"/>
      <input name="scatter_mode" type="string" value="RT"/></dielectric_bsdf>)")),
            "");
  // A mirror is all delta.
  EXPECT_EQ(texts(report_of(R"(<conductor_bsdf name="b" type="BSDF">
      <input name="roughness" type="vector2" value="0, 0"/></conductor_bsdf>)")),
            "");
}

// A thin ring at the horizon, whose cells are cut by pilots: where those are of the samples that
// are counted, they are cut around what chance has put together (p was 1e-178).
TEST(LobeLaws, PilotsAreNotCounted) {
  LobeTestOptions options;
  options.wo = {direction(89.99, 30.0)};
  options.samples = 200'000;
  const LobeReport report = report_of(R"(<sheen_bsdf name="b" type="BSDF">
    <input name="mode" type="string" value="zeltner"/>
    <input name="roughness" type="float" value="0.15"/></sheen_bsdf>)",
                                      options);
  EXPECT_EQ(laws(report), "") << texts(report);
}

TEST(LobeLaws, AskForAClosure) {
  CompileOptions options;
  options.entries = 1u << NACRE_OPACITY;
  EXPECT_THROW(report_of(R"(<oren_nayar_diffuse_bsdf name="b" type="BSDF"/>)", {}, options), Error);
}

}  // namespace
}  // namespace nacre
