// Texts that would make kernels run without end: refused, or ended by the run itself; and
// faults of texts, which are said once, with file, line and path.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

#include "jit/shading/shading_system.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

ShadingSystem& standard_system() {
  static const std::unique_ptr<ShadingSystem> made = [] {
    Diagnostics diagnostics;
    SystemOptions options;
    options.libraries = {standard_library_folder()};
    return ShadingSystem::create(options, diagnostics);
  }();
  return *made;
}

/// `count` nodes of a nodedef without inputs that an expression implements.
std::string without_inputs(const std::string& expression, int count = 1) {
  std::string text =
      "<materialx version=\"1.39\">\n<nodedef name=\"ND_q\" node=\"q\"><output name=\"out\" "
      "type=\"float\"/></nodedef>\n<implementation name=\"IM\" nodedef=\"ND_q\" target=\"nacre\" "
      "sourcecode=\"" +
      expression + "\"/>\n";
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    text += "<q name=\"n" + number + "\" type=\"float\"/><output name=\"o" + number +
            "\" type=\"float\" nodename=\"n" + number + "\"/>";
  }
  return text + "</materialx>";
}

/// The same with an input x.
std::string with_input(const std::string& expression) {
  std::string text = without_inputs(expression);
  const std::string place = "<output name=\"out\"";
  return text.replace(text.find(place), 0, "<input name=\"x\" type=\"float\" value=\"1\"/>");
}

Diagnostics checked(const std::string& text) {
  Diagnostics diagnostics;
  const auto document = read_document_text(text, "a.mtlx", {}, diagnostics);
  if (document != nullptr) standard_system().check(*document, {}, diagnostics);
  return diagnostics;
}

TEST(FaultsOfTexts, AreSaidOnceWithFileLineAndPath) {
  const std::string braces = "{{y}}";
  struct Fault {
    std::string document;
    const char* code;
  };
  const std::vector<Fault> faults{
      {without_inputs("nope + 1.0"), "glsl-undefined"},
      {without_inputs("nope"), "glsl-undefined"},
      {without_inputs("nope.x"), "glsl-undefined"},
      {without_inputs("sin(nope)"), "glsl-undefined"},
      {without_inputs("nope = 1.0"), "glsl-undefined"},
      {without_inputs("nope++"), "glsl-undefined"},
      {without_inputs("true &amp;&amp; nope"), "glsl-undefined"},
      {without_inputs("true ? nope : 1.0"), "glsl-undefined"},
      {without_inputs(braces), "glsl-undefined"},
      {without_inputs("nope(1.0)"), "glsl-call"},
      {without_inputs("1.0 +"), "glsl-syntax"},
      {without_inputs("vec2(1.0)"), "source-misfit"},
      {without_inputs("nope + 1.0", 50), "glsl-undefined"},
      {with_input("{{x}} + {{y}}"), "glsl-undefined"},
      {with_input("{{x}} + y"), "glsl-undefined"},
      {with_input("{{x}}.y"), "glsl-member"},
      {with_input("{{x}} + vec2(1.0)"), "source-misfit"},
      {with_input("{{x}} +"), "glsl-syntax"},
  };
  for (const Fault& fault : faults) {
    const Diagnostics diagnostics = checked(fault.document);
    ASSERT_EQ(diagnostics.all().size(), 1u) << fault.document << diagnostics.to_string();
    const Diagnostic& said = diagnostics.all().front();
    EXPECT_EQ(said.code, fault.code) << said.to_string();
    EXPECT_EQ(said.where.file, "a.mtlx") << said.to_string();
    EXPECT_EQ(said.where.line, 3) << said.to_string();
    EXPECT_EQ(said.where.path, "IM") << said.to_string();
  }
}

/// A node "t" of function f(float, out float), or of f(float) that returns, over all points.
std::unique_ptr<OutputKernel> compiled(const std::string& source, const ShaderOptions& options,
                                       Diagnostics& diagnostics) {
  std::string text;
  for (const char c : source) text += c == '<' ? std::string("&lt;") : std::string(1, c);
  const auto document = read_document_text(
      "<materialx version=\"1.39\"><nodedef name=\"ND_t\" node=\"t\"><input name=\"x\" "
      "type=\"float\" value=\"1\"/><output name=\"out\" type=\"float\"/></nodedef>"
      "<implementation name=\"I\" nodedef=\"ND_t\" target=\"nacre\" function=\"f\" sourcecode=\"" +
          text +
          "\"/><texcoord name=\"uv\" type=\"vector2\"/><extract name=\"u\" type=\"float\">"
          "<input name=\"in\" type=\"vector2\" nodename=\"uv\"/></extract>\n"
          "<t name=\"n\" type=\"float\"><input name=\"x\" type=\"float\" nodename=\"u\"/></t>"
          "<output name=\"o\" type=\"float\" nodename=\"n\"/></materialx>",
      "a.mtlx", {}, diagnostics);
  return standard_system().compile_outputs(*document, {"o"}, options, diagnostics);
}

