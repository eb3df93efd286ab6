#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/closure.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

/// The kernels of one BSDF, by the reference engine.
class Scattering {
 public:
  template <class F>
  explicit Scattering(F&& make, Bool thin_walled = false) {
    Surface surface;
    surface.bsdf = make(recorder_);
    surface.thin_walled = thin_walled;
    KernelRequest request;
    request.reverse_pdf = true;
    kernels_ = record_kernels(recorder_, surface, Accuracy::standard, request);
  }
  DoubleColumns evaluate(const Columns& in) const { return run(kernels_.evaluate, in); }
  DoubleColumns sample(const Columns& in) const { return run(kernels_.sample, in); }
  DoubleColumns albedo(const Columns& in) const { return run(kernels_.albedo, in); }
  std::size_t instructions() const {
    return slice(recorder_.program(), "sample", kernels_.sample).entry().code.size();
  }

 private:
  DoubleColumns run(const std::vector<SliceOutput>& outputs, const Columns& in) const {
    return run_double(*make_reference(slice(recorder_.program(), "test", outputs)), in);
  }
  Recorder recorder_;
  SurfaceKernels kernels_;
};

void put(Columns& columns, const std::string& name, double degrees, double azimuth) {
  const double theta = degrees * std::numbers::pi / 180.0;
  const double phi = azimuth * std::numbers::pi / 180.0;
  columns[name + ".x"].push_back(static_cast<float>(std::sin(theta) * std::cos(phi)));
  columns[name + ".y"].push_back(static_cast<float>(std::sin(theta) * std::sin(phi)));
  columns[name + ".z"].push_back(static_cast<float>(std::cos(theta)));
}

Columns upright() { return {{"N.z", {1.0f}}, {"Ng.z", {1.0f}}, {"T.x", {1.0f}}}; }

Columns seen_from(double degrees, float u = 0.3f, float v = 0.6f, float w = 0.5f) {
  Columns in = upright();
  put(in, "wo", degrees, 20.0);
  in["u.x"] = {u}, in["u.y"] = {v}, in["u.z"] = {w};
  return in;
}

Ports ports(const char* mode, Float index, Float alpha) {
  return {
      {"ior", number(index)}, {"roughness", roughness(alpha, alpha)}, {"scatter_mode", text(mode)}};
}

// Smooth glass, shaded by a normal that leans away from the viewer: the mirrored ray is
// above that normal's plane, and below the surface.
TEST(MicrofacetLobe, TheGeometricNormalSaysWhatIsPassed) {
  const Scattering glass(
      [](Recorder& r) { return microfacet_bsdf(r, "dielectric_bsdf", ports("RT", 1.5f, 0.0f)); });
  const double degree = std::numbers::pi / 180.0;
  for (const auto& [lean, crosses] : {std::pair{0.0, false}, std::pair{15.0, true}}) {
    Columns in{{"Ng.z", {1.0f}}, {"T.x", {1.0f}}};
    put(in, "N", lean, 0.0);
    put(in, "wo", 70.0, 180.0);
    in["u.x"] = {0.3f}, in["u.y"] = {0.6f}, in["u.z"] = {0.0f};
    const auto out = glass.sample(in);
    const int flags = static_cast<int>(out.at("flags")[0]);
    ASSERT_NE(flags & sample_valid, 0);
    // Mirrored about the normal: 70 degrees on the other side, and twice the lean.
    EXPECT_NEAR(out.at("wi.z")[0], std::cos((70.0 + 2.0 * lean) * degree), 1e-5);
    EXPECT_EQ((flags & sample_transmission) != 0, crosses) << lean;
  }
  // And what passes with a normal so bent that the ray stays on its side does not cross.
  const Columns passed = [&] {
    Columns in{{"Ng.z", {1.0f}}, {"T.x", {1.0f}}};
    put(in, "N", 80.0, 0.0);
    put(in, "wo", 75.0, 80.0);
    in["u.x"] = {0.3f}, in["u.y"] = {0.6f}, in["u.z"] = {0.999f};
    return in;
  }();
  const auto out = glass.sample(passed);
  const bool below = out.at("wi.z")[0] < 0.0;
  EXPECT_EQ((static_cast<int>(out.at("flags")[0]) & sample_transmission) != 0, below);
}

