#include <gtest/gtest.h>

#include <limits>

#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

const float nan = std::numeric_limits<float>::quiet_NaN();

double chosen(const std::string& category, Type type, float value1, float value2) {
  return call_node(category,
                   {{"value1", type, {value1}},
                    {"value2", type, {value2}},
                    {"in1", Type::float_, {10}},
                    {"in2", Type::float_, {20}}},
                   Type::float_)
      .front();
}

TEST(Conditional, ComparesFloatsAndIntegers) {
  for (const Type type : {Type::float_, Type::integer}) {
    EXPECT_EQ(chosen("ifgreater", type, 2, 1), 10.0);
    EXPECT_EQ(chosen("ifgreater", type, 1, 1), 20.0);
    EXPECT_EQ(chosen("ifgreatereq", type, 1, 1), 10.0);
    EXPECT_EQ(chosen("ifgreatereq", type, -3, 1), 20.0);
    EXPECT_EQ(chosen("ifequal", type, -3, -3), 10.0);
    EXPECT_EQ(chosen("ifequal", type, -3, 3), 20.0);
  }
}

TEST(Conditional, NothingHoldsForNaN) {
  for (const char* category : {"ifgreater", "ifgreatereq", "ifequal"}) {
    EXPECT_EQ(chosen(category, Type::float_, nan, 1), 20.0) << category;
    EXPECT_EQ(chosen(category, Type::float_, nan, nan), 20.0) << category;
  }
}

TEST(Conditional, TruthTables) {
  for (const float a : {0.0f, 1.0f}) {
    for (const float b : {0.0f, 1.0f}) {
      const auto of = [&](const char* category, const char* first, const char* second) {
        return call_node(category, {{first, Type::boolean, {a}}, {second, Type::boolean, {b}}},
                         Type::boolean)
            .front();
      };
      EXPECT_EQ(of("and", "in1", "in2"), a * b);
      EXPECT_EQ(of("or", "in1", "in2"), a + b - a * b);
      EXPECT_EQ(of("ifequal", "value1", "value2"), a == b);
      EXPECT_EQ(chosen("ifequal", Type::boolean, a, b), a == b ? 10.0 : 20.0);
    }
    EXPECT_EQ(call_node("not", {{"in", Type::boolean, {a}}}, Type::boolean).front(), 1.0f - a);
  }
}

TEST(Conditional, ChoosesWholeMatrices) {
  std::vector<float> first(9);
  std::vector<float> second(9);
  for (std::size_t i = 0; i < 9; ++i) {
    first[i] = static_cast<float>(i);
    second[i] = -first[i];
  }
  const std::vector<double> out = call_node("ifgreater",
                                            {{"value1", Type::float_, {0}},
                                             {"value2", Type::float_, {1}},
                                             {"in1", Type::matrix33, first},
                                             {"in2", Type::matrix33, second}},
                                            Type::matrix33);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(out[i], second[i]);
}

TEST(Channel, CombineKeepsTheOrderOfInputs) {
  const std::vector<Arg> args{{"in1", Type::vector2, {1, 2}}, {"in2", Type::vector2, {3, 4}}};
  EXPECT_EQ(call_node("combine2", args, Type::vector4), (std::vector<double>{1, 2, 3, 4}));
}

TEST(Channel, ExtractTakesTheNearestIndexThatExists) {
  const auto extract = [](float index) {
    return call_node("extract",
                     {{"in", Type::vector3, {5, 6, 7}}, {"index", Type::integer, {index}}},
                     Type::float_)
        .front();
  };
  EXPECT_EQ(extract(-4), 5.0);
  EXPECT_EQ(extract(0), 5.0);
  EXPECT_EQ(extract(1), 6.0);
  EXPECT_EQ(extract(2), 7.0);
  EXPECT_EQ(extract(100), 7.0);
}

TEST(Channel, ConvertGivesFloats) {
  EXPECT_EQ(call_node("convert", {{"in", Type::boolean, {1}}}, Type::float_).front(), 1.0);
  EXPECT_EQ(call_node("convert", {{"in", Type::integer, {-7}}}, Type::float_).front(), -7.0);
}

}  // namespace
}  // namespace nacre
