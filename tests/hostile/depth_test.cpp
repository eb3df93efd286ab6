// Texts that nest as deeply as they are long, on a stack of 256 KB: no depth of an input is a
// depth of calls beyond a limit, which is said.
#include <gtest/gtest.h>
#include <pthread.h>

#include <functional>

#include "jit/shading/shading_system.h"
#include "tests/support/sanitizer.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

#if defined(NDEBUG)
constexpr std::size_t plain_stack_bytes = std::size_t{256} << 10;
#else
constexpr std::size_t plain_stack_bytes = std::size_t{1} << 20;
#endif
constexpr std::size_t stack_bytes = is_sanitized ? std::size_t{2} << 20 : plain_stack_bytes;

/// The data library is read once for all tests, on the stack of the first.
ShadingSystem& standard_system() {
  static const std::unique_ptr<ShadingSystem> made = [] {
    Diagnostics diagnostics;
    SystemOptions options;
    options.libraries = {standard_library_folder()};
    return ShadingSystem::create(options, diagnostics);
  }();
  return *made;
}

void on_small_stack(const std::function<void()>& body) {
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, stack_bytes), 0);
  pthread_t thread;
  const auto run = [](void* data) -> void* {
    (*static_cast<const std::function<void()>*>(data))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, run, const_cast<std::function<void()>*>(&body)),
            0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else if (c == '\n') {
      result += "&#10;";
    } else {
      result += c;
    }
  }
  return result;
}

/// A node "t" with input x that a text implements; `function` empty: the text is an expression.
std::string implemented_by(const std::string& text, const std::string& function) {
  return "<materialx version=\"1.39\"><nodedef name=\"ND_t\" node=\"t\">"
         "<input name=\"x\" type=\"float\" value=\"1\"/><output name=\"out\" type=\"float\"/>"
         "</nodedef><implementation name=\"I\" nodedef=\"ND_t\" target=\"nacre\" " +
         (function.empty() ? "" : "function=\"" + function + "\" ") + "sourcecode=\"" +
         escaped(text) +
         "\"/><texcoord name=\"uv\" type=\"vector2\"/><extract name=\"u\" type=\"float\">"
         "<input name=\"in\" type=\"vector2\" nodename=\"uv\"/></extract>"
         "<t name=\"n\" type=\"float\"><input name=\"x\" type=\"float\" nodename=\"u\"/></t>"
         "<output name=\"o\" type=\"float\" nodename=\"n\"/></materialx>";
}

struct Outcome {
  bool compiled = false;
  float value = 0;
  Diagnostics diagnostics;
};

/// Checks the document, makes a kernel of its output and runs it at u = 0.5.
Outcome outcome_of(const std::string& text) {
  Outcome outcome;
  ShadingSystem& system = standard_system();
  on_small_stack([&] {
    const auto document = read_document_text(text, "a.mtlx", {}, outcome.diagnostics);
    if (document == nullptr) return;
    ShaderOptions options;
    options.compile.backend = Backend::interpreter;
    system.check(*document, options, outcome.diagnostics);
    Diagnostics again;
    const auto kernel = system.compile_outputs(*document, {"o"}, options, again);
    EXPECT_EQ(kernel == nullptr, outcome.diagnostics.has_errors())
        << outcome.diagnostics.to_string().substr(0, 300) << again.to_string().substr(0, 300);
    if (kernel == nullptr) return;
    const std::vector<float> u(8, 0.5f);
    const std::vector<const void*> in(kernel->kernel.program().inputs.size(), u.data());
    const std::vector<void*> out{&outcome.value};
    EXPECT_EQ(kernel->kernel.run(in, out, 1), RunStatus::done);
    outcome.compiled = true;
  });
  return outcome;
}

