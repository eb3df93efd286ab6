// Light profiles: what a file says, and what a luminaire emits, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "pbs/profile/ies.h"

namespace nacre {
namespace {

constexpr double pi_double = std::numbers::pi;

/// Angles from `first` to `last` in `steps` equal steps.
std::string angles(double first, double last, int steps) {
  std::string text;
  for (int i = 0; i <= steps; ++i) text += fmt::format("{} ", first + (last - first) * i / steps);
  return text + "\n";
}

/// A file without tilt, all factors 1.
std::string file(int type, const std::string& vertical, const std::string& horizontal,
                 const std::string& candela) {
  const auto count = [](const std::string& text) { return std::ranges::count(text, ' '); };
  return fmt::format(
      "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] nobody\nTILT=NONE\n1 -1 1 {} {} {} 2 0 0 0\n"
      "1 1 100\n{}{}{}",
      count(vertical), count(horizontal), type, vertical, horizontal, candela);
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

LightProfile parse(const std::string& text) {
  IesFault fault;
  const auto profile = parse_ies(text, fault);
  EXPECT_TRUE(profile) << fault.line << ": " << fault.message << ", " << fault.expected << ", "
                       << fault.found;
  return profile.value_or(LightProfile{});
}

TEST(LightProfile, AnglesAndFactorsAreRead) {
  const LightProfile profile = parse(
      "IESNA:LM-63-1995\r\n[X] y\r\nTILT=INCLUDE\r\n1\r\n3\r\n0 45 90\r\n1.0 .95 .9\r\n"
      "2 1000 10 3 2 1 1 0.1 0.1 0\r\n.5 1 60\r\n0, 45, 90\r\n0 90\r\n1 2 3\r\n4 5\r\n+6e0");
  EXPECT_EQ(profile.type, LightProfile::Type::c);
  EXPECT_EQ(profile.vertical, (std::vector<float>{0, 45, 90}));
  EXPECT_EQ(profile.horizontal, (std::vector<float>{0, 90}));
  EXPECT_EQ(profile.intensity, (std::vector<float>{5, 10, 15, 20, 25, 30}));
}

// The integral of |cos| over the sphere is 2 pi, over half of it pi; of cos^2 2 pi / 3.
TEST(LightProfile, EmittanceIsTheIntegral) {
  EXPECT_NEAR(emittance(parse(file(1, angles(0, 180, 2), "0 \n", "1 1 1"))), 2 * pi_double, 1e-5);
  EXPECT_NEAR(emittance(parse(file(1, angles(90, 180, 1), "0 \n", "1 1"))), pi_double, 1e-5);
  for (const auto& [first, last] : {std::pair{0, 90}, {0, 180}, {90, 270}, {0, 360}}) {
    const LightProfile even =
        parse(file(1, angles(0, 90, 3), angles(first, last, 4), repeated("2 2 2 2\n", 5)));
    EXPECT_NEAR(emittance(even), 2 * pi_double, 1e-5) << first << " " << last;
  }
  for (const int type : {2, 3}) {
    for (const int first : {0, -90}) {
      const LightProfile even =
          parse(file(type, angles(first, 90, 2), angles(first, 90, 2), repeated("1 1 1\n", 3)));
      EXPECT_NEAR(emittance(even), pi_double, 1e-5) << type << " " << first;
    }
  }
  std::string cosine;
  for (int i = 0; i <= 900; ++i) cosine += fmt::format("{}\n", std::cos(i * pi_double / 1800));
  EXPECT_NEAR(emittance(parse(file(1, angles(0, 90, 900), "0 \n", cosine))), 2 * pi_double / 3,
              1e-5);
}

struct Wrong {
  std::string text;
  int line;
  std::string message;
};

TEST(LightProfile, WrongFilesAreRefusedWhereTheyAreWrong) {
  const std::string head = "IESNA91\nTILT=NONE\n";
  const Wrong all[] = {
      {"", 1, "no light profile"},
      {"P6 1 1 255\n", 1, "no light profile"},
      {head, 3, "ends too early"},
      {head + "1 -1 1 2 1 1 2 0 0 0\n1 1 x", 4, "no number"},
      {head + "1 -1 1 2 1 1 2 0 0 0\n1 1 nan", 4, "no number"},
      {head + "1 -1 1 2.5 1 1 2 0 0 0\n", 3, "not whole"},
      {head + "1 -1 1 2 1 4 2 0 0 0\n", 3, "out of its range"},
      {head + "1 -1 1 99999 99999 1 2 0 0 0\n1 1 1\n", 4, "too many angles"},
      {head + "1 -1 1 3 1 1 2 0 0 0\n1 1 1\n0 90\n45\n0\n1 1 1", 6, "do not grow"},
      {head + "1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 80\n0\n1 1", 6, "vertical angles"},
      {head + "1 -1 1 2 2 1 2 0 0 0\n1 1 1\n0 90\n0 100\n1 1 1 1", 6, "horizontal angles"},
      {head + "1 -1 1 2 2 2 2 0 0 0\n1 1 1\n0 90\n-90 0\n1 1 1 1", 6, "types A and B"},
      {head + "1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n1 -1", 7, "out of its range"},
      {head + "1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n1\n", 8, "ends too early"},
      {"TILT=INCLUDE\n1 2 0 x", 2, "no number"},
  };
  for (const Wrong& wrong : all) {
    IesFault fault;
    EXPECT_FALSE(parse_ies(wrong.text, fault)) << wrong.text;
    EXPECT_NE(fault.message.find(wrong.message), std::string::npos) << wrong.text << "\n"
                                                                    << fault.message;
    EXPECT_EQ(fault.line, wrong.line) << wrong.text;
  }
}

}  // namespace
}  // namespace nacre
