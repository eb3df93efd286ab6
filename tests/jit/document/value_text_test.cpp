#include "jit/document/value_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <limits>

namespace nacre {
namespace {

std::vector<float> floats(Type type, std::string_view text) {
  const auto value = parse_value(type, text);
  return value ? value->floats : std::vector<float>{-999};
}

TEST(ValueText, SeparatesByCommaOrSpace) {
  const std::vector<float> expected{1, -2.5f, 3e-2f};
  EXPECT_EQ(floats(Type::color3, "1, -2.5, 3e-2"), expected);
  EXPECT_EQ(floats(Type::color3, "1 -2.5 3e-2"), expected);
  EXPECT_EQ(floats(Type::color3, " 1,-2.5 , +3e-2 "), expected);
}

TEST(ValueText, NumbersRoundToNearest) {
  EXPECT_EQ(floats(Type::float_, "0.1"), std::vector<float>{0.1f});
  EXPECT_EQ(floats(Type::float_, "3.4028235e38"),
            std::vector<float>{std::numeric_limits<float>::max()});
  EXPECT_EQ(floats(Type::float_, "1e-45"),
            std::vector<float>{std::numeric_limits<float>::denorm_min()});
  EXPECT_EQ(floats(Type::float_, "1e-60"), std::vector<float>{0});
}

TEST(ValueText, IgnoresTheLocale) {
  // Where the system has none of these the classic locale stays: no harm done.
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) std::setlocale(LC_NUMERIC, name);
  EXPECT_EQ(floats(Type::float_, "0.5"), std::vector<float>{0.5f});
  EXPECT_FALSE(parse_value(Type::float_, "0,5"));
  std::setlocale(LC_NUMERIC, "C");
}

TEST(ValueText, CountsComponents) {
  EXPECT_FALSE(parse_value(Type::color3, "1, 2"));
  EXPECT_FALSE(parse_value(Type::color3, "1, 2, 3, 4"));
  EXPECT_FALSE(parse_value(Type::color3, "1,, 2, 3"));
  EXPECT_FALSE(parse_value(Type::color3, "1, 2, 3,"));
  EXPECT_FALSE(parse_value(Type::color3, ""));
  EXPECT_TRUE(parse_value(Type::matrix33, "1 0 0 0 1 0 0 0 1"));
}

TEST(ValueText, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"nan", "inf", "-inf", "1e999", "0x10", "one", "", "1e", "--1", "+-1"}) {
    EXPECT_FALSE(parse_value(Type::float_, text)) << text;
  }
  for (const char* text : {"2147483648", "-2147483649", "0x1", "1.5", ""}) {
    EXPECT_FALSE(parse_value(Type::integer, text)) << text;
  }
  EXPECT_EQ(parse_value(Type::integer, "-2147483648")->ints.at(0),
            std::numeric_limits<std::int32_t>::min());
}

TEST(ValueText, DropsLeftoversOnlyWhenAsked) {
  bool leftover = false;
  EXPECT_FALSE(parse_value(Type::float_, "0.5.0"));
  EXPECT_EQ(parse_value(Type::float_, "0.5.0", &leftover)->floats.at(0), 0.5f);
  EXPECT_TRUE(leftover);
  leftover = false;
  EXPECT_EQ(parse_value(Type::integer, "3", &leftover)->ints.at(0), 3);
  EXPECT_FALSE(leftover);
}

TEST(ValueText, BooleansAreTwoWords) {
  EXPECT_EQ(parse_value(Type::boolean, "true")->ints.at(0), 1);
  EXPECT_EQ(parse_value(Type::boolean, "false")->ints.at(0), 0);
  for (const char* text : {"True", "TRUE", "1", "0", "yes", ""}) {
    EXPECT_FALSE(parse_value(Type::boolean, text)) << text;
  }
}

TEST(ValueText, ArraysSplitAtCommasAndUnescape) {
  EXPECT_EQ(parse_value(Type::float_array, "1, 2, 3")->floats.size(), 3u);
  EXPECT_EQ(parse_value(Type::float_array, "")->floats.size(), 0u);
  EXPECT_EQ(parse_value(Type::color3_array, "1,2,3, 4,5,6")->floats.size(), 6u);
  EXPECT_FALSE(parse_value(Type::color3_array, "1,2,3, 4,5"));
  const std::vector<std::string> expected{"red", "a,b", "c\\d"};
  EXPECT_EQ(parse_value(Type::string_array, R"(red, a\,b , c\\d)")->texts, expected);
}

TEST(ValueText, StringsStayAsTheyAre) {
  EXPECT_EQ(parse_value(Type::string, " a, b ")->texts.at(0), " a, b ");
  EXPECT_EQ(parse_value(Type::filename, "x_<UDIM>.exr")->texts.at(0), "x_<UDIM>.exr");
}

TEST(ValueText, ClosuresHaveNoValue) {
  EXPECT_TRUE(parse_value(Type::bsdf, ""));
  EXPECT_FALSE(parse_value(Type::bsdf, "dielectric"));
}

TEST(ValueText, MatricesDefaultToTheIdentity) {
  const std::vector<float> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_EQ(zero_value(Type::matrix33).floats, identity);
  EXPECT_EQ(zero_value(Type::vector2).floats, (std::vector<float>{0, 0}));
  EXPECT_EQ(zero_value(Type::string).texts, std::vector<std::string>{""});
}

}  // namespace
}  // namespace nacre
