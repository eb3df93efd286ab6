#include "jit/record/pattern.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace nacre {
namespace {

bool fits(const std::string& name, const std::string& pattern) {
  return fits_any(name, std::vector<std::string>{pattern});
}

TEST(Pattern, StarIsAnyTextAndQuestionMarkOneLetter) {
  for (const char* pattern : {"SR/base_color", "*", "SR/*", "*color", "S?/*_*", "*/*",
                              "SR/base_color*", "**", "*base*"}) {
    EXPECT_TRUE(fits("SR/base_color", pattern)) << pattern;
  }
  for (const char* pattern :
       {"", "SR/base", "base_color", "?", "SR/?", "*x", "SR/*_color?", "sr/*"}) {
    EXPECT_FALSE(fits("SR/base_color", pattern)) << pattern;
  }
  EXPECT_TRUE(fits("", "*"));
  EXPECT_TRUE(fits("", ""));
  EXPECT_FALSE(fits("", "?"));
}

TEST(Pattern, TriesAgainBehindAStar) {
  EXPECT_TRUE(fits("abcabd", "*abd"));
  EXPECT_TRUE(fits("aaab", "*a?b"));
  EXPECT_FALSE(fits("abab", "*ba?b"));
}

/// Whoever tries all ways of many stars is here for centuries.
TEST(Pattern, ManyStarsTakeNoLonger) {
  std::string pattern;
  for (int i = 0; i < 40; ++i) pattern += "*a";
  EXPECT_FALSE(fits(std::string(2000, 'a') + 'b', pattern));
  EXPECT_TRUE(fits(std::string(2000, 'a'), pattern));
}

TEST(Pattern, OneOfSeveralIsEnough) {
  EXPECT_TRUE(fits_any("time", std::vector<std::string>{"frame", "t*"}));
  EXPECT_FALSE(fits_any("time", std::vector<std::string>{}));
}

}  // namespace
}  // namespace nacre
