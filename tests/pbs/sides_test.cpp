#include "pbs/sides.h"

#include <gtest/gtest.h>

#include "pbs/bsdf.h"

namespace nacre {
namespace {

class NoBsdf final : public Bsdf {
 public:
  Color3 part_weight(std::size_t, Color3 weight, const Throughput&) const override {
    return weight;
  }
  Color3 throughput(const View&, Color3, Color3) const override { return Color3(1.0f); }
};

SurfacePtr surface(bool scatters, bool thin) {
  auto result = std::make_shared<Surface>();
  if (scatters) result->bsdf = std::make_shared<NoBsdf>();
  result->thin_walled = thin;
  return result;
}

// The sentences of MaterialX PBS 1.39, "Surfaces", one by one.

TEST(SurfaceSides, OneShaderIsOnBoth) {
  const SurfacePtr only = surface(true, true);
  EXPECT_EQ(surface_sides(only, nullptr).front, only);
  EXPECT_EQ(surface_sides(nullptr, only).front, only);
  EXPECT_EQ(surface_sides(only, nullptr).back, nullptr);
  EXPECT_EQ(surface_sides(nullptr, only).back, nullptr);
}

TEST(SurfaceSides, OneThinWallMakesBothThin) {
  for (const bool front_is_thin : {true, false}) {
    const SurfacePtr front = surface(true, front_is_thin), back = surface(true, !front_is_thin);
    const SurfaceSides sides = surface_sides(front, back);
    EXPECT_TRUE(sides.front->thin_walled.is_constant(true));
    EXPECT_TRUE(sides.back->thin_walled.is_constant(true));
    EXPECT_EQ(sides.front->bsdf, front->bsdf);
    EXPECT_EQ(sides.back->bsdf, back->bsdf);
  }
}

TEST(SurfaceSides, OfTwoSolidsTheFrontIsUsed) {
  const SurfacePtr front = surface(true, false);
  EXPECT_EQ(surface_sides(front, surface(true, false)).front, front);
  EXPECT_EQ(surface_sides(front, surface(true, false)).back, nullptr);
  EXPECT_EQ(surface_sides(front, surface(false, false)).back, nullptr);
}

TEST(SurfaceSides, WhatOnlyGlowsBoundsNothing) {
  const SurfaceSides sides = surface_sides(surface(false, false), surface(false, false));
  ASSERT_NE(sides.back, nullptr);
  EXPECT_TRUE(sides.back->thin_walled.is_constant(false));
}

}  // namespace
}  // namespace nacre