std::string loops(int depth, int rounds, const std::string& body) {
  std::string text = "float f(float x) { float s = x;\n";
  for (int i = 0; i < depth; ++i) {
    const std::string name = "i" + std::to_string(i);
    text += "for (int " + name + " = 0; " + name + " < " + std::to_string(rounds) + "; " + name +
            "++) ";
  }
  return text + body + " return s; }";
}

std::string calls(int depth, const std::string& body) {
  std::string text = "float g0(float x) {" + body + "}\n";
  for (int i = 1; i <= depth; ++i) {
    const std::string before = "g" + std::to_string(i - 1);
    text += "float g" + std::to_string(i) + "(float x) { return " + before + "(x)+" + before +
            "(x*1.1); }\n";
  }
  return text + "float f(float x) { return g" + std::to_string(depth) + "(x); }";
}

const std::string body = "s = fract(s * 1.1 + 0.3);";

std::vector<std::string> endless() {
  return {
      loops(3, 1024, body),
      loops(2, 1024, body),
      loops(6, 64, body),
      loops(60, 2, "{" + body + "}"),
      loops(1, 5000, body),
      "float f(float x) { float s = x; while (true) " + body + " return s; }",
      "float f(float x) { float s = x; do " + body + " while (s >= 0.0); return s; }",
      "float f(float x) { float s = x; for (;;) for (;;) " + body + " return s; }",
      "float f(float x) { float s = x; for (float a = 0.0; a < 1.0; a += x * 1e-9) " + body +
          " return s; }",
      "float f(float x) { float s = x; int n = int(x) + 900; for (int i = 0; i < n; i++) "
      "for (int j = 0; j < n; j++) for (int k = 0; k < n; k++) " +
          body + " return s; }",
      calls(38, "return x;"),
      calls(25, "return sin(x);"),
      calls(35, "return fract(x * 1.1);"),
      calls(12, "float s = x; for (int i = 0; i < 1000; i++) " + body + " return s;"),
      calls(20, "if (x > 0.5) { return sin(x); } return x;"),
  };
}

TEST(EndlessKernels, EndWithAWordInEveryEngine) {
  for (const std::string& text : endless()) {
    for (const Backend backend : {Backend::jit, Backend::interpreter, Backend::reference}) {
      const std::clock_t start = std::clock();
      ShaderOptions options;
      options.compile.backend = backend;
      Diagnostics diagnostics;
      const auto kernel = compiled(text, options, diagnostics);
      if (kernel == nullptr) {
        ASSERT_EQ(diagnostics.error_count(), 1u) << text << diagnostics.to_string();
        const Diagnostic& said = diagnostics.all().front();
        // Loops that are unrolled are too many for the recording, at their place in the text.
        const bool in_text = said.code == "too-many-operations";
        EXPECT_TRUE(in_text || said.code == "too-many-steps") << said.to_string();
        EXPECT_EQ(said.where.path, in_text ? "I" : "n") << said.to_string();
        EXPECT_EQ(said.where.line, in_text ? 1 : 2 + std::count(text.begin(), text.end(), '\n'))
            << said.to_string();
        EXPECT_EQ(said.where.file, "a.mtlx") << said.to_string();
      } else {
        const std::vector<float> u(100, 0.5f);
        std::vector<float> results(100);
        const std::vector<const void*> in(kernel->kernel.program().inputs.size(), u.data());
        const std::vector<void*> out{results.data()};
        EXPECT_EQ(kernel->kernel.run(in, out, 100), RunStatus::too_many_steps)
            << text << static_cast<int>(backend);
      }
      // Of the processor, however busy the machine is; sanitizers take several times more.
      EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 20.0) << text;
    }
  }
}

