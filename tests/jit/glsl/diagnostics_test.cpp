// Wrong texts: what is said and where.
#include "tests/jit/glsl/run_text.h"

namespace nacre {
namespace {

struct Fault {
  std::string text;
  int line;
  std::string code;
};

TEST(GlslDiagnostics, SayWhatAndWhere) {
  const std::vector<Fault> faults{
      {"float f(float x) {\n return x +;\n}", 2, "glsl-syntax"},
      {"float f(float x) {\n return y;\n}", 2, "glsl-undefined"},
      {"float f(float x) {\n return vec2(x);\n}", 2, "glsl-type"},
      {"float f(float x) {\n return g(x);\n}", 2, "glsl-call"},
      {"float g(vec2 v) { return v.x; }\nfloat f(float x) {\n return g(x);\n}", 3, "glsl-call"},
      {"float f(float x) {\n vec2 v = vec2(x);\n return v.z;\n}", 3, "glsl-member"},
      {"float f(float x) {\n vec2 v = vec2(x);\n return v[2];\n}", 3, "glsl-index"},
      {"float f(float x) {\n 3.0 = x;\n return x;\n}", 2, "glsl-assignment"},
      {"float f(float x) {\n const float a = 1.0;\n a = x;\n return a;\n}", 3, "glsl-assignment"},
      {"float f(float x) {\n vec2 v;\n v.xx = vec2(x);\n return x;\n}", 3, "glsl-assignment"},
      {"float f(float x) {\n return vec3(x, x).x;\n}", 2, "glsl-constructor"},
      {"float f(float x) {\n if (x) return 1.0;\n return x;\n}", 2, "glsl-type"},
      {"float f(float x);\nfloat g(float x) { return x; }", 1, "glsl-undefined"},
      {"float f(float x) {\n return f(x);\n}", 2, "glsl-recursion"},
      {"float f(float x) {\n break;\n return x;\n}", 2, "glsl-syntax"},
      {"float f(float x) {\n discard;\n return x;\n}", 2, "glsl-unsupported"},
      {"uniform float u;\nfloat f(float x) { return u; }", 1, "glsl-unsupported"},
      {"sampler2D t;\nfloat f(float x) { return x; }", 1, "glsl-type"},
      {"uniform sampler2D t[2];\nfloat f(float x) { return x; }", 1, "glsl-type"},
      {"uniform sampler2D t = 1;\nfloat f(float x) { return x; }", 1, "glsl-type"},
      {"uniform sampler2D t;\nfloat f(float x) {\n return texture(t, vec2(x)).r;\n}", 3,
       "glsl-texture"},
      {"uniform sampler3D t;\nfloat f(float x) {\n return texture(t, vec2(x)).r;\n}", 3,
       "glsl-call"},
      {"float f(float x) {\n return 99999999999;\n}", 2, "glsl-number"},
      {"float f(float x) {\n return 1e99;\n}", 2, "glsl-number"},
      {"float f(float x) {\n return x\n}", 3, "glsl-syntax"},
      {"float f(float x) {\n return x;\n", 2, "glsl-syntax"},
      {"#if 1\nfloat f(float x) { return x; }", 2, "glsl-directive"},
      {"#include \"nowhere.glsl\"\nfloat f(float x) { return x; }", 1, "glsl-include"},
      {"#define A(x) x\nfloat f(float x) {\n return A(x, x);\n}", 3, "glsl-macro"},
      {"float f(float x) { return x; }\nfloat f(float x) { return x; }", 2, "glsl-redefined"},
      {"float f(float x) {\n float a[0];\n return x;\n}", 2, "glsl-array-size"},
      {"float f(float x) {\n float a[2] = float[2](x);\n return x;\n}", 2, "glsl-constructor"},
      {"void f(float x) {\n return x;\n}", 2, "glsl-type"},
      {"float f(float x) {\n return texture(x, vec2(x)).r;\n}", 2, "glsl-call"},
      {"float f(float x) {\n return x & 1;\n}", 2, "glsl-type"},
      {"float f(float x) {\n return \x01;\n}", 2, "glsl-syntax"},
      {std::string("float f(float x) { return\n") + std::string(5000, '(') + "x", 2,
       "glsl-too-deep"},
  };
  for (const Fault& fault : faults) {
    const TextRun run = run_text(fault.text, {{1.0f}});
    ASSERT_EQ(run.diagnostics.all().size(), 1u) << fault.text;
    const Diagnostic& first = run.diagnostics.all().front();
    EXPECT_EQ(first.code, fault.code) << fault.text << first.to_string();
    EXPECT_EQ(first.where.line, fault.line) << fault.text << first.to_string();
    EXPECT_EQ(first.where.file, "text.glsl") << fault.text;
  }
}

TEST(GlslDiagnostics, AnEmptyExpressionIsNone) {
  for (const char* text : {"", " ", "// nothing", ";"}) {
    Diagnostics diagnostics;
    EXPECT_EQ(
        glsl::Module::read_expression(glsl::Prelude::read(), {"a.mtlx", text, 7}, diagnostics),
        nullptr);
    ASSERT_EQ(diagnostics.all().size(), 1u) << text;
    EXPECT_EQ(diagnostics.all().front().code, "glsl-syntax");
    EXPECT_EQ(diagnostics.all().front().where.line, 7);
  }
}

/// Small texts that stand for enormous ones end soon, with an error.
TEST(GlslDiagnostics, BombsAreRefused) {
  std::string macros = "#define A0 1.0\n";
  for (int i = 1; i < 40; ++i) {
    macros += "#define A" + std::to_string(i) + " A" + std::to_string(i - 1) + " + A" +
              std::to_string(i - 1) + "\n";
  }
  TextRun run = run_text(macros + "float f(float x) { return x + A39; }", {{1.0f}});
  ASSERT_TRUE(run.diagnostics.has_errors());
  EXPECT_EQ(run.diagnostics.all().front().code, "glsl-too-large");

  std::string calls = "float g0(float x) { return sin(x); }\n";
  for (int i = 1; i < 25; ++i) {
    const std::string inner = "g" + std::to_string(i - 1);
    calls += "float g" + std::to_string(i) + "(float x) { return dFdx(" + inner + "(x) + " + inner +
             "(x + 1.0)); }\n";
  }
  run = run_text(calls + "float f(float x) { return g24(x); }", {{1.0f}});
  ASSERT_TRUE(run.diagnostics.has_errors());
  EXPECT_EQ(run.diagnostics.all().front().code, "too-many-operations");
}

}  // namespace
}  // namespace nacre