TEST(MicrofacetLobe, SmoothGlassIsAMirrorAndALens) {
  const Scattering glass(
      [](Recorder& r) { return microfacet_bsdf(r, "dielectric_bsdf", ports("RT", 1.5f, 0.0f)); });
  const double sine = std::sin(40.0 * std::numbers::pi / 180.0);
  const auto reflected = glass.sample(seen_from(40.0, 0.3f, 0.6f, 0.0f));
  const auto passed = glass.sample(seen_from(40.0, 0.3f, 0.6f, 0.9f));
  EXPECT_EQ(reflected.at("flags")[0], sample_valid | sample_delta);
  EXPECT_EQ(passed.at("flags")[0], sample_valid | sample_delta | sample_transmission);
  EXPECT_NEAR(reflected.at("wi.z")[0], std::cos(40.0 * std::numbers::pi / 180.0), 1e-6);
  EXPECT_NEAR(std::hypot(passed.at("wi.x")[0], passed.at("wi.y")[0]), sine / 1.5, 1e-6);
  // Fresnel: 0.0456 at 40 degrees; each with its probability, of weight 1.
  EXPECT_NEAR(reflected.at("pdf")[0] + passed.at("pdf")[0], 1.0, 1e-6);
  EXPECT_NEAR(reflected.at("pdf")[0], 0.04565, 1e-4);
  EXPECT_NEAR(reflected.at("weight.x")[0], 1.0, 1e-5);
  EXPECT_NEAR(passed.at("weight.x")[0], 1.0, 1e-5);
  Columns at = seen_from(40.0);
  put(at, "wi", 40.0, 200.0);
  EXPECT_EQ(glass.evaluate(at).at("f.x")[0], 0.0);
  EXPECT_EQ(glass.evaluate(at).at("pdf")[0], 0.0);
}

TEST(MicrofacetLobe, SmoothGlassReflectsTotallyFromInside) {
  const Scattering glass(
      [](Recorder& r) { return microfacet_bsdf(r, "dielectric_bsdf", ports("RT", 1.5f, 0.0f)); });
  const auto out = glass.sample(seen_from(130.0, 0.3f, 0.6f, 0.999f));
  EXPECT_EQ(out.at("flags")[0], sample_valid | sample_delta);
  EXPECT_NEAR(out.at("weight.x")[0], 1.0, 1e-6);
  EXPECT_LT(out.at("wi.z")[0], 0.0);
}

TEST(MicrofacetLobe, LiteralRoughnessRecordsNoMirror) {
  const auto count = [](Float alpha) {
    return Scattering([&](Recorder& r) {
             const Float x = alpha.is_constant() ? alpha : input(r, "alpha");
             return microfacet_bsdf(r, "conductor_bsdf", {{"roughness", roughness(x, x)}});
           })
        .instructions();
  };
  Recorder other;
  EXPECT_LT(count(0.3f), count(input(other, "alpha")));
}

TEST(MicrofacetLobe, OneSmoothAxisIsNotAMirror) {
  const Scattering brushed([](Recorder& r) {
    return microfacet_bsdf(r, "conductor_bsdf",
                           {{"roughness", roughness(0.3f, 0.0f)}, {"ior", colour(1.0f)}});
  });
  const auto out = brushed.sample(seen_from(30.0));
  EXPECT_EQ(out.at("flags")[0], sample_valid);
  EXPECT_TRUE(std::isfinite(out.at("weight.x")[0]));
}

/// Albedo as roughness grows past the threshold, from the mirror's.
TEST(MicrofacetLobe, AlbedoIsContinuousInRoughness) {
  for (const char* mode : {"R", "T", "RT"}) {
    const Scattering glass([&](Recorder& r) {
      return microfacet_bsdf(r, "dielectric_bsdf", ports(mode, 1.5f, input(r, "alpha")));
    });
    for (const double angle : {0.0, 45.0, 80.0, 150.0, 170.0}) {
      Columns in = seen_from(angle);
      in["alpha"] = {0.0f, 1.001e-4f, 1e-3f};
      const auto albedo = glass.albedo(in).at("albedo.x");
      EXPECT_NEAR(albedo[1], albedo[0], 1e-3) << mode << " " << angle;
      EXPECT_NEAR(albedo[2], albedo[0], 5e-3) << mode << " " << angle;
    }
  }
}

TEST(MicrofacetLobe, IndexOfOneLetsEverythingPassStraight) {
  for (const float index : {0.9995f, 1.0f, 1.0005f}) {
    const Scattering glass([&](Recorder& r) {
      return microfacet_bsdf(r, "dielectric_bsdf", ports("RT", index, 0.4f));
    });
    const Columns in = seen_from(50.0);
    const auto out = glass.sample(in);
    EXPECT_EQ(out.at("flags")[0], sample_valid | sample_delta | sample_transmission);
    EXPECT_NEAR(out.at("wi.x")[0], -in.at("wo.x")[0], 1e-7);
    EXPECT_NEAR(out.at("weight.x")[0], 1.0, 2e-3);
  }
}

