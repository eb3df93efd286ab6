#include "tests/pbs/battery/furnace.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

BsdfPtr white_metal(Recorder& recorder, Float ax, Float ay) {
  return microfacet_bsdf(
      recorder, "conductor_bsdf",
      {{"ior", colour(0.0f)}, {"extinction", colour(1.0f)}, {"roughness", roughness(ax, ay)}});
}

TEST(Furnace, WhiteMetalReturnsAllLight) {
  for (const float alpha : {0.05f, 0.1f, 0.2f, 0.5f, 0.8f, 1.0f}) {
    const Furnace furnace([&](Recorder& r) { return white_metal(r, alpha, alpha); });
    for (const double angle : {0.0, 30.0, 60.0, 75.0, 85.0}) {
      EXPECT_NEAR(furnace.light(angle), 1.0, 1e-2) << alpha << " " << angle;
      EXPECT_NEAR(furnace.albedo(angle), 1.0, 1e-6);
    }
  }
}

// Facets far narrower than the first that the tables are made for, as near to grazing as they are
// smooth.
TEST(Furnace, NearlySmoothWhiteMetalReturnsAllLight) {
  for (const float alpha : {2e-4f, 5e-4f, 1e-3f, 2e-3f}) {
    const Furnace furnace([&](Recorder& r) { return white_metal(r, alpha, alpha); });
    for (const double angle : {89.0, 89.8, 89.95, 89.98, 89.99}) {
      EXPECT_NEAR(furnace.light(angle), 1.0, 1e-2) << alpha << " " << angle;
    }
  }
}

TEST(Furnace, BeckmannsWhiteMetalReturnsAllLight) {
  const float pairs[][2] = {{0.05f, 0.05f}, {0.2f, 0.2f}, {0.5f, 0.5f}, {1.0f, 1.0f},
                            {0.5f, 0.1f},   {1.0f, 0.3f}, {0.1f, 1.0f}};
  for (const auto& [ax, ay] : pairs) {
    const Furnace furnace([&](Recorder& r) {
      // One value for both axes is known to be isotropic.
      const Float along = ax, across = ax == ay ? along : Float(ay);
      return microfacet_bsdf(r, "conductor_bsdf",
                             {{"ior", colour(0.0f)},
                              {"extinction", colour(1.0f)},
                              {"distribution", text("beckmann")},
                              {"roughness", roughness(along, across)}});
    });
    for (const double azimuth : {0.0, 45.0, 90.0}) {
      for (const double angle : {0.0, 45.0, 75.0, 85.0}) {
        EXPECT_NEAR(furnace.light(angle, azimuth), 1.0, ax == ay ? 1e-2 : 2e-2)
            << ax << " " << ay << " angle " << angle << " azimuth " << azimuth;
      }
      if (ax == ay) break;
    }
  }
}

TEST(Furnace, BeckmannsGlassReturnsAllLight) {
  for (const float alpha : {0.1f, 0.5f, 1.0f}) {
    for (const float index : {1.1f, 1.5f, 2.5f}) {
      const Furnace joint([&](Recorder& r) {
        return microfacet_bsdf(r, "dielectric_bsdf",
                               {{"ior", number(index)},
                                {"roughness", roughness(alpha, alpha)},
                                {"distribution", text("beckmann")},
                                {"scatter_mode", text("RT")}});
      });
      for (const double angle : {0.0, 60.0, 85.0, 180.0, 140.0, 120.0, 95.0}) {
        EXPECT_NEAR(joint.light(angle), 1.0, 2e-2)
            << alpha << " index " << index << " angle " << angle;
      }
    }
  }
}

TEST(Furnace, BeckmannsAnisotropicGlassReturnsAllLight) {
  const Furnace joint([&](Recorder& r) {
    return microfacet_bsdf(r, "dielectric_bsdf",
                           {{"ior", number(1.5f)},
                            {"roughness", roughness(0.6f, 0.1f)},
                            {"distribution", text("beckmann")},
                            {"scatter_mode", text("RT")}});
  });
  for (const double angle : {0.0, 75.0, 120.0}) {
    EXPECT_NEAR(joint.light(angle, 30.0, 1 << 14), 1.0, 2e-2) << angle;
  }
}

TEST(Furnace, AnisotropicWhiteMetalReturnsAllLight) {
  const float pairs[][2] = {{0.5f, 0.1f},  {1.0f, 0.3f}, {0.2f, 0.05f},
                            {1.0f, 0.05f}, {0.1f, 1.0f}, {1.0f, 0.5f}};
  for (const auto& [ax, ay] : pairs) {
    const Furnace furnace([&](Recorder& r) { return white_metal(r, ax, ay); });
    for (const double azimuth : {0.0, 45.0, 75.0, 90.0}) {
      for (const double angle : {0.0, 45.0, 75.0, 85.0, 89.0}) {
        EXPECT_NEAR(furnace.light(angle, azimuth, 1 << 15), 1.0, 2e-2)
            << ax << " " << ay << " angle " << angle << " azimuth " << azimuth;
      }
    }
  }
}

