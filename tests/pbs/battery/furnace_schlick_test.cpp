// The white furnace of generalized Schlick's curves, which are no dielectric's.
#include <gtest/gtest.h>

#include "tests/pbs/battery/furnace.h"

namespace nacre {
namespace {

BsdfPtr schlick(Recorder& recorder, const char* mode, Float f0, Float f90, float alpha) {
  return microfacet_bsdf(recorder, "generalized_schlick_bsdf",
                         {{"color0", colour(f0)},
                          {"color90", colour(f90)},
                          {"roughness", roughness(alpha, alpha)},
                          {"scatter_mode", text(mode)}});
}

TEST(Furnace, SchlickInterfaceReturnsAllLight) {
  for (const float alpha : {0.05f, 0.3f, 1.0f}) {
    for (const float f0 : {0.02f, 0.04f, 0.3f}) {
      const Furnace joint([&](Recorder& r) { return schlick(r, "RT", f0, 1.0f, alpha); });
      const Furnace layer([&](Recorder& r) {
        return std::make_shared<LayerBsdf>(schlick(r, "R", f0, 1.0f, alpha),
                                           schlick(r, "T", f0, 1.0f, alpha));
      });
      for (const double angle : outside) {
        EXPECT_NEAR(layer.light(angle), 1.0, 1e-2)
            << "R over T " << alpha << " f0 " << f0 << " angle " << angle;
        EXPECT_NEAR(joint.light(angle), 1.0, 1.5e-2)
            << "RT " << alpha << " f0 " << f0 << " angle " << angle;
      }
      EXPECT_NEAR(joint.light(160.0), 1.0, 2e-2) << "RT " << alpha << " f0 " << f0;
    }
  }
}

// What such a curve reflects more or less than glass of that index passes, or does not.
TEST(Furnace, BrightAndColouredSchlickInterfacesReturnAllLight) {
  const Color3 colours[] = {{0.8f, 0.3f, 0.1f}, {0.3f, 0.1f, 0.8f}, Color3(0.5f),
                            Color3(0.9f),       Color3(0.97f),      Color3(1.0f)};
  for (const Color3& color0 : colours) {
    for (const float alpha : {0.1f, 0.4f, 0.9f}) {
      const Furnace furnace([&](Recorder& r) {
        return microfacet_bsdf(r, "generalized_schlick_bsdf",
                               {{"color0", Recorded{Type::color3, color0}},
                                {"scatter_mode", text("RT")},
                                {"roughness", roughness(alpha, alpha)}});
      });
      for (const double angle : {0.0, 30.0, 60.0, 80.0, 85.0, 120.0, 150.0, 165.0, 180.0}) {
        EXPECT_NEAR(furnace.light(angle), 1.0, 1.5e-2)
            << color0.x.constant() << " " << alpha << " at " << angle;
      }
    }
  }
}

// Just before total reflection sets in the curve bends up steeply, as no dielectric's does: two
// angles do not stand for it.
TEST(Furnace, SchlickInterfaceReturnsAllLightToTheInside) {
  for (const float alpha : {0.2f, 0.5f, 0.65f, 0.7f, 0.75f, 0.85f, 1.0f}) {
    const Furnace joint([&](Recorder& r) { return schlick(r, "RT", 0.04f, 1.0f, alpha); });
    for (const double angle : {180.0, 130.0, 110.0, 100.0, 97.0, 95.0, 93.0, 91.0}) {
      EXPECT_NEAR(joint.light(angle), 1.0, 1e-2) << alpha << " angle " << angle;
    }
  }
}

// What a coloured layer reflects of a channel does not reach the base in that channel.
TEST(Furnace, ColouredSchlickOverWhiteReturnsNoMoreThanArrives) {
  for (const float alpha : {0.0f, 0.3f, 1.0f}) {
    const Furnace furnace([&](Recorder& r) {
      const BsdfPtr red =
          microfacet_bsdf(r, "generalized_schlick_bsdf",
                          {{"color0", Recorded{Type::color3, Color3(1.0f, 0.0f, 0.0f)}},
                           {"roughness", roughness(alpha, alpha)}});
      return std::make_shared<LayerBsdf>(red, white_diffuse(r));
    });
    for (const double angle : outside) {
      EXPECT_NEAR(furnace.light(angle), 1.0, 1e-2) << alpha << " " << angle;
      EXPECT_NEAR(furnace.albedo(angle), 1.0, 1e-2) << alpha << " " << angle;
    }
  }
}

// Curves that dip before they rise to grazing: what facets reflect of them is not what two cosines
// say that stand for curves which only rise. The albedo is what layers below get the rest of.
TEST(Furnace, DippingSchlickOverWhiteReturnsAllLight) {
  for (const float alpha : {0.05f, 0.1f, 0.3f, 1.0f}) {
    for (const float color0 : {0.5f, 0.8f, 1.0f}) {
      for (const float color82 : {0.0f, 0.5f}) {
        const Furnace furnace([&](Recorder& r) {
          const BsdfPtr top = microfacet_bsdf(r, "generalized_schlick_bsdf",
                                              {{"color0", colour(color0)},
                                               {"color82", colour(color82)},
                                               {"roughness", roughness(alpha, alpha)}});
          return std::make_shared<LayerBsdf>(top, white_diffuse(r));
        });
        for (const double angle : {45.0, 75.0, 82.0, 85.0, 88.0}) {
          EXPECT_NEAR(furnace.light(angle), 1.0, 1e-2)
              << alpha << " " << color0 << " " << color82 << " at " << angle;
        }
      }
    }
  }
}

}  // namespace
}  // namespace nacre
