#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

const std::vector<float> some33{2, 1, -3, 0.5f, 4, 1, -1, 2, 0.25f};
const std::vector<float> some44{1, 2, 0, 1, -1, 3, 0.5f, 2, 4, 0, 1, -2, 0.25f, 1, -3, 5};

Type type_of(const std::vector<float>& m) {
  return m.size() == 9 ? Type::matrix33 : Type::matrix44;
}

std::vector<float> to_floats(const std::vector<double>& v) { return {v.begin(), v.end()}; }

std::vector<double> call(const char* category, const std::vector<float>& a,
                         const std::vector<float>& b = {}) {
  if (b.empty()) return call_node(category, {{"in", type_of(a), a}}, type_of(a));
  return call_node(category, {{"in1", type_of(a), a}, {"in2", type_of(b), b}}, type_of(a));
}

/// By permutations: the sum over all of them of signed products.
double leibniz(const std::vector<float>& m, int n) {
  std::vector<int> p(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) p[static_cast<std::size_t>(i)] = i;
  double sum = 0.0;
  do {
    int inversions = 0;
    double product = 1.0;
    for (int i = 0; i < n; ++i) {
      product *=
          static_cast<double>(m[static_cast<std::size_t>(i * n + p[static_cast<std::size_t>(i)])]);
      for (int j = 0; j < i; ++j) {
        inversions += p[static_cast<std::size_t>(j)] > p[static_cast<std::size_t>(i)];
      }
    }
    sum += inversions % 2 == 0 ? product : -product;
  } while (std::next_permutation(p.begin(), p.end()));
  return sum;
}

TEST(Matrix, DeterminantIsTheSumOverPermutations) {
  for (const auto& m : {some33, some44}) {
    const double det = call_node("determinant", {{"in", type_of(m), m}}, Type::float_).front();
    EXPECT_NEAR(det, leibniz(m, m.size() == 9 ? 3 : 4), 1e-12);
  }
}

TEST(Matrix, InverseTimesMatrixIsTheIdentity) {
  for (const auto& m : {some33, some44}) {
    const std::vector<float> inverse = to_floats(call("invertmatrix", m));
    const std::vector<double> product = call("multiply", m, inverse);
    const std::size_t n = m.size() == 9 ? 3 : 4;
    for (std::size_t i = 0; i < m.size(); ++i) {
      EXPECT_NEAR(product[i], i % (n + 1) == 0 ? 1.0 : 0.0, 1e-6) << i;
    }
    EXPECT_NEAR(call("divide", m, m)[0], 1.0, 1e-12);
  }
}

TEST(Matrix, InverseOfASingularMatrixIsTheIdentity) {
  const std::vector<float> singular{1, 2, 3, 2, 4, 6, 0, 1, 5};
  const std::vector<double> inverse = call("invertmatrix", singular);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(inverse[i], i % 4 == 0 ? 1.0 : 0.0);
}

TEST(Matrix, ProductAppliesTheFirstMatrixFirst) {
  // v (A B) = (v A) B for row vectors.
  const std::vector<float> v{1, -2, 0.5f};
  const std::vector<float> other{0, 1, 0, 3, 0, 0, 0, 0, 2};
  const auto transformed = [](const std::vector<float>& x, const std::vector<float>& m) {
    return call_node("transformmatrix", {{"in", Type::vector3, x}, {"mat", Type::matrix33, m}},
                     Type::vector3);
  };
  const std::vector<double> once = transformed(v, to_floats(call("multiply", some33, other)));
  const std::vector<double> twice = transformed(to_floats(transformed(v, some33)), other);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(once[i], twice[i], 1e-5);
  EXPECT_NEAR(transformed(v, some33)[0], 1 * 2 - 2 * 0.5 + 0.5 * -1, 1e-12);
}

TEST(Matrix, ShortVectorsAreTransformedAsPoints) {
  const std::vector<float> translate44{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  EXPECT_EQ(call_node("transformmatrix",
                      {{"in", Type::vector3, {1, 2, 3}}, {"mat", Type::matrix44, translate44}},
                      Type::vector3),
            (std::vector<double>{6, 8, 10}));
  const std::vector<float> translate33{1, 0, 0, 0, 1, 0, 5, 6, 1};
  EXPECT_EQ(call_node("transformmatrix",
                      {{"in", Type::vector2, {1, 2}}, {"mat", Type::matrix33, translate33}},
                      Type::vector2),
            (std::vector<double>{6, 8}));
}

TEST(Matrix, RowsMakeAMatrixAndComeOutOfIt) {
  const std::vector<Arg> rows{{"in1", Type::vector3, {1, 2, 3}},
                              {"in2", Type::vector3, {4, 5, 6}},
                              {"in3", Type::vector3, {7, 8, 9}},
                              {"in4", Type::vector3, {10, 11, 12}}};
  const std::vector<double> m = call_node("creatematrix", rows, Type::matrix44);
  EXPECT_EQ(m, (std::vector<double>{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 1}));
  const auto row = [&](float index) {
    return call_node("extract",
                     {{"in", Type::matrix44, to_floats(m)}, {"index", Type::integer, {index}}},
                     Type::vector4);
  };
  EXPECT_EQ(row(3), (std::vector<double>{10, 11, 12, 1}));
  EXPECT_EQ(row(-1), (std::vector<double>{1, 2, 3, 0}));
  EXPECT_EQ(row(99), row(3));
}

TEST(Matrix, TransposeSwapsRowsAndColumns) {
  EXPECT_EQ(call("transpose", some33), (std::vector<double>{2, 0.5, -1, 1, 4, 2, -3, 1, 0.25}));
}

}  // namespace
}  // namespace nacre
