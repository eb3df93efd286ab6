// Small texts that stand for much work: macros that expand to nothing, constants, structures.
#include <ctime>

#include "tests/jit/glsl/run_text.h"

namespace nacre {
namespace {

/// The code of the one diagnostic, "" if there is none; it ends soon either way.
std::string fault_of(const std::string& text, const glsl::PreprocessOptions& options = {}) {
  const std::clock_t start = std::clock();
  const TextRun run = run_text(text, {{1.0f}}, options);
  // Of the processor, however busy the machine is; sanitizers take several times more.
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 20.0)
      << text.substr(0, 200);
  EXPECT_LE(run.diagnostics.all().size(), 1u) << run.diagnostics.to_string();
  if (run.diagnostics.all().empty()) return "";
  EXPECT_GT(run.diagnostics.all().front().where.line, 0);
  EXPECT_EQ(run.diagnostics.all().front().where.file, "text.glsl");
  return run.diagnostics.all().front().code;
}

std::string number(int i) { return std::to_string(i); }

/// Macros Z0 ... Z11 of which each stands for ten of the one before.
std::string tens(const std::string& first) {
  std::string text = first;
  for (int i = 1; i <= 11; ++i) {
    text += "#define Z" + number(i);
    for (int k = 0; k < 10; ++k) text += " Z" + number(i - 1);
    text += "\n";
  }
  return text;
}

const std::string last = "float f(float x) { return x; }\n";

TEST(GlslBombs, MacrosThatStandForNothing) {
  EXPECT_EQ(fault_of(tens("#define Z0\n") + "Z11\n" + last), "glsl-too-large");
  EXPECT_EQ(fault_of(tens("#define Z0\n") + "#if Z11 1\n#endif\n" + last), "glsl-too-large");
  EXPECT_EQ(fault_of(tens("#define Z0\n") + "#if 0\n#elif Z11 1\n#endif\n" + last),
            "glsl-too-large");
  EXPECT_EQ(fault_of(tens("#define N(x)\n#define Z0 N(1)\n") + "Z11\n" + last), "glsl-too-large");
  EXPECT_EQ(fault_of("#define E\n#define D(x) x x x x x x x x x x\n"
                     "float f(float x) { return D(D(D(D(D(D(D(D(D(D(E)))))))))) x; }"),
            "glsl-too-large");
  // Each line for itself is within every limit.
  std::string lines = tens("#define Z0\n");
  for (int i = 0; i < 2000; ++i) lines += "#if Z4 1\n#endif\n";
  EXPECT_EQ(fault_of(lines + last), "glsl-too-large");
}

TEST(GlslBombs, MacrosThatAreNotReplaced) {
  // A function-like macro without arguments stays; its body must not be copied each time.
  std::string text = "#define F(x)";
  for (int i = 0; i < 100'000; ++i) text += " x";
  text += "\n#define G(y)";
  for (int i = 0; i < 50'000; ++i) text += " F";
  EXPECT_EQ(fault_of(text + "\n" + last + "const int g = 0; G(1)\n"), "glsl-syntax");
  std::string parameters = "#define P(p0";
  for (int i = 1; i < 300; ++i) parameters += ", p" + number(i);
  EXPECT_EQ(fault_of(parameters + ") p0\n" + last), "glsl-macro");
}

TEST(GlslBombs, HonestMacrosPass) {
  EXPECT_EQ(fault_of(tens("#define Z0\n") + "Z5\n#if Z5 1\n" + last + "#endif\n"), "");
}

TEST(GlslBombs, ConditionsWithinConditions) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "#if 1\n";
  text += last;
  for (int i = 0; i < 100'000; ++i) text += "#endif\n";
  EXPECT_EQ(fault_of(text), "");
}

TEST(GlslBombs, TextsOfManyFiles) {
  glsl::PreprocessOptions options;
  options.find_include = [](const std::string& name, const std::string&) {
    std::string text = name == "same" ? "" : "// " + std::string(1'000'000, '.') + "\n";
    return std::optional(glsl::Sources::File{name, std::move(text)});
  };
  std::string text;
  for (int i = 0; i < 20; ++i) text += "#include \"" + number(i) + "\"\n";
  TextRun run = run_text(text + last, {{1.0f}}, options);
  ASSERT_EQ(run.diagnostics.all().size(), 1u);
  EXPECT_EQ(run.diagnostics.all().front().code, "glsl-too-large");
  // A file that is read already is looked for again.
  text.clear();
  for (int i = 0; i < 100'000; ++i) text += "#include \"same\"\n";
  EXPECT_EQ(fault_of(text + last, options), "glsl-too-large");
}

TEST(GlslBombs, ConstantsOfConstants) {
  std::string text = "const int c0 = 1;\n";
  for (int i = 1; i < 64; ++i) {
    const std::string before = "c" + number(i - 1);
    text += "const int c" + number(i) + " = " + before + " + " + before + ";\n";
  }
  EXPECT_EQ(fault_of(text + "float f(float x) { float a[c63]; return x; }"), "glsl-array-size");
  EXPECT_EQ(fault_of(text + "float f(float x) { float a[c5]; return x; }"), "");
  EXPECT_EQ(fault_of(text + "float f(float x) { return x * float(c40); }"), "too-many-operations");
}

TEST(GlslBombs, StructuresOfStructures) {
  std::string text = "struct S0 { sampler2D s; };\n";
  for (int i = 1; i < 64; ++i) {
    const std::string before = "S" + number(i - 1);
    text += "struct S" + number(i) + " { " + before + " a; " + before + " b; };\n";
  }
  EXPECT_EQ(fault_of(text + last), "glsl-too-large");
  std::string wide = "struct W { float a[4096]; };\nstruct V { W w[4096];";
  EXPECT_EQ(fault_of(wide + " };\n" + last), "glsl-too-large");
  EXPECT_EQ(fault_of("struct W { float a[4096]; };\n"
                     "float f(float x, out W w[4096]) { return x; }"),
            "glsl-too-large");
  EXPECT_EQ(fault_of("float f(float x) { mat4 a[4096]; mat4 b[4096]; return x; }"), "");
  std::string many = "float f(float x) {\n";
  for (int i = 0; i < 100; ++i) many += "mat4 m" + number(i) + "[4096];\n";
  EXPECT_EQ(fault_of(many + "return x; }"), "glsl-too-large");
}

TEST(GlslBombs, IndicesThatAreNotLiteral) {
  // Each one chooses among 4,096 elements: few letters, many operations, in one function.
  std::string text = "float f(float x) { float a[4096]; a[int(x)] = x; float s = 0.0;\n";
  for (int i = 0; i < 2000; ++i) text += "s += a[int(x + " + number(i) + ".5)];\n";
  EXPECT_EQ(fault_of(text + "return s; }"), "too-many-operations");
}

}  // namespace
}  // namespace nacre
