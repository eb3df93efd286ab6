#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pbs/facets.h"
#include "runtime/node/geometry.h"
#include "tests/support/closure.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// In the plane of x and z, by the angle to z.
void put(Columns& columns, const std::string& name, double angle) {
  columns[name + ".x"].push_back(static_cast<float>(std::sin(angle * degree)));
  columns[name + ".z"].push_back(static_cast<float>(std::cos(angle * degree)));
}

/// Gloss over nothing, bumped: what it reflects to a viewer, by reference.
double reflected(double viewer, double bump, double geometric = 0.0) {
  Recorder recorder;
  const auto given = [&](const char* name) {
    return Float3(input(recorder, std::string(name) + ".x"), 0.0f,
                  input(recorder, std::string(name) + ".z"));
  };
  Surface surface;
  surface.bsdf = microfacet_bsdf(
      recorder, "dielectric_bsdf",
      {{"roughness", roughness(0.3f, 0.3f)}, {"normal", Recorded{Type::vector3, given("bump")}}});
  const SurfaceKernels kernels = record_kernels(recorder, surface, Accuracy::standard, {});
  Columns in;
  put(in, "wo", viewer), put(in, "bump", bump), put(in, "Ng", geometric), put(in, "N", geometric);
  const Program albedo = slice(recorder.program(), "albedo", kernels.albedo);
  return run_double(*make_reference(albedo), in).at("albedo.x")[0];
}

// A viewer who sees the surface is not within it, wherever a bump turns: at 90 degrees to the bump
// gloss reflected .2 of the light on one side, and all of it on the other.
TEST(FacingNormal, BumpsDoNotTakeViewersInside) {
  const double before = reflected(60.0, 60.0 - 89.9), after = reflected(60.0, 60.0 - 90.1);
  EXPECT_NEAR(after, before, 1e-3);
  EXPECT_LT(before, 0.5);
  // As far beyond as before the plane across the view.
  EXPECT_NEAR(reflected(60.0, 60.0 - 100.0), reflected(60.0, 60.0 - 80.0), 1e-6);
}

TEST(FacingNormal, ViewersWithinStayThere) {
  // From inside, 60 degrees to the normal: facets beyond the critical angle of 41.8 reflect all.
  EXPECT_GT(reflected(120.0, 0.0), 0.7);
  EXPECT_GT(reflected(120.0, 10.0), 0.7);
}

TEST(FacingNormal, NormalsAreUnitAndOnTheViewersSide) {
  for (const double viewer : {0.0, 40.0, 80.0}) {
    for (double bump = -175.0; bump < 180.0; bump += 25.0) {
      Recorder recorder;
      const Float3 given(input(recorder, "bump.x"), 0.0f, input(recorder, "bump.z"));
      const Float3 found = prepare_facing_normal(recorder, given);
      const Program program =
          slice(recorder.program(), "normal",
                std::vector<SliceOutput>{{"x", found.x.ref()}, {"z", found.z.ref()}});
      Columns in;
      put(in, "wo", viewer), put(in, "bump", bump), put(in, "Ng", 0.0), put(in, "N", 0.0);
      const auto out = run_double(*make_reference(program), in);
      const double x = out.at("x")[0], z = out.at("z")[0];
      EXPECT_NEAR(std::hypot(x, z), 1.0, 1e-6);
      const double seen = x * std::sin(viewer * degree) + z * std::cos(viewer * degree);
      // Bumps that lie below the surface are left alone: nobody knows what they mean.
      if (std::abs(bump) < 90.0) {
        EXPECT_GE(seen, -1e-6) << viewer << " " << bump;
      }
    }
  }
}

}  // namespace
}  // namespace nacre
