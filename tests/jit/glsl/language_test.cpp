// The language: what each construct computes, against the same written in C++.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include "tests/jit/glsl/run_text.h"

namespace nacre {
namespace {

std::vector<float> numbers() {
  std::vector<float> values;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> range(-8.0f, 8.0f);
  for (int i = 0; i < 200; ++i) values.push_back(range(random));
  return values;
}

/// `float f(float x, float y) { body }` against a function of doubles.
void expect_same(const std::string& body, const std::function<double(double, double)>& wanted,
                 double tolerance = 1e-12) {
  const std::vector<float> xs = numbers();
  std::vector<float> ys = numbers();
  std::reverse(ys.begin(), ys.end());
  const auto got = results(fmt::format("float f(float x, float y)\n{{\n{}\n}}\n", body), {xs, ys});
  ASSERT_EQ(got.size(), xs.size()) << body;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const double expected = wanted(xs[i], ys[i]);
    EXPECT_NEAR(got[i], expected, tolerance * std::max(1.0, std::abs(expected)))
        << body << " at " << xs[i] << ", " << ys[i];
  }
}

TEST(GlslLanguage, OperatorsBindAsInC) {
  expect_same("return x + y * 2.0 - x / 4.0;",
              [](double x, double y) { return x + y * 2 - x / 4; });
  expect_same("return float(1 + 2 * 3 << 1 | 1);", [](double, double) { return 15; });
  expect_same("return x < y && y > 0.0 || x > 4.0 ? 1.0 : -1.0;",
              [](double x, double y) { return (x < y && y > 0) || x > 4 ? 1 : -1; });
  expect_same("return -x - -y;", [](double x, double y) { return -x + y; });
  expect_same("return float(7 & 12 ^ 3);", [](double, double) { return (7 & 12) ^ 3; });
  expect_same("float a = x, b; b = a = y; return a + b;", [](double, double y) { return 2 * y; });
}

TEST(GlslLanguage, WholeNumbersDivideTowardZero) {
  expect_same("int a = int(x * 1000.0), b = int(y); return float(a / b);", [](double x, double y) {
    const int a = static_cast<int>(x * 1000.0);
    const int b = static_cast<int>(y);
    return b == 0 ? 0 : a / b;
  });
  expect_same("int a = int(x * 1000.0), b = int(y); return float(a % b);", [](double x, double y) {
    const int a = static_cast<int>(x * 1000.0);
    const int b = static_cast<int>(y);
    return b == 0 ? 0 : a % b;
  });
}

/// Over the whole range of bits, where estimates in float are hardest.
TEST(GlslLanguage, NaturalNumbersDivideExactly) {
  std::mt19937 random(5);
  std::vector<float> highs;
  std::vector<float> lows;
  for (int i = 0; i < 2000; ++i) {
    highs.push_back(static_cast<float>(random() & 0xffffffu));
    lows.push_back(static_cast<float>(random() & 0xffffffu));
  }
  const std::string text = R"(
    float f(float high, float low) {
      uint h = uint(high), l = uint(low);
      uint a = (h << 8u) ^ l;
      uint b = ((l << 8u) ^ h) >> (h & 31u);
      if (b == 0u) b = 3u;
      uint q = a / b, r = a % b;
      return q * b + r == a && r < b ? 1.0 : 0.0;
    })";
  for (const double value : results(text, {highs, lows})) EXPECT_EQ(value, 1.0);
}

TEST(GlslLanguage, IntegersWrap) {
  expect_same("uint a = 0xffffffffu + uint(2); return float(a);", [](double, double) { return 1; });
  expect_same("int a = 0x7fffffff; a += 1; return a < 0 ? 1.0 : 0.0;",
              [](double, double) { return 1; });
  expect_same("return float(-8 >> 1) + float(uint(-8) >> 28u);",
              [](double, double) { return -4 + 15; });
}