/// All engines agree on which points end, and on their bits.
TEST(EndlessKernels, ThoseThatEndDoSoInEveryEngine) {
  const std::vector<std::string> texts{
      loops(3, 16, body),
      loops(2, 200, body),
      "float f(float x) { float s = x; int n = int(x * 8.0) + 3; for (int i = 0; i < n; i++) "
      "for (int j = 0; j < n; j++) for (int k = 0; k < n; k++) " +
          body + " return s; }",
      "float h(float x) { float n = 0.0; while (x < 100.0) { x *= 2.0; n += 1.0; } return n; }\n"
      "float f(float x) { if (x > 0.25) return h(x); return -1.0; }",
      "float f(float x) { float s = x; for (int i = 0; i < 900; i++) { if (s > 0.9) break; " +
          body + " } return s; }",
      calls(8, "float s = x; for (int i = 0; i < 9; i++) " + body + " return s;"),
  };
  std::vector<float> u(45);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = static_cast<float>(i) / 44.0f;
  for (const std::string& text : texts) {
    std::vector<std::vector<float>> all;
    const auto run = [&](Backend backend, int lanes) {
      ShaderOptions options;
      options.compile.backend = backend;
      options.compile.lanes = lanes;
      Diagnostics diagnostics;
      const auto kernel = compiled(text, options, diagnostics);
      ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
      std::vector<float> results(u.size());
      const std::vector<const void*> in(kernel->kernel.program().inputs.size(), u.data());
      const std::vector<void*> out{results.data()};
      ASSERT_EQ(kernel->kernel.run(in, out, u.size()), RunStatus::done) << text << lanes;
      all.push_back(results);
    };
    run(Backend::interpreter, 0);
    for (const int lanes : {1, 4, 8, 16}) run(Backend::jit, lanes);
    for (const std::vector<float>& results : all) EXPECT_EQ(results, all.front()) << text;
  }
}

TEST(EndlessKernels, ARunObeysARequestToStop) {
  for (const Backend backend : {Backend::jit, Backend::interpreter, Backend::reference}) {
    ShaderOptions options;
    options.compile.backend = backend;
    options.compile.max_steps = std::uint64_t{1} << 60;
    Diagnostics diagnostics;
    const auto kernel = compiled(loops(3, 1024, body), options, diagnostics);
    ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
    const std::vector<float> u(64, 0.5f);
    std::vector<float> results(64);
    const std::vector<const void*> in(kernel->kernel.program().inputs.size(), u.data());
    const std::vector<void*> out{results.data()};
    std::atomic<std::uint32_t> stop = 0;
    const std::jthread other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      stop = 1;
    });
    // To its end it would take minutes.
    EXPECT_EQ(kernel->kernel.run(in, out, 64, {}, &stop), RunStatus::stopped);
  }
}

/// A kernel that is not counted is stopped between passes.
TEST(EndlessKernels, ALongBatchObeysARequestToStop) {
  for (const Backend backend : {Backend::jit, Backend::interpreter, Backend::reference}) {
    ShaderOptions options;
    options.compile.backend = backend;
    Diagnostics diagnostics;
    const auto kernel = compiled(loops(1, 1000, body), options, diagnostics);
    ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
    const std::vector<float> u(4'000'000, 0.5f);
    std::vector<float> results(u.size());
    const std::vector<const void*> in(kernel->kernel.program().inputs.size(), u.data());
    const std::vector<void*> out{results.data()};
    const std::atomic<std::uint32_t> stop = 1;
    EXPECT_EQ(kernel->kernel.run(in, out, u.size(), {}, &stop), RunStatus::stopped);
    EXPECT_EQ(results.back(), 0.0f) << "the whole batch was computed";
  }
}

/// What counts is a limit that a host may set.
TEST(EndlessKernels, TheLimitIsAnOption) {
  ShaderOptions options;
  options.compile.backend = Backend::interpreter;
  for (const bool fits : {true, false}) {
    options.compile.max_steps = fits ? 4'000'000 : 1000;
    Diagnostics diagnostics;
    const auto kernel = compiled(loops(2, 200, body), options, diagnostics);
    ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
    const float u = 0.5f;
    float result = 0;
    const std::vector<const void*> in(kernel->kernel.program().inputs.size(), &u);
    const std::vector<void*> out{&result};
    EXPECT_EQ(kernel->kernel.run(in, out, 1), fits ? RunStatus::done : RunStatus::too_many_steps);
  }
}

}  // namespace
}  // namespace nacre