BsdfPtr glass(Recorder& recorder, const char* mode, Float index, float ax, float ay) {
  return microfacet_bsdf(
      recorder, "dielectric_bsdf",
      {{"ior", number(index)}, {"roughness", roughness(ax, ay)}, {"scatter_mode", text(mode)}});
}
/// One value for both axes: known to be isotropic.
BsdfPtr glass(Recorder& recorder, const char* mode, Float index, Float alpha) {
  return microfacet_bsdf(recorder, "dielectric_bsdf",
                         {{"ior", number(index)},
                          {"roughness", roughness(alpha, alpha)},
                          {"scatter_mode", text(mode)}});
}

BsdfPtr layered_glass(Recorder& recorder, Float index, float alpha) {
  return std::make_shared<LayerBsdf>(glass(recorder, "R", index, alpha),
                                     glass(recorder, "T", index, alpha));
}

TEST(Furnace, GlassReturnsAllLightToTheOutside) {
  for (const float alpha : {0.05f, 0.2f, 0.5f, 1.0f}) {
    for (const float index : {1.1f, 1.5f, 2.5f}) {
      const Furnace joint([&](Recorder& r) { return glass(r, "RT", index, alpha); });
      const Furnace layer([&](Recorder& r) { return layered_glass(r, index, alpha); });
      for (const double angle : outside) {
        EXPECT_NEAR(joint.light(angle), 1.0, 1e-2)
            << "RT " << alpha << " index " << index << " angle " << angle;
        EXPECT_NEAR(layer.light(angle), 1.0, 1e-2)
            << "R over T " << alpha << " index " << index << " angle " << angle;
      }
      EXPECT_NEAR(joint.light(89.0), 1.0, 1e-2) << "RT " << alpha << " index " << index;
    }
  }
}

TEST(Furnace, GlassReturnsAllLightToTheInside) {
  for (const float alpha : {0.05f, 0.2f, 0.5f, 1.0f}) {
    for (const float index : {1.1f, 1.5f, 2.5f}) {
      const Furnace joint([&](Recorder& r) { return glass(r, "RT", index, alpha); });
      const Furnace layer([&](Recorder& r) { return layered_glass(r, index, alpha); });
      for (const double angle : inside) {
        EXPECT_NEAR(joint.light(angle), 1.0, 1e-2)
            << "RT " << alpha << " index " << index << " angle " << angle;
        EXPECT_NEAR(layer.light(angle), 1.0, 1e-2)
            << "R over T " << alpha << " index " << index << " angle " << angle;
      }
    }
  }
}

/// It was .978 (index 1.1, from inside) and .989 (R over T).
TEST(Furnace, RoughGlassReturnsAllLightAtGrazing) {
  for (const float alpha : {0.5f, 0.8f, 1.0f}) {
    for (const float index : {1.1f, 1.5f, 2.5f}) {
      const Furnace joint([&](Recorder& r) { return glass(r, "RT", index, alpha); });
      const Furnace layer([&](Recorder& r) { return layered_glass(r, index, alpha); });
      for (const double angle : {80.0, 88.0, 89.9, 91.0, 100.0}) {
        EXPECT_NEAR(joint.light(angle), 1.0, 1e-2)
            << "RT " << alpha << " index " << index << " angle " << angle;
        EXPECT_NEAR(layer.light(angle), 1.0, 1e-2)
            << "R over T " << alpha << " index " << index << " angle " << angle;
      }
    }
  }
}

/// The tables of equal roughnesses gave 1.5 and .03 here.
TEST(Furnace, AnisotropicGlassReturnsAllLight) {
  constexpr int count = 1 << 17;  // Little passes some views, but brightly.
  const float pairs[][2] = {
      {1.0f, 0.1f}, {0.5f, 0.25f}, {0.3f, 0.21f}, {1.0f, 0.01f}, {0.05f, 0.6f}};
  for (const auto& [ax, ay] : pairs) {
    for (const float index : {1.1f, 1.5f, 2.5f}) {
      const auto lobe = [&, x = ax, y = ay](const char* mode) {
        return [&, x, y, mode](Recorder& r) { return glass(r, mode, index, x, y); };
      };
      const Furnace joint(lobe("RT")), through(lobe("T"));
      const Furnace layer(
          [&](Recorder& r) { return std::make_shared<LayerBsdf>(lobe("R")(r), lobe("T")(r)); });
      for (const double azimuth : {0.0, 60.0, 90.0}) {
        for (const double angle : {0.0, 60.0, 88.0, 89.9, 91.0, 100.0, 110.0, 130.0, 150.0}) {
          const auto expect_all = [&](const Furnace& furnace, const char* name) {
            EXPECT_NEAR(furnace.light(angle, azimuth, count), 1.0, 2e-2)
                << name << " " << ax << " " << ay << " index " << index << " angle " << angle
                << " azimuth " << azimuth;
          };
          expect_all(joint, "RT"), expect_all(through, "T"), expect_all(layer, "R over T");
        }
      }
    }
  }
}

