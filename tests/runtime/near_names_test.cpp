#include "runtime/near_names.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

using Names = std::vector<std::string>;

Names near(std::string_view wanted, const Names& known) {
  NearNames names(wanted);
  for (const std::string& each : known) names.offer(each);
  return names.names();
}

TEST(NearNames, AreOneSlipAway) {
  const Names known{"base_color"};
  for (const char* wanted : {"bae_color", "base_colour", "base_cplor", "bsae_color"}) {
    EXPECT_EQ(near(wanted, known), known) << wanted;
  }
}

TEST(NearNames, ASwapOfNeighboursIsOneSlip) {
  // Two replacements by Levenshtein's distance, which a name of five letters is not worth.
  EXPECT_EQ(near("nosie", {"noise"}), Names{"noise"});
  EXPECT_EQ(near("niose", {"noise"}), Names{"noise"});
  EXPECT_EQ(near("nioes", {"noise"}), Names{});
  // Optimal string alignment edits no letters twice: "ca" to "abc" takes three slips, not two.
  EXPECT_EQ(near("xxxxca", {"xxxxabc"}), Names{});
}

TEST(NearNames, LongerNamesMayBeFurther) {
  EXPECT_EQ(near("mxi", {"mix"}), Names{"mix"});
  EXPECT_EQ(near("mx", {"mix"}), Names{});
  EXPECT_EQ(near("mad", {"mix"}), Names{});
  EXPECT_EQ(near("stanard_surfcae", {"standard_surface"}), Names{"standard_surface"});
  EXPECT_EQ(near("stnrd_srface", {"standard_surface"}), Names{});
}

TEST(NearNames, AreTheNearestThreeAtMostByName) {
  const Names known{"image5", "image", "imago", "tiledimage", "images", "imagea"};
  EXPECT_EQ(near("imagee", known), (Names{"image", "image5", "imagea"}));
  const Names backwards(known.rbegin(), known.rend());
  EXPECT_EQ(near("imagee", backwards), (Names{"image", "image5", "imagea"}));
  EXPECT_EQ(near("ND_mix_flaot", {"ND_max_float", "ND_mix_float"}), Names{"ND_mix_float"});
}

TEST(NearNames, OtherCaseGoesBeforeSlips) {
  EXPECT_EQ(near("MIX", {"mix", "max", "Mix"}), (Names{"Mix", "mix"}));
  EXPECT_EQ(near("NG", {"ng"}), Names{"ng"});
}

TEST(NearNames, OfferedTwiceCountOnce) {
  EXPECT_EQ(near("imgae", {"image", "image", "image"}), Names{"image"});
}

TEST(NearNames, OfLongOrEmptyNamesThereAreNone) {
  EXPECT_EQ(near("", {"", "a"}), Names{});
  EXPECT_EQ(near(std::string(5000, 'a'), {std::string(4999, 'a')}), Names{});
  EXPECT_EQ(near(std::string(100, 'a'), {std::string(99, 'a')}), Names{std::string(99, 'a')});
}

TEST(NearNames, AreOfferedAsFarAsAHintIsWorthIt) {
  NearNames names("target");
  for (std::size_t i = 0; i < NearNames::most_offered; ++i)
    names.offer("other" + std::to_string(i));
  names.offer("targe");
  EXPECT_EQ(names.names(), Names{});
}

TEST(NearNames, AreSaidAsAHint) {
  const Diagnostics none;
  EXPECT_EQ(near_hint(none, "Mix", Names{"mix"}), "it differs only in case from 'mix'");
  EXPECT_EQ(near_hint(none, "imag", Names{"image"}), "did you mean 'image'?");
  EXPECT_EQ(near_hint(none, "imagee", Names{"image", "imagea", "images"}),
            "did you mean 'image', 'imagea' or 'images'?");
  EXPECT_EQ(near_hint(none, "noise", Names{"image"}), "");
}

TEST(NearNames, AreNotLookedForOnceMuchWasSaid) {
  Diagnostics said;
  for (int i = 0; i < 1000; ++i) said.error("x", {}, "x");
  EXPECT_EQ(near_hint(said, "imag", Names{"image"}), "");
}

TEST(NearNames, StandBehindWhatWasFound) {
  const Diagnostic said{.code = "unknown-node",
                        .where = {},
                        .message = "there is none",
                        .expected = "a node",
                        .found = "<imag>",
                        .hint = "did you mean 'image'?"};
  EXPECT_EQ(said.to_string(),
            "error: there is none; expected a node, found <imag>; did you mean 'image'? "
            "[unknown-node]");
}

}  // namespace
}  // namespace nacre
