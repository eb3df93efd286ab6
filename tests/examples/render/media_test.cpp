// What a path is inside of, by the rules of Schmidt and Budge 2002.
#include "examples/render/media.h"

#include <gtest/gtest.h>

namespace nacre::host {
namespace {

const Medium clear{};
Medium filled(float amount) { return {{amount, amount, amount}, {}, 0.f}; }
Medium fog(float amount) {
  Medium medium = filled(amount);
  medium.is_open = true;
  return medium;
}

TEST(Media, WhatEnclosesComesBack) {
  Media media;
  EXPECT_TRUE(media.enter(1, 0, filled(1)));
  EXPECT_TRUE(media.enter(2, 0, filled(2)));
  EXPECT_EQ(media.current().absorption.x, 2.f);
  media.leave(3, 0);  // Never entered.
  media.leave(1, 0);  // Overlapping: the other is still around.
  EXPECT_EQ(media.current().absorption.x, 2.f);
  media.leave(2, 0);
  EXPECT_TRUE(media.empty());
  for (std::uint32_t i = 0; i < Media::capacity; ++i) EXPECT_TRUE(media.enter(i, 0, filled(1)));
  EXPECT_FALSE(media.enter(9, 0, filled(1)));
}

// A ray through the wall of a glass into a drink that overlaps the wall, through ice that floats in
// it and sticks into the other wall, and out. Their figure 3: what is hidden is between what is
// not.
TEST(Media, OfADrink) {
  constexpr std::uint32_t glass = 10, drink = 11, ice = 12;
  const Dielectric of_glass{1.5f, 3}, of_drink{1.33f, 1}, of_ice{1.31f, 2};
  Media media;
  EXPECT_FALSE(media.hides_entry(of_glass.priority));
  EXPECT_EQ(media.index(), 1.f);
  media.enter(glass, 0, clear, of_glass);
  // The drink begins within the wall, hidden, and is there where the wall ends.
  EXPECT_TRUE(media.hides_entry(of_drink.priority));
  media.enter(drink, 0, filled(1), of_drink);
  EXPECT_EQ(media.index(), 1.5f);
  EXPECT_TRUE(media.current().is_empty());
  EXPECT_FALSE(media.hides_exit(glass, 0));
  EXPECT_EQ(media.index_outside(glass, 0), 1.33f);
  media.leave(glass, 0);
  EXPECT_EQ(media.index(), 1.33f);
  EXPECT_EQ(media.current().absorption.x, 1.f);
  EXPECT_FALSE(media.hides_entry(of_ice.priority));
  media.enter(ice, 0, clear, of_ice);
  EXPECT_EQ(media.index_outside(ice, 0), 1.33f);
  EXPECT_TRUE(media.current().is_empty());
  EXPECT_FALSE(media.hides_entry(of_glass.priority));
  EXPECT_EQ(media.index(), 1.31f);
  media.enter(glass, 0, clear, of_glass);
  EXPECT_TRUE(media.hides_exit(ice, 0));
  media.leave(ice, 0);
  EXPECT_TRUE(media.hides_exit(drink, 0));
  media.leave(drink, 0);
  EXPECT_FALSE(media.hides_exit(glass, 0));
  EXPECT_EQ(media.index_outside(glass, 0), 1.f);
  media.leave(glass, 0);
  EXPECT_TRUE(media.empty());
}

TEST(Media, OfEqualPriorityTheLastIsThere) {
  Media media;
  media.enter(1, 0, filled(1), {1.2f, 0});
  EXPECT_FALSE(media.hides_entry(0));
  media.enter(2, 0, filled(2), {1.4f, 0});
  EXPECT_EQ(media.index(), 1.4f);
  EXPECT_TRUE(media.hides_exit(1, 0));
  EXPECT_FALSE(media.hides_exit(2, 0));
  EXPECT_EQ(media.index_outside(2, 0), 1.2f);
  media.leave(1, 0);
  EXPECT_EQ(media.index(), 1.4f);
  EXPECT_EQ(media.index_outside(2, 0), 1.f);
}

// Instances of one mesh are solids of their own; of what was never entered the border is there.
TEST(Media, TellsInstancesApart) {
  Media media;
  media.enter(1, 0, clear, {1.2f, 0});
  media.enter(1, 1, clear, {1.2f, 0});
  EXPECT_TRUE(media.hides_exit(1, 0));
  EXPECT_FALSE(media.hides_exit(1, 1));
  EXPECT_FALSE(media.hides_exit(1, 2));
  EXPECT_EQ(media.index_outside(1, 2), 1.2f);
}

// What bends no light hides nothing, and is in what it was entered in.
TEST(Media, VolumesAreWithinSolids) {
  Media media;
  media.enter(1, 0, fog(1));
  EXPECT_FALSE(media.hides_entry(-5));
  EXPECT_EQ(media.index(), 1.f);
  media.enter(2, 0, clear, {1.5f, 4});
  EXPECT_TRUE(media.current().is_empty());  // No fog in the glass,
  media.enter(3, 0, fog(3));
  EXPECT_EQ(media.current().absorption.x, 3.f);  // but what is put there.
  EXPECT_EQ(media.index(), 1.5f);
  EXPECT_TRUE(media.hides_entry(3));
  media.enter(4, 0, filled(4), {1.3f, 3});
  EXPECT_EQ(media.current().absorption.x, 3.f);
  EXPECT_FALSE(media.hides_exit(3, 0));
  media.leave(3, 0);
  EXPECT_TRUE(media.current().is_empty());
  media.leave(2, 0);
  EXPECT_EQ(media.current().absorption.x, 4.f);
  media.leave(4, 0);
  EXPECT_EQ(media.current().absorption.x, 1.f);
  EXPECT_TRUE(media.is_open());
}

}  // namespace
}  // namespace nacre::host
