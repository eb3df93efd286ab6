// The index of refraction around a surface, as a channel that a host asks for.
#include "tests/jit/api/rix_bxdf.h"

namespace nacre {
namespace {

class Exterior : public RixBxdfPage {
 protected:
  static std::string glass() {
    return surface_of(lobe("dielectric_bsdf", given("scatter_mode", "string", "RT") + facets("0") +
                                                  given("ior", "float", "1.5")));
  }
};

// Snell's law, for points of one batch that lie in different media.
TEST_F(Exterior, ComesWithEachPoint) {
  CompileOptions options;
  options.varying = {"exterior_index"};
  const Shader shader = compile(glass(), options);
  Columns in;
  put(in, "wo", {direction(30, 0)});
  in["u.z"] = {0.99f};
  in["exterior_index"] = {1.0f, 1.333f, 1.5f};
  const Columns sample = ask(shader, NACRE_SAMPLE, in, 3);
  EXPECT_NEAR(sample.at("wi.x")[0], -0.5 / 1.5, 1e-6);
  EXPECT_NEAR(sample.at("wi.x")[1], -0.5 * 1.333 / 1.5, 1e-6);
  EXPECT_NEAR(sample.at("wi.x")[2], -0.5, 1e-6);
}

TEST_F(Exterior, SaysWhatItIs) {
  CompileOptions options;
  options.varying = {"exterior_index"};
  std::size_t found = 0;
  for (const Channel& input : compile(glass(), options).inputs(NACRE_BEGIN)) {
    if (input.name != "exterior_index") continue;
    ++found;
    EXPECT_EQ(input.role, NACRE_POINT);
    EXPECT_EQ(input.type, NACRE_FLOAT);
    EXPECT_EQ(input.component, -1);
    EXPECT_FALSE(input.meaning.empty());
  }
  EXPECT_EQ(found, 1u);
  for (const Channel& input : compile(glass()).inputs(NACRE_BEGIN)) {
    EXPECT_NE(input.name, "exterior_index");
  }
}

}  // namespace
}  // namespace nacre