/// More points or fewer are summed: what that changes is no more than this.
TEST(Furnace, AnisotropicGlassIsAsExactAsAsked) {
  constexpr int count = 1 << 13;
  for (const auto& [accuracy, bound] :
       {std::pair(Accuracy::fast, 3e-2), {Accuracy::precise, 1e-2}}) {
    double worst = 0.0;
    const float pairs[][2] = {{1.0f, 0.1f}, {0.5f, 0.25f}, {0.05f, 0.6f}};
    for (const auto& [ax, ay] : pairs) {
      for (const float index : {1.1f, 1.5f}) {
        const Furnace joint(
            [&, x = ax, y = ay](Recorder& r) { return glass(r, "RT", index, x, y); }, false,
            accuracy);
        for (const double angle : {0.0, 60.0, 88.0, 100.0, 150.0}) {
          worst = std::max(worst, std::abs(joint.light(angle, 60.0, count) - 1.0));
        }
      }
    }
    EXPECT_LT(worst, bound) << static_cast<int>(accuracy);
    RecordProperty(accuracy == Accuracy::fast ? "fast" : "precise", std::to_string(worst));
  }
}

/// Across the axis that it is smooth along, gloss seen at grazing is as bright as a mirror, and
/// along the other not: what passes below hangs on the azimuth. It was 1.5 times what is there.
TEST(Furnace, AnisotropicGlossOverWhiteReturnsAllLight) {
  constexpr int count = 1 << 13;
  const float pairs[][2] = {{1.0f, 0.1f}, {0.5f, 0.25f}, {0.3f, 0.21f}, {0.05f, 0.6f}};
  for (const auto& [ax, ay] : pairs) {
    for (const float index : {1.1f, 1.5f, 2.5f}) {
      const auto gloss = [&, x = ax, y = ay](Recorder& r) { return glass(r, "R", index, x, y); };
      const Furnace alone(gloss);
      const Furnace layer(
          [&](Recorder& r) { return std::make_shared<LayerBsdf>(gloss(r), white_diffuse(r)); });
      for (const double azimuth : {0.0, 20.0, 45.0, 80.0, 90.0}) {
        for (const double angle : {0.0, 60.0, 75.0, 85.0, 89.0, 89.9}) {
          EXPECT_NEAR(layer.light(angle, azimuth, count), 1.0, 2e-2)
              << ax << " " << ay << " index " << index << " angle " << angle << " azimuth "
              << azimuth;
          EXPECT_NEAR(alone.albedo(angle, azimuth), alone.light(angle, azimuth, count), 2e-2)
              << ax << " " << ay << " index " << index << " angle " << angle << " azimuth "
              << azimuth;
        }
      }
    }
  }
}

/// What a film changes is summed over the facets too.
TEST(Furnace, AnisotropicFilmedGlassReturnsAllLight) {
  constexpr int count = 1 << 13;
  const float pairs[][2] = {{1.0f, 0.1f}, {0.5f, 0.25f}, {0.05f, 0.6f}};
  for (const auto& [ax, ay] : pairs) {
    const Furnace joint([&, x = ax, y = ay](Recorder& r) {
      return microfacet_bsdf(r, "dielectric_bsdf",
                             {{"roughness", roughness(x, y)},
                              {"thinfilm_thickness", number(450.0f)},
                              {"thinfilm_ior", number(1.35f)},
                              {"scatter_mode", text("RT")}});
    });
    for (const double azimuth : {0.0, 45.0, 90.0}) {
      for (const double angle : {0.0, 60.0, 88.0, 95.0, 110.0, 150.0}) {
        EXPECT_NEAR(joint.light(angle, azimuth, count), 1.0, 2e-2)
            << ax << " " << ay << " angle " << angle << " azimuth " << azimuth;
      }
    }
  }
}