TEST(MicrofacetLobe, AlbedoIsContinuousWhereTheIndexPassesOne) {
  const Scattering glass([&](Recorder& r) {
    return microfacet_bsdf(r, "dielectric_bsdf", ports("R", input(r, "index"), 0.2f));
  });
  Columns in = seen_from(60.0);
  in["index"] = {0.99f, 0.9985f, 0.9995f, 1.0f, 1.0005f, 1.0015f, 1.01f};
  const auto albedo = glass.albedo(in).at("albedo.x");
  for (const double x : albedo) EXPECT_NEAR(x, 0.0, 3e-3);
}

/// Weight times pdf is what evaluate says at the sampled direction.
TEST(MicrofacetLobe, SamplesAgreeWithEvaluation) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  for (const char* mode : {"R", "T", "RT"}) {
    for (const bool thin : {false, true}) {
      const Scattering glass(
          [&](Recorder& r) {
            Ports in = ports(mode, 1.5f, 0.3f);
            in["roughness"] = roughness(0.3f, 0.1f);
            return microfacet_bsdf(r, "dielectric_bsdf", in);
          },
          thin);
      Columns in = upright();
      for (int i = 0; i < 500; ++i) {
        put(in, "wo", 180.0 * uniform(random), 360.0 * uniform(random));
        for (const char* name : {"u.x", "u.y", "u.z"}) in[name].push_back(uniform(random));
      }
      const auto samples = glass.sample(in);
      for (const char* name : {"wi.x", "wi.y", "wi.z"}) {
        const auto& column = samples.at(name);
        in[name].assign(column.begin(), column.end());
      }
      const auto values = glass.evaluate(in);
      int valid = 0;
      for (std::size_t i = 0; i < samples.at("pdf").size(); ++i) {
        if (samples.at("flags")[i] == 0.0) continue;
        ++valid;
        const double pdf = samples.at("pdf")[i];
        EXPECT_NEAR(values.at("pdf")[i] / pdf, 1.0, 1e-3) << mode << thin << i;
        // 0 is possible: the other way, what is totally reflected may not be sampled.
        const double reverse = samples.at("pdf_reverse")[i];
        EXPECT_NEAR(values.at("pdf_reverse")[i], reverse, 1e-3 * reverse);
        EXPECT_NEAR(values.at("f.x")[i] / (pdf * samples.at("weight.x")[i]), 1.0, 1e-3);
      }
      EXPECT_GT(valid, 350) << mode << thin;
    }
  }
}

TEST(MicrofacetLobe, ReverseDensityIsThatOfTheOtherWay) {
  const Scattering glass(
      [](Recorder& r) { return microfacet_bsdf(r, "dielectric_bsdf", ports("RT", 1.5f, 0.4f)); });
  Columns there = upright();
  Columns back = upright();
  for (const auto& [o, i] : {std::pair{30.0, 50.0}, {30.0, 160.0}, {120.0, 60.0}, {140.0, 110.0}}) {
    put(there, "wo", o, 10.0), put(there, "wi", i, 185.0);
    put(back, "wi", o, 10.0), put(back, "wo", i, 185.0);
  }
  const auto a = glass.evaluate(there);
  const auto b = glass.evaluate(back);
  for (std::size_t i = 0; i < a.at("pdf").size(); ++i) {
    EXPECT_NEAR(a.at("pdf_reverse")[i], b.at("pdf")[i], 1e-9 + 1e-6 * b.at("pdf")[i]) << i;
  }
}

TEST(MicrofacetLobe, RetroreflectionComesBack) {
  const Scattering metal([](Recorder& r) {
    return microfacet_bsdf(
        r, "conductor_bsdf",
        {{"roughness", roughness(0.0f, 0.0f)}, {"retroreflective", {Type::boolean, Bool(true)}}});
  });
  const Columns in = seen_from(60.0);
  const auto out = metal.sample(in);
  EXPECT_NEAR(out.at("wi.x")[0], in.at("wo.x")[0], 1e-6);
  EXPECT_NEAR(out.at("wi.z")[0], in.at("wo.z")[0], 1e-6);
}