TEST(GlslLanguage, ConstructorsAndSwizzles) {
  expect_same("vec4 v = vec4(x, vec2(y), 3); return dot(v.wzyx, vec4(1, 2, 3, 4));",
              [](double x, double y) { return 3 + 2 * y + 3 * y + 4 * x; });
  expect_same("vec3 v = vec3(1.0); v.zx = vec2(x, y); v.g *= 5.0; return v.r + 10.0 * v.y + v.b;",
              [](double x, double y) { return y + 50 + x; });
  expect_same("ivec2 i = ivec2(vec2(x, y)); return float(i.x - i.y);",
              [](double x, double y) { return std::trunc(x) - std::trunc(y); });
  expect_same("return vec3(vec4(x, y, 1, 2)).z + float(bvec2(true, false).x);",
              [](double, double) { return 2; });
}

TEST(GlslLanguage, MatricesAreColumns) {
  // m[1] is the second column; a vector on the right is a column.
  expect_same("mat2 m = mat2(1.0, 2.0, x, y); return (m * vec2(10.0, 1.0)).y + m[1].x;",
              [](double x, double y) { return 20 + y + x; });
  expect_same("mat2 m = mat2(1.0, 2.0, x, y); return (vec2(10.0, 1.0) * m).y;",
              [](double x, double y) { return 10 * x + y; });
  expect_same("mat3 m = mat3(2.0); m[2][0] = x; return determinant(m) + (inverse(m) * m)[2].x;",
              [](double, double) { return 8; });
  expect_same("mat2 a = mat2(1, 2, 3, 4), b = mat2(5, 6, 7, x); return (a * b)[1][1];",
              [](double x, double) { return 2 * 7 + 4 * x; });
  expect_same("return transpose(mat3(mat2(x, 1, y, 2)))[0][1] + mat4(3.0)[3][3];",
              [](double, double y) { return y + 3; });
}

TEST(GlslLanguage, StructuresAndArrays) {
  const std::string prefix = "struct Pair { float first; vec2 rest[2]; };\n";
  const auto got = results(prefix + R"(
    float f(float x, float y) {
      Pair a = Pair(x, vec2[2](vec2(1, 2), vec2(3, y)));
      Pair b = a;
      b.rest[1].y += 100.0;
      int i = x < 0.0 ? 0 : 1;
      float table[] = float[](10.0, 20.0, 30.0);
      table[i + 1] = 5.0;
      return a.rest[1].y + b.rest[1].y + b.rest[i].x + table[1] + table[2];
    })",
                           {{-1.0f, 2.0f}, {7.0f, 8.0f}});
  EXPECT_EQ(got, (std::vector<double>{7 + 107 + 1 + 5 + 30, 8 + 108 + 3 + 20 + 5}));
}

TEST(GlslLanguage, BranchesJoin) {
  expect_same(R"(
    float a = 1.0, b = 2.0;
    if (x < 0.0) { a = x; if (y < 0.0) b = y; else { b = 3.0; a += 1.0; } }
    else b = -1.0;
    return a + 10.0 * b;)",
              [](double x, double y) {
                double a = 1;
                double b = 2;
                if (x < 0) {
                  a = x;
                  if (y < 0) {
                    b = y;
                  } else {
                    b = 3;
                    a += 1;
                  }
                } else {
                  b = -1;
                }
                return a + 10 * b;
              });
}

/// A branch that costs enough to be a region of its own gives the same.
TEST(GlslLanguage, LargeBranchesJoin) {
  expect_same(
      R"(
    float a = x;
    if (x < y) {
      for (int i = 0; i < 70; ++i) { a = a * 0.5 + y; if (a > 9.0) a -= 3.0 * y; }
      if (a < 0.0) return a;
      a += 1.0;
    }
    return a * 2.0;)",
      [](double x, double y) {
        double a = x;
        if (x < y) {
          for (int i = 0; i < 70; ++i) {
            a = a * 0.5 + y;
            if (a > 9) a -= 3 * y;
          }
          if (a < 0) return a;
          a += 1;
        }
        return a * 2;
      },
      1e-9);
}

