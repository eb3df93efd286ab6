// Profiles: what is written is read, and what is none is refused.
#include "jit/tune/profile.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

Tuned tuned(const Choices& choices) {
  Tuned made;
  made.chosen.choices = choices;
  made.chosen.unseen_error = Error();
  return made;
}

TEST(TuneProfile, WhatIsWrittenIsRead) {
  Choices cheap = standard_choices();
  for (std::size_t& each : cheap) each = 1;
  const std::string text =
      profile_text({{"Gold", true, tuned(cheap)}, {"NG/out", false, tuned(exact_choices())}}, {});
  Diagnostics diagnostics;
  const auto profile = Profile::parse(text, "p.json", diagnostics);
  ASSERT_TRUE(profile) << diagnostics.to_string();
  ASSERT_NE(profile->find("Gold", true), nullptr);
  EXPECT_EQ(*profile->find("Gold", true), cheap);
  EXPECT_EQ(*profile->find("NG/out", false), exact_choices());
  EXPECT_EQ(profile->find("Gold", false), nullptr);
  EXPECT_EQ(profile->find("Silver", true), nullptr);
}

TEST(TuneProfile, WhatIsNotSaidIsStandard) {
  Diagnostics diagnostics;
  const auto profile = Profile::parse(
      R"({"nacre_profile": 1, "subjects": [{"material": "M", "choices": {"anisotropy": "4"}}]})",
      "p.json", diagnostics);
  ASSERT_TRUE(profile) << diagnostics.to_string();
  ShaderOptions options;
  apply_choices(*profile->find("M", true), options);
  EXPECT_EQ(options.max_anisotropy, 4);
  EXPECT_EQ(options.compile.accuracy, Accuracy::standard);
  EXPECT_EQ(options.kernels.compensation, Compensation::all);
  EXPECT_TRUE(options.footprints);
}

TEST(TuneProfile, StandardChoicesAreWhatIsCompiledWithoutAny) {
  ShaderOptions options;
  apply_choices(standard_choices(), options);
  const ShaderOptions plain;
  EXPECT_EQ(options.compile.accuracy, plain.compile.accuracy);
  EXPECT_EQ(options.max_anisotropy, plain.max_anisotropy);
  EXPECT_EQ(options.kernels.compensation, plain.kernels.compensation);
  EXPECT_EQ(options.footprints, plain.footprints);
}

TEST(TuneProfile, OutputsOfOneKernelHaveTheMostExactOfTheirChoices) {
  Diagnostics diagnostics;
  const auto profile = Profile::parse(R"({"nacre_profile": 1, "subjects": [
    {"output": "a", "choices": {"accuracy": "fast", "anisotropy": "8"}},
    {"output": "b", "choices": {"accuracy": "precise", "anisotropy": "2"}}]})",
                                      "p.json", diagnostics);
  ASSERT_TRUE(profile) << diagnostics.to_string();
  ShaderOptions options;
  apply_profile(*profile, {"a", "b"}, false, options, diagnostics);
  EXPECT_EQ(options.compile.accuracy, Accuracy::precise);
  EXPECT_EQ(options.max_anisotropy, 8);
  EXPECT_EQ(diagnostics.warning_count(), 0u);
  apply_profile(*profile, {"a", "c"}, false, options, diagnostics);
  EXPECT_EQ(options.compile.accuracy, Accuracy::standard);
  EXPECT_EQ(diagnostics.warning_count(), 1u);
}

struct Bad {
  const char* text;
  const char* said;  ///< Part of what is said of it.
};

class TuneProfileBad : public testing::TestWithParam<Bad> {};

TEST_P(TuneProfileBad, IsRefusedWithWhatWouldBeRight) {
  Diagnostics diagnostics;
  EXPECT_FALSE(Profile::parse(GetParam().text, "p.json", diagnostics));
  ASSERT_EQ(diagnostics.error_count(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "bad-profile");
  EXPECT_EQ(diagnostics.all()[0].where.file, "p.json");
  EXPECT_NE(diagnostics.to_string().find(GetParam().said), std::string::npos)
      << diagnostics.to_string();
}

INSTANTIATE_TEST_SUITE_P(
    All, TuneProfileBad,
    testing::Values(
        Bad{"", "a JSON object"}, Bad{"[", "a JSON object"}, Bad{"[]", "a JSON object"},
        Bad{"{}", "\"nacre_profile\": 1"}, Bad{R"({"nacre_profile": 2})", "found 2"},
        Bad{R"({"nacre_profile": 1})", "\"subjects\": [...]"},
        Bad{R"({"nacre_profile": 1, "subjects": [3]})", "a subject is an object"},
        Bad{R"({"nacre_profile": 1, "subjects": [{"choices": {}}]})", "\"material\" or \"output\""},
        Bad{R"({"nacre_profile": 1, "subjects": [{"material": 1, "choices": {}}]})", "a text"},
        Bad{R"({"nacre_profile": 1, "subjects": [{"material": "M"}]})", "\"choices\": {...}"},
        Bad{R"({"nacre_profile": 1, "subjects": [{"material": "M", "choices": {"speed": "1"}}]})",
            "accuracy, anisotropy"},
        Bad{R"({"nacre_profile": 1, "subjects": [{"material": "M", "choices": {"accuracy": 1}}]})",
            "precise, standard, fast"},
        Bad{R"({"nacre_profile": 1, "subjects": [{"material": "M", "choices": {}},
                {"material": "M", "choices": {}}]})",
            "one of a name"}));

}  // namespace
}  // namespace nacre