/// The radiance from one side to the other and back, for the light bent into the
/// denser medium: f_s(i, o) / eta_o^2 = f_s(o, i) / eta_i^2 (Walter et al. 2007, 3),
/// here without the squares; but for the compensation of each view.
TEST(MicrofacetLobe, RefractionIsReciprocalBeforeCompensation) {
  const Scattering glass(
      [](Recorder& r) { return microfacet_bsdf(r, "dielectric_bsdf", ports("RT", 1.5f, 0.05f)); });
  Columns there = upright();
  Columns back = upright();
  put(there, "wo", 20.0, 10.0), put(there, "wi", 167.0, 190.0);
  put(back, "wi", 20.0, 10.0), put(back, "wo", 167.0, 190.0);
  const double forth = glass.evaluate(there).at("f.x")[0] / -std::cos(2.9147);
  const double other = glass.evaluate(back).at("f.x")[0] / std::cos(0.34907);
  EXPECT_NEAR(forth / other / (1.5 * 1.5), 1.0, 1e-2);
}

TEST(MicrofacetLobe, AnyBitsGiveFiniteResults) {
  std::mt19937 random(11);
  const auto bits = [&] {
    const std::uint32_t edge[] = {0u,          0x80000000u, 0x3f800000u, 0x7f800000u, 0x7fc00000u,
                                  0x00000001u, 0x7f7fffffu, 0xbf800000u, 0x38d1b717u};
    const std::uint32_t any = static_cast<std::uint32_t>(random());
    return std::bit_cast<float>(any % 2 == 0 ? edge[random() % std::size(edge)] : any);
  };
  const std::pair<const char*, const char*> nodes[] = {
      {"dielectric_bsdf", "R"},          {"dielectric_bsdf", "T"},
      {"dielectric_bsdf", "RT"},         {"conductor_bsdf", "R"},
      {"generalized_schlick_bsdf", "R"}, {"generalized_schlick_bsdf", "RT"}};
  const char* names[] = {"ax",   "ay",     "index", "n",   "k",   "c0",  "c82", "c90", "e",
                         "film", "film_n", "N.x",   "N.y", "N.z", "T.x", "T.y", "T.z", "tint"};
  for (const auto& [node, mode] : nodes) {
    const Scattering lobe([&](Recorder& r) {
      Ports in{{"roughness", roughness(input(r, "ax"), input(r, "ay"))},
               {"color0", colour(input(r, "c0"))},
               {"color82", colour(input(r, "c82"))},
               {"color90", colour(input(r, "c90"))},
               {"exponent", number(input(r, "e"))},
               {"extinction", colour(input(r, "k"))},
               {"tint", colour(input(r, "tint"))},
               {"thinfilm_thickness", number(input(r, "film"))},
               {"thinfilm_ior", number(input(r, "film_n"))},
               {"scatter_mode", text(mode)}};
      const bool metal = std::string(node) == "conductor_bsdf";
      in["ior"] = metal ? colour(input(r, "n")) : number(input(r, "index"));
      return microfacet_bsdf(r, node, in);
    });
    Columns in;
    for (int i = 0; i < 3000; ++i) {
      for (const char* name : names) in[name].push_back(bits());
      if (i % 2 == 0) in["N.x"][i] = 0.0f, in["N.y"][i] = 0.0f, in["N.z"][i] = 1.0f;
      put(in, "wo", static_cast<double>(random() % 181), static_cast<double>(random() % 360));
      put(in, "wi", static_cast<double>(random() % 181), static_cast<double>(random() % 360));
      for (const char* name : {"u.x", "u.y", "u.z"}) {
        in[name].push_back(static_cast<float>(random() % 1000) / 1000.0f);
      }
    }
    const auto values = lobe.evaluate(in);
    const auto samples = lobe.sample(in);
    for (std::size_t i = 0; i < 3000; ++i) {
      for (const char* name : {"f.x", "f.z", "pdf", "pdf_reverse"}) {
        const double x = values.at(name)[i];
        ASSERT_TRUE(x >= 0.0 && std::isfinite(x)) << node << mode << " " << name << i << " " << x;
      }
      for (const char* name : {"weight.x", "weight.z", "pdf", "pdf_reverse"}) {
        const double x = samples.at(name)[i];
        ASSERT_TRUE(x >= 0.0 && std::isfinite(x)) << node << mode << " " << name << i << " " << x;
      }
      if (samples.at("flags")[i] == 0.0) continue;
      const double length =
          std::hypot(samples.at("wi.x")[i], samples.at("wi.y")[i], samples.at("wi.z")[i]);
      ASSERT_NEAR(length, 1.0, 1e-3) << node << mode << i;
    }
  }
}

}  // namespace
}  // namespace nacre