TEST(GlslLanguage, LoopsEndWhereTheySay) {
  expect_same("int n = int(abs(x)) , s = 0; for (int i = 0; i < n; ++i) s += i; return float(s);",
              [](double x, double) {
                const int n = static_cast<int>(std::abs(x));
                return n * (n - 1) / 2;
              });
  expect_same(
      "int n = int(abs(x)), s = 0; while (true) { if (s * s > n) break; s++; } "
      "return float(s);",
      [](double x, double) {
        int s = 0;
        while (s * s <= static_cast<int>(std::abs(x))) ++s;
        return s;
      });
  expect_same(
      "float s = 0.0; int i = 0; do { s += x; i++; if (s > 20.0) break; } "
      "while (float(i) < y); return s;",
      [](double x, double y) {
        double s = 0;
        int i = 0;
        do {
          s += x;
          ++i;
          if (s > 20) break;
        } while (i < y);
        return s;
      });
  expect_same(
      "float s = 0.0; for (int i = 0; i < 6; ++i) { if (float(i) < x) continue; "
      "for (int j = 0; j < 5; ++j) { if (float(j) > y) break; s += float(i + j); } } "
      "return s;",
      [](double x, double y) {
        double s = 0;
        for (int i = 0; i < 6; ++i) {
          if (i < x) continue;
          for (int j = 0; j < 5; ++j) {
            if (j > y) break;
            s += i + j;
          }
        }
        return s;
      });
}

/// A counter that outlives its loop keeps the value it had at the break.
TEST(GlslLanguage, CountersOutliveTheirLoop) {
  expect_same("int i; for (i = 0; i < 10; ++i) if (float(i) > x) break; return float(i);",
              [](double x, double) {
                int i = 0;
                for (; i < 10; ++i) {
                  if (i > x) break;
                }
                return i;
              });
}

TEST(GlslLanguage, ReturnsFromInsideLoops) {
  expect_same("for (int i = 0; i < 100; ++i) { x += 1.0; if (x > y) return x; } return -1.0;",
              [](double x, double y) {
                for (int i = 0; i < 100; ++i) {
                  x += 1;
                  if (x > y) return x;
                }
                return -1.0;
              });
}

/// A loop without end is ended, and nothing hangs.
TEST(GlslLanguage, EndlessLoopsAreBounded) {
  const auto got = results("float f(float x) { while (true) x += 1.0; return x; }", {{1.0f}});
  EXPECT_EQ(got, (std::vector<double>{1 + 1024}));
}

TEST(GlslLanguage, ParametersGoInAndOut) {
  const auto got = results(R"(
    void swap(inout float a, inout float b) { float t = a; a = b; b = t; }
    void make(float a, out vec2 v, out int n) { v = vec2(a, 2.0 * a); n = 3; a = 99.0; }
    float g(float a) { return 10.0 * a; }
    float g(vec2 a) { return a.x; }
    float g(int a) { return float(a); }
    float f(float x, float y) {
      vec4 v = vec4(0.0);
      int n;
      swap(x, y);
      make(x, v.zx, n);
      return x + 100.0 * v.x + 1000.0 * v.z + g(n) + g(1.0) + g(v.yz);
    })",
                           {{1.0f}, {2.0f}});
  EXPECT_EQ(got, (std::vector<double>{2 + 400 + 2000 + 3 + 10 + 0}));
}

/// && and || do not evaluate what they need not: here a change of a variable.
TEST(GlslLanguage, LogicLooksAhead) {
  expect_same(
      "float n = 0.0; bool a = x > 0.0 && (n += 1.0) > 0.0; "
      "bool b = y > 0.0 || (n += 10.0) > 0.0; return n + float(a) + float(b);",
      [](double x, double y) {
        return (x > 0 ? 1.0 : 0.0) + (y > 0 ? 0.0 : 10.0) + (x > 0 ? 1 : 0) + 1.0;
      });
}

TEST(GlslLanguage, MacrosAndConditions) {
  const auto got = results(R"(
    #define TWO 2.0
    #define SQUARE(a) ((a) * (a))
    #define BOTH(a, b) \
      SQUARE(a) + \
      SQUARE(b)
    #if defined(TWO) && !defined(THREE)
    #define CHOSEN 1.0
    #elif 1
    #define CHOSEN 2.0
    #endif
    #ifdef THREE
    this is no GLSL
    #endif
    const float table[2] = float[2](TWO, 4.0);  // A comment.
    /* Another. */
    float f(float x, float y) { return BOTH(x, y + 1.0) + CHOSEN + table[1]; })",
                           {{3.0f}, {4.0f}});
  EXPECT_EQ(got, (std::vector<double>{9 + 25 + 1 + 4}));
}

