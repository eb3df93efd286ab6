// Facets whose roughnesses are parameters of a call.
#include "tests/jit/api/rix_bxdf.h"

namespace nacre {
namespace {

class LiveRoughness : public RixBxdfPage {};

// Equal ones know no tangent, though it is the model's arithmetic that makes two of one: `fast`
// computes each in an order of its own, and took them for unequal, at three times the cost.
TEST_F(LiveRoughness, EqualOnesDoNotTurnWithTheTangent) {
  const std::string document = R"(<materialx version="1.39">
    <standard_surface name="S" type="surfaceshader"/><surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>)";
  for (const int accuracy : {NACRE_PRECISE, NACRE_STANDARD, NACRE_FAST}) {
    CompileOptions options;
    options.live = {"*"};
    options.accuracy = accuracy;
    const Shader shader = compile(document, options, NACRE_JIT);
    for (const float roughness : {0.13f, 0.2f, 0.37f, 0.5f, 0.71f}) {
      Instance instance(shader);
      instance.set("S/specular_roughness", roughness);
      Columns in = random(direction(40, 10), 300);
      std::vector<Columns> turned;
      for (const double phi : {0.0, 35.0}) {
        put(in, "T", {direction(90, phi)});
        turned.push_back(ask(shader, NACRE_SAMPLE, in, 300, 0, 0, &instance));
      }
      for (const char* channel : {"wi.x", "wi.y", "wi.z", "pdf", "weight.x"}) {
        EXPECT_EQ(turned[0].at(channel), turned[1].at(channel)) << accuracy << ' ' << roughness;
      }
    }
  }
}

// An index of 1 is no interface, whatever its film may become: facets at the margin of a narrow
// roughness, where a cosine is 0, were taken to reflect all light.
TEST_F(LiveRoughness, NarrowFacetsOfNoInterfaceAreDark) {
  const std::string document =
      surface_of(lobe("dielectric_bsdf",
                      given("ior", "float", "1") + given("roughness", "vector2", "0.7, 0.0075")));
  CompileOptions options;
  options.live = {"*"};
  const Shader shader = compile(document, options, NACRE_JIT);
  for (const double angle : {60.0, 75.0, 85.0}) {
    const Columns in = random(direction(angle, 90), 1);
    EXPECT_EQ(ask(shader, NACRE_ALBEDO, in, 1).at("albedo.x")[0], 0.0f) << angle;
  }
}

}  // namespace
}  // namespace nacre
