// RixBxdf's transport trait: radiance on paths from the eye, importance on paths from lights. "This
// allows bxdf plugins to be compatible with ... bidirectional path tracing, photon mapping, vertex
// connection merging". Against Veach 1997, "Robust Monte Carlo Methods for Light Transport
// Simulation", 5.2 and 5.3, and Walter et al. 2007, "Microfacet Models for Refraction".
#include "tests/jit/api/rix_bxdf.h"

namespace nacre {
namespace {

constexpr float index = 1.5f;

class RixBxdfTransport : public RixBxdfPage {
 protected:
  static Shader carrying(const std::string& nodes, const std::string& inputs = "") {
    CompileOptions options;
    options.transport = true;
    return compile(surface_of(nodes, inputs), options);
  }
  static std::string glass(const std::string& alpha, const std::string& mode = "T") {
    return lobe("dielectric_bsdf", given("scatter_mode", "string", mode) + facets(alpha) +
                                       given("ior", "float", "1.5"));
  }
  /// f.x along one pair of directions.
  static float f(const Shader& shader, int transport, Direction wo, Direction wi,
                 const Columns& more = {}) {
    Columns in = directions({wo}, {wi});
    in.insert(more.begin(), more.end());
    in["transport"] = {bits(transport)};
    return ask(shader, NACRE_EVALUATE, in).at("f.x")[0];
  }
};

/// wo bent at the flat surface by that index beyond over before.
Direction bent(Direction wo, float eta) {
  const float z2 = 1 - (1 - wo.z * wo.z) / (eta * eta);
  return {-wo.x / eta, -wo.y / eta, std::copysign(std::sqrt(z2), -wo.z)};
}

// Walter et al., eq. 21, times |cos wi|: it is for radiance, light comes along wi.
double walter(Direction wo, Direction wi, double eta_o, double eta_i, double alpha) {
  const double hx = -(eta_i * wi.x + eta_o * wo.x), hy = -(eta_i * wi.y + eta_o * wo.y),
               hz = -(eta_i * wi.z + eta_o * wo.z);
  const double length = std::copysign(std::sqrt(hx * hx + hy * hy + hz * hz), hz);
  const double mx = hx / length, my = hy / length, mz = hz / length;
  const double om = wo.x * mx + wo.y * my + wo.z * mz, im = wi.x * mx + wi.y * my + wi.z * mz;
  const double a2 = alpha * alpha;
  const double t = mz * mz * (a2 - 1) + 1;
  const double d = a2 / (std::numbers::pi * t * t);
  const auto lambda = [&](double z) { return (std::sqrt(1 + a2 * (1 - z * z) / (z * z)) - 1) / 2; };
  const double g = 1 / (1 + lambda(wo.z) + lambda(wi.z));
  const double sum = eta_i * im + eta_o * om;
  return std::abs(im * om / double{wo.z}) * eta_o * eta_o * g * d / (sum * sum);
}

// Without a Fresnel factor: the lobe T leaves that to the layer above.
TEST_F(RixBxdfTransport, RadianceIsRefractedAsWalterSays) {
  const Shader shader = carrying(glass("0.1"));
  for (const double degrees : {5.0, 25.0, 45.0}) {
    for (const bool enters : {true, false}) {
      if (!enters && degrees > 10) continue;  // Some facets reflect all.
      const Direction wo = direction(enters ? degrees : 180 - degrees);
      Direction wi = bent(wo, enters ? index : 1 / index);
      // A little beside the middle of the lobe.
      wi.x += 0.02f;
      wi.z = std::copysign(std::sqrt(1 - wi.x * wi.x - wi.y * wi.y), wi.z);
      const double expected = walter(wo, wi, enters ? 1 : index, enters ? index : 1, 0.1);
      const double found = f(shader, NACRE_RADIANCE, wo, wi);
      // Ours is scaled for what facets lose to several scatterings.
      EXPECT_NEAR(found, expected, 0.02 * expected) << degrees << enters;
    }
  }
}

// Veach, 5.2: f / eta_o^2 is what has no direction. What comes back is not touched.
TEST_F(RixBxdfTransport, RadianceAndImportanceDifferByTheSquaredIndex) {
  const Shader shader = carrying(glass("0.3", "RT"));
  CompileOptions plain;
  const Shader neither = compile(surface_of(glass("0.3", "RT")), plain);
  std::size_t passed = 0, reflected = 0;
  for (const double degrees : {20.0, 130.0}) {
    const Direction wo = direction(degrees);
    const float ratio = wo.z > 0 ? 1 / (index * index) : index * index;
    for (const Direction& wi : sphere(40)) {
      const float importance = f(shader, NACRE_IMPORTANCE, wo, wi);
      const float radiance = f(shader, NACRE_RADIANCE, wo, wi);
      const bool passes = wi.z * wo.z < 0;
      ASSERT_NEAR(radiance, importance * (passes ? ratio : 1), 2e-6f * radiance);
      ASSERT_EQ(importance, ask(neither, NACRE_EVALUATE, directions({wo}, {wi})).at("f.x")[0]);
      (passes ? passed : reflected) += radiance > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(passed, 10u);
  EXPECT_GT(reflected, 5u);
}

// The adjoint: f of importance from a to b is f of radiance from b to a. By the projected angles of
// the surface itself (Veach, 5.3.2), so with a shading normal that leans as well.
TEST_F(RixBxdfTransport, ImportanceIsTheAdjointOfRadiance) {
  const auto check = [](const Shader& shader, Direction a, Direction b, const Columns& more,
                        float tolerance) {
    const float importance = f(shader, NACRE_IMPORTANCE, a, b, more) / std::abs(b.z);
    const float radiance = f(shader, NACRE_RADIANCE, b, a, more) / std::abs(a.z);
    EXPECT_GT(radiance, 0.0f);
    EXPECT_NEAR(importance, radiance, tolerance * radiance);
  };
  const Columns leaning{{"N.x", {0.6f}}, {"N.y", {0.0f}}, {"N.z", {0.8f}}};
  const Direction a = direction(50, 20), b = direction(10, 120);
  const Shader paper =
      carrying(lobe("oren_nayar_diffuse_bsdf", given("roughness", "float", "0.5")));
  check(paper, a, b, {}, 1e-5f);
  check(paper, a, b, leaning, 1e-5f);
  check(paper, b, a, leaning, 1e-5f);
  check(carrying(lobe("translucent_bsdf")), a, direction(170, 120), leaning, 1e-5f);
  const Shader rough = carrying(glass("0.1"));
  for (const double degrees : {5.0, 20.0}) {
    const Direction above = direction(degrees);
    check(rough, above, bent(above, index), {}, 0.02f);
    check(rough, bent(above, index), above, {}, 0.02f);
  }
}

// Veach, eq. 5.19: the factor itself; of radiance there is none.
TEST_F(RixBxdfTransport, ImportanceIsCorrectedForShadingNormals) {
  const Shader paper = carrying(lobe("oren_nayar_diffuse_bsdf"));
  const Columns leaning{{"N.x", {0.6f}}, {"N.y", {0.0f}}, {"N.z", {0.8f}}};
  const Direction wo = direction(40, 0), wi = direction(30, 90);
  const float by_normal = 0.6f * wo.x + 0.8f * wo.z, to_normal = 0.6f * wi.x + 0.8f * wi.z;
  const float expected = by_normal * wi.z / (wo.z * to_normal);
  const float radiance = f(paper, NACRE_RADIANCE, wo, wi, leaning);
  EXPECT_NEAR(radiance, 0.18f * to_normal / pi, 1e-7f);
  EXPECT_NEAR(f(paper, NACRE_IMPORTANCE, wo, wi, leaning), radiance * expected, 1e-6f);
  // Where it would have no bound it has one: nothing that is not finite.
  for (const Direction& grazing : {direction(90), direction(89.9999), direction(53.13, 180)}) {
    EXPECT_TRUE(std::isfinite(f(paper, NACRE_IMPORTANCE, grazing, wi, leaning)));
    EXPECT_TRUE(std::isfinite(f(paper, NACRE_IMPORTANCE, wo, grazing, leaning)));
  }
}

// Smooth glass, into it and out again; a thin wall bends nothing.
TEST_F(RixBxdfTransport, SamplesCarryTheSame) {
  const auto weight = [](const Shader& shader, int transport, float side) {
    const Columns in{{"wo.z", {side}}, {"transport", {bits(transport)}}};
    return ask(shader, NACRE_SAMPLE, in).at("weight.x")[0];
  };
  const Shader smooth = carrying(glass("0"));
  EXPECT_FLOAT_EQ(weight(smooth, NACRE_IMPORTANCE, 1), 1.0f);
  EXPECT_FLOAT_EQ(weight(smooth, NACRE_RADIANCE, 1), 1 / (index * index));
  EXPECT_FLOAT_EQ(weight(smooth, NACRE_RADIANCE, -1), index * index);
  const Shader thin = carrying(glass("0"), given("thin_walled", "boolean", "true"));
  EXPECT_FLOAT_EQ(weight(thin, NACRE_RADIANCE, 1), 1.0f);
  // And rough: weight pdf = f.
  const Shader rough = carrying(glass("0.3", "RT"));
  for (const int transport : {NACRE_RADIANCE, NACRE_IMPORTANCE}) {
    Columns in = random(direction(30), 200);
    in["transport"] = {bits(transport)};
    const Columns sample = ask(rough, NACRE_SAMPLE, in, 200);
    put(in, "wi", sampled(sample));
    const Columns value = ask(rough, NACRE_EVALUATE, in, 200);
    for (std::size_t i = 0; i < 200; ++i) {
      if (!is_valid(sample, i)) continue;
      const float found = sample.at("weight.x")[i] * sample.at("pdf")[i];
      ASSERT_NEAR(found, value.at("f.x")[i], 2e-4f * found) << i;
    }
  }
}

// Points of one batch may carry either; who does not ask reads no such channel.
TEST_F(RixBxdfTransport, ComesWithEachPoint) {
  const Shader shader = carrying(glass("0"));
  const Columns in{{"transport", {bits(NACRE_RADIANCE), bits(NACRE_IMPORTANCE)}}};
  const Columns sample = ask(shader, NACRE_SAMPLE, in, 2);
  EXPECT_FLOAT_EQ(sample.at("weight.x")[1], index * index * sample.at("weight.x")[0]);
  const Shader plain = compile(surface_of(glass("0")));
  for (const Channel& input : plain.inputs(NACRE_SAMPLE)) EXPECT_NE(input.name, "transport");
}

}  // namespace
}  // namespace nacre