/// Indices that hardly differ; nearer than 1e-3 light goes straight.
TEST(Furnace, GlassInGlassReturnsAllLight) {
  constexpr int count = 1 << 13;
  for (const float alpha : {0.05f, 0.3f, 1.0f}) {
    for (const float index : {1.0009f, 1.0011f, 1.003f, 1.02f, 1.07f}) {
      const Furnace joint([&](Recorder& r) { return glass(r, "RT", index, alpha); });
      for (const double angle : {60.0, 85.0, 88.0, 92.0, 95.0, 120.0}) {
        EXPECT_NEAR(joint.light(angle, 30.0, count), 1.0, 2e-2)
            << alpha << " index " << index << " angle " << angle;
      }
    }
  }
}

// A lobe that sends back more than arrives, of a weight that makes it less: what is cut at 1 is the
// sum.
TEST(Furnace, AlbedoIsCutWhereTheSumIsMoreThanArrives) {
  for (const float weight : {0.3f, 0.6f}) {
    const Furnace furnace([&](Recorder& r) {
      return microfacet_bsdf(
          r, "burley_diffuse_bsdf",
          {{"color", colour(1.0f)}, {"roughness", number(1.0f)}, {"weight", number(weight)}});
    });
    EXPECT_GT(furnace.light(89.0), 1.4 * weight);
    EXPECT_NEAR(furnace.albedo(89.0), furnace.light(89.0), 1e-2);
  }
}

// Nothing is there to reflect light, whether a film may come or not: one of no thickness is none.
TEST(Furnace, FilmsThatMayComeMakeNoInterface) {
  const double grazing = 89.5 * std::numbers::pi / 180.0;
  for (const float index : {1.0009f, 0.9992f}) {
    Recorder recorder;
    Surface surface;
    surface.bsdf = microfacet_bsdf(
        recorder, "dielectric_bsdf",
        {{"ior", number(index)},
         {"roughness", roughness(0.3f, 0.3f)},
         {"scatter_mode", text("RT")},
         {"thinfilm_thickness", number(Float(recorder.parameter("film", Scalar::f32, 0)))}});
    const SurfaceKernels kernels = record_kernels(recorder, surface, Accuracy::standard, {});
    const auto evaluate =
        lobe_kernel(slice(recorder.program(), "evaluate", kernels.evaluate), Accuracy::standard);
    Columns in = view(89.5, 0.0);
    in["wi.x"] = {static_cast<float>(-std::sin(grazing))};
    in["wi.z"] = {static_cast<float>(std::cos(grazing))};
    EXPECT_EQ(run(*evaluate, in).at("f.x")[0], 0.0f) << index;
  }
}

TEST(Furnace, WhiteMetalUnderAFilmReturnsAllLight) {
  for (const float thickness : {100.0f, 550.0f, 2000.0f}) {
    for (const float alpha : {0.1f, 0.5f, 1.0f}) {
      const Furnace furnace([&](Recorder& r) {
        return microfacet_bsdf(r, "generalized_schlick_bsdf",
                               {{"color0", colour(1.0f)},
                                {"color82", colour(1.0f)},
                                {"color90", colour(1.0f)},
                                {"exponent", number(5.0f)},
                                {"roughness", roughness(alpha, alpha)},
                                {"thinfilm_thickness", number(thickness)},
                                {"thinfilm_ior", number(1.4f)}});
      });
      for (const double angle : {0.0, 60.0, 85.0}) {
        EXPECT_NEAR(furnace.light(angle), 1.0, 1e-2) << thickness << " " << alpha << " " << angle;
      }
    }
  }
}

// A film moves light between reflection and transmission of each channel; the
// tables know the bare interface (pbs/microfacet_interface.cpp).
TEST(Furnace, FilmedGlassReturnsAllLight) {
  for (const float alpha : {0.0f, 0.1f, 0.5f, 1.0f}) {
    for (const float thickness : {20.0f, 300.0f}) {
      const auto film = [&](Recorder& r, const char* mode) {
        return microfacet_bsdf(r, "dielectric_bsdf",
                               {{"roughness", roughness(alpha, alpha)},
                                {"thinfilm_thickness", number(thickness)},
                                {"thinfilm_ior", number(1.9f)},
                                {"scatter_mode", text(mode)}});
      };
      const Furnace joint([&](Recorder& r) { return film(r, "RT"); });
      const Furnace layer(
          [&](Recorder& r) { return std::make_shared<LayerBsdf>(film(r, "R"), film(r, "T")); });
      for (const double angle : {0.0, 50.0, 80.0, 155.0}) {
        const double error = angle < 90.0 ? 2e-2 : 3e-2;
        EXPECT_NEAR(joint.light(angle), 1.0, error)
            << "RT " << alpha << " film " << thickness << " angle " << angle;
        EXPECT_NEAR(layer.light(angle), 1.0, error)
            << "R over T " << alpha << " film " << thickness << " angle " << angle;
      }
    }
  }
}

}  // namespace
}  // namespace nacre