TEST(GlslLanguage, IncludesAreReadOnce) {
  glsl::PreprocessOptions options;
  options.find_include = [](const std::string& name,
                            const std::string& from) -> std::optional<glsl::Sources::File> {
    if (name == "a.glsl" && from == "text.glsl") return {{"a.glsl", "float a() { return 1.0; }"}};
    return std::nullopt;
  };
  const TextRun run =
      run_text("#include \"a.glsl\"\n#include \"a.glsl\"\nfloat f(float x) { return x + a(); }",
               {{1.0f}}, options);
  ASSERT_FALSE(run.diagnostics.has_errors()) << run.diagnostics.to_string();
  EXPECT_EQ(run.columns.at("result"), std::vector<double>{2});
}

TEST(GlslLanguage, BuiltinFunctions) {
  expect_same("return smoothstep(-1.0, 3.0, x) + step(y, x) + fract(x) + mod(x, 2.5);",
              [](double x, double y) {
                const double t = std::min(std::max((x + 1) / 4, 0.0), 1.0);
                return t * t * (3 - 2 * t) + (x < y ? 0 : 1) + x - std::floor(x) + x -
                       2.5 * std::floor(x / 2.5);
              });
  expect_same("return atan(y, x) + sinh(x / 4.0) + tanh(y) + inversesqrt(abs(x) + 1.0);",
              [](double x, double y) {
                return std::atan2(y, x) + std::sinh(x / 4) + std::tanh(y) +
                       1 / std::sqrt(std::abs(x) + 1);
              });
  expect_same(
      "vec3 i = normalize(vec3(x, y, -1)); vec3 n = vec3(0, 0, 1);"
      "return refract(i, n, 0.5).x + reflect(i, n).z + faceforward(n, i, n).z;",
      [](double x, double y) {
        const double size = std::sqrt(x * x + y * y + 1);
        return 0.5 * x / size + 1 / size + 1;
      });
  expect_same(
      "return float(floatBitsToInt(x) == floatBitsToInt(y)) + intBitsToFloat(0x40490fdb) +"
      "float(any(lessThan(vec2(x, 1), vec2(y, 0)))) + float(all(not(bvec2(false))));",
      [](double x, double y) { return 3.1415927410125732 + (x < y) + 1; });
  expect_same("return mix(x, y, 0.25) + clamp(x, -1.0, y < 0.0 ? 1.0 : 2.0) + float(sign(int(y)));",
              [](double x, double y) {
                const int whole = static_cast<int>(y);
                return 0.75 * x + 0.25 * y + std::min(std::max(x, -1.0), y < 0 ? 1.0 : 2.0) +
                       (whole > 0) - (whole < 0);
              });
}

/// What one text defines again or adds is its own, however many share a prelude.
TEST(GlslLanguage, TextsThatShareAPreludeAreApart) {
  const auto prelude = glsl::Prelude::read();
  const auto value = [&](const std::string& text) {
    Diagnostics diagnostics;
    const auto module = glsl::Module::read(prelude, {"text.glsl", text}, {}, diagnostics);
    EXPECT_NE(module, nullptr) << diagnostics.to_string();
    Recorder recorder;
    const auto result = module->record(*module->function("f"), {}, recorder, diagnostics);
    return result && result->value.parts[0].is_constant() ? result->value.number(0).constant()
                                                          : -1.0f;
  };
  const std::string own =
      "#define M_PI 3.0\n#undef mx_sin\nfloat mx_sin(float x) { return 7.0; }\n"
      "struct BSDF { float other; };\nfloat mx_square(float x) { return x; }\n"
      "float f() { return M_PI + mx_sin(0.0) + mx_square(5.0) + BSDF(1.0).other; }";
  const std::string plain =
      "float f() { return mx_square(5.0) + mx_sin(0.0) + BSDF(vec3(M_PI), vec3(1.0)).response.x; }";
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(value(own), 16.0f);
    EXPECT_EQ(value(plain), 25.0f + 3.14159265f);
  }
}

}  // namespace
}  // namespace nacre