std::string repeated(const std::string& text, int count) {
  std::string result;
  result.reserve(text.size() * static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

constexpr int many = 100'000;

struct Chain {
  const char* name;
  std::string text;
  std::string function;
  float value;
};

/// What leans to the left is no deeper for being long.
TEST(Depth, ChainsOfAnyLength) {
  const std::vector<Chain> chains{
      {"sum", "1.0" + repeated("+ 1.0", many) + " + {{x}}", "", many + 1.5f},
      {"sum of inputs", "{{x}}" + repeated("+{{x}}", many), "", (many + 1) * 0.5f},
      {"sequence", repeated("{{x}},", many) + "{{x}}", "", 0.5f},
      {"swizzles", "{{x}}" + repeated(".x", many), "", 0.5f},
      {"signs", repeated("- ", many) + "{{x}}", "", 0.5f},
      {"nots", "(" + repeated("! ", many) + "({{x}} > 0.0)) ? 1.0 : 0.0", "", 1.0f},
      {"precedences", "0.0" + repeated("+ 1.0 * {{x}} - 1.0 * {{x}}", many / 4), "", 0.0f},
      {"ands", "(true" + repeated("&& {{x}} > 0.0", many) + ") ? 1.0 : 0.0", "", 1.0f},
      {"assignments to parts",
       "void f(float x, out float r) { vec2 v; v" + repeated(".xy", many) +
           " = vec2(x); r = v.y; }",
       "f", 0.5f},
      {"sizes",
       "void f(float x, out float r) { float a[1" + repeated("+ 1 - 1", many) +
           "]; a[0] = x; r = a[0]; }",
       "f", 0.5f},
      {"statements", "void f(float x, out float r) { r = 0.0; " + repeated("r += x;", many) + " }",
       "f", many * 0.5f},
      {"declarations",
       "void f(float x, out float r) { r = x; " + repeated("{ float y = r; r = y; }", many / 4) +
           " }",
       "f", 0.5f},
      {"lookups by constants",
       "void f(float x, out float r) { mat2 m[2]; m[1][1] = vec2(x); r = 0.0; " +
           repeated("r = m[1][1][0];", many / 4) + " }",
       "f", 0.5f},
  };
  for (const Chain& chain : chains) {
    const Outcome outcome = outcome_of(implemented_by(chain.text, chain.function));
    EXPECT_FALSE(outcome.diagnostics.has_errors())
        << chain.name << outcome.diagnostics.to_string().substr(0, 500);
    EXPECT_TRUE(outcome.compiled) << chain.name;
    EXPECT_EQ(outcome.value, chain.value) << chain.name;
  }
}

/// What nests has a limit, and below it room on the stack: as deep as it goes, and then far
/// too deep.
TEST(Depth, NestsHaveALimit) {
  struct Nest {
    const char* name;
    std::string before, open, middle, close, after;
    std::string function;
  };
  const std::string begin = "void f(float x, out float r) { r = x; ";
  const std::vector<Nest> nests{
      {"parentheses", "", "(", "{{x}}", ")", "", ""},
      {"sums to the right", "", "{{x}} + (", "{{x}}", ")", "", ""},
      {"all operators", "", "1 | 1 ^ 1 & int(1 == 1 << 1 + 1 * (", "1", "))", "", ""},
      {"calls", "", "sin(", "{{x}}", ")", "", ""},
      {"constructors", "", "vec2(", "{{x}}", ").x", "", ""},
      {"conditionals", "", "{{x}} > 0.0 ? {{x}} : ", "{{x}}", "", "", ""},
      {"conditionals in the middle", "", "{{x}} > 0.0 ? ", "{{x}}", " : 0.0", "", ""},
      {"lazy ands", "", "({{x}} > 0.0 && sin(cos(sin(cos(sin(cos(sin({{x}}))))))) > 0.0 && ",
       "true", ")", " ? 1.0 : 0.0", ""},
      {"indices", begin + "float a[2]; r += a[", "int(a[", "0", "])", "]; }", "f"},
      {"assignments", begin, "r = ", "x", "", "; }", "f"},
      {"blocks", begin, "{", "r += x;", "}", " }", "f"},
      {"ifs", begin, "if (r > 0.0) {", "r += x;", "}", " }", "f"},
      {"costly ifs", begin, "if (r > 0.0) { r = sin(sin(sin(sin(sin(sin(sin(r)))))));", "r += x;",
       "}", " }", "f"},
      {"ifs without braces", begin, "if (r > 0.0) ", "r += x;", "", " }", "f"},
      {"else ifs", begin, "if (r > x) { r = sin(r) * sin(r) + sin(r) * sin(r); } else ", "r += x;",
       "", " }", "f"},
      {"loops", begin, "for (int i = 0; i < int(x); i++) {", "r += x;", "}", " }", "f"},
      {"unrolled loops", begin, "for (int i = 0; i < 1; i++) {", "r += x;", "}", " }", "f"},
      {"dos", begin, "do {", "r += x;", "} while (r > 10.0);", " }", "f"},
      {"lists", begin + "float a[1] = ", "{", "x", "}", "; }", "f"},
      {"early returns", "float g(float x) { float r = x;",
       "if (r > x) return r; r = sin(r) * sin(r) + sin(r) * sin(r) + sin(r) * sin(r);", "return r;",
       "", "}\nvoid f(float x, out float r) { r = g(x); }", "f"},
  };
  for (const Nest& nest : nests) {
    const auto outcome = [&](int depth) {
      return outcome_of(implemented_by(nest.before + repeated(nest.open, depth) + nest.middle +
                                           repeated(nest.close, depth) + nest.after,
                                       nest.function));
    };
    // As an author might write it by hand.
    const Outcome few = outcome(10);
    const std::string said = few.diagnostics.to_string();
    EXPECT_TRUE(few.compiled || said.find("glsl-constructor") != std::string::npos ||
                said.find("glsl-type") != std::string::npos)
        << nest.name << said.substr(0, 500);
    // To the deepest that passes, where the most stack is used.
    int deepest = 10;
    for (const int step : {20, 4, 1}) {
      while (deepest < 400 && outcome(deepest + step).compiled) deepest += step;
    }
    EXPECT_LT(deepest, 400) << nest.name;
    for (const int depth : {1000, many}) {
      const Outcome far = outcome(depth);
      ASSERT_EQ(far.diagnostics.error_count(), 1u)
          << nest.name << far.diagnostics.to_string().substr(0, 500);
      const Diagnostic& fault = far.diagnostics.all().front();
      EXPECT_TRUE(fault.code == "glsl-too-deep" || fault.code == "glsl-too-large" ||
                  fault.code == "too-many-operations" || fault.code == "glsl-constructor")
          << nest.name << fault.to_string();
      EXPECT_EQ(fault.where.file, "a.mtlx") << nest.name;
      EXPECT_GT(fault.where.line, 0) << nest.name;
      EXPECT_EQ(fault.where.path, "I") << nest.name;
    }
  }
}

/// Levels of calls times levels within each: the depth of recording is of all together.
TEST(Depth, NestsInCalls) {
  for (const int inside : {1, 5, 20, 80}) {
    for (const char* const begin :
         {"if (x > 0.1) {", "{", "x = x + (", "for (int i = 0; i < int(x); i++) {"}) {
      const std::string open = begin;
      const bool is_sum = open.back() == '(';
      std::string text = "float g0(float x) { return sin(x); }\n";
      for (int i = 1; i < 60; ++i) {
        const std::string inner = "g" + std::to_string(i - 1) + "(x)";
        text += "float g" + std::to_string(i) + "(float x) {" + repeated(open, inside) +
                (is_sum ? inner : "x = " + inner + ";") + repeated(is_sum ? ")" : "}", inside) +
                "; return x; }\n";
      }
      const Outcome outcome =
          outcome_of(implemented_by(text + "void f(float x, out float r) { r = g59(x); }", "f"));
      const std::string said = outcome.diagnostics.to_string();
      EXPECT_TRUE(outcome.compiled || said.find("glsl-too-deep") != std::string::npos ||
                  said.find("too-many") != std::string::npos)
          << open << inside << said.substr(0, 500);
    }
  }
}

TEST(Depth, GlobalsOfGlobals) {
  std::string text = "const float c0 = 1.0;\n";
  for (int i = 1; i <= 2000; ++i) {
    text += "const float c" + std::to_string(i) + " = c" + std::to_string(i - 1) + " + 1.0;\n";
  }
  const Outcome outcome =
      outcome_of(implemented_by(text + "void f(float x, out float r) { r = x * c2000; }", "f"));
  ASSERT_EQ(outcome.diagnostics.error_count(), 1u) << outcome.diagnostics.to_string();
  EXPECT_EQ(outcome.diagnostics.all().front().code, "glsl-too-deep");
}

/// The preprocessor's own recursions at their limits, within one another.
TEST(Depth, Preprocessor) {
  std::string macros = "#define M0(x) x\n";
  for (int i = 1; i <= 200; ++i) {
    macros += "#define M" + std::to_string(i) + "(x) M" + std::to_string(i - 1) + "(x)\n";
  }
  const std::string tail = "void f(float x, out float r) { r = x; }\n";
  for (const std::string& text : {
           macros + "#if M60(1)\n#endif\n",
           macros + "#if M200(1)\n#endif\n",
           macros + "#if " + repeated("(", 60) + "M60(1)" + repeated(")", 60) + "\n#endif\n",
           "#if " + repeated("(", many) + "1" + repeated(")", many) + "\n#endif\n",
           "#if " + repeated("! ", many) + "1\n#endif\n",
           "#if " + repeated("- ", many) + "1\n#endif\n",
           "#if 1" + repeated(" + 1", many) + "\n#endif\n",
           "#define A(x) x\n#if " + repeated("A(", many) + "1" + repeated(")", many) + "\n#endif\n",
           repeated("#if 1\n", many) + repeated("#endif\n", many),
       }) {
    const Outcome outcome = outcome_of(implemented_by(text + tail, "f"));
    EXPECT_LE(outcome.diagnostics.error_count(), 1u);
    EXPECT_TRUE(outcome.compiled || outcome.diagnostics.has_errors());
  }
}

/// Conditionals of the graph within one another, a deep text in the innermost.
TEST(Depth, ConditionalNodes) {
  std::string text =
      "<materialx version=\"1.39\"><nodedef name=\"ND_t\" node=\"t\"><input name=\"x\" "
      "type=\"float\" value=\"1\"/><output name=\"out\" type=\"float\"/></nodedef>"
      "<implementation name=\"I\" nodedef=\"ND_t\" target=\"nacre\" sourcecode=\"" +
      repeated("sin(", 60) + "{{x}}" + repeated(")", 60) +
      "\"/><texcoord name=\"uv\" type=\"vector2\"/><extract name=\"u\" type=\"float\">"
      "<input name=\"in\" type=\"vector2\" nodename=\"uv\"/></extract>"
      "<t name=\"c0\" type=\"float\"><input name=\"x\" type=\"float\" nodename=\"u\"/></t>";
  for (int i = 1; i <= 1000; ++i) {
    const std::string number = std::to_string(i);
    text += "<fractal3d name=\"a" + number + "\" type=\"float\"/><ifgreater name=\"c" + number +
            "\" type=\"float\"><input name=\"value1\" type=\"float\" nodename=\"u\"/><input "
            "name=\"value2\" type=\"float\" value=\"0." +
            number + "\"/><input name=\"in1\" type=\"float\" nodename=\"a" + number +
            "\"/><input name=\"in2\" type=\"float\" nodename=\"c" + std::to_string(i - 1) +
            "\"/></ifgreater>";
  }
  const Outcome outcome =
      outcome_of(text + "<output name=\"o\" type=\"float\" nodename=\"c1000\"/></materialx>");
  EXPECT_TRUE(outcome.compiled) << outcome.diagnostics.to_string().substr(0, 500);
}

}  // namespace
}  // namespace nacre
