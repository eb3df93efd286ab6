// Lobes by text that are wrong: what is said, and where.
#include <fmt/format.h>

#include <filesystem>

#include "jit/record/text_lobe.h"
#include "runtime/diagnostic.h"
#include "tests/jit/record/text_lobes.h"

namespace nacre {
namespace {

class TextLobeFaults : public TextLobes {
 protected:
  static constexpr const char* own = "<own name=\"b\" type=\"BSDF\"/>";

  /// What compiling says of the text, and then what checking does: each fault once, the same.
  std::string said(const std::string& text, const std::string& nodedefs, const char* node = own) {
    folder_.write("own.glsl", text);
    diagnostics_ = {};
    EXPECT_EQ(material(nodedefs + node), nullptr);
    const std::string compiled = listed();
    diagnostics_ = {};
    const auto document = read(nodedefs);
    system_->check(*document, options_, diagnostics_);
    EXPECT_EQ(listed(), compiled);
    return compiled;
  }
  std::string said(const std::string& text) { return said(text, nodedef()); }

  /// Whether a lobe is refused, or its kernel ends without a result.
  bool ends(const std::string& text) {
    folder_.write("own.glsl", text);
    diagnostics_ = {};
    const auto kernels = material(nodedef() + own);
    if (kernels == nullptr) return diagnostics_.has_errors();
    const BoundKernel& evaluate = *kernels->evaluate;
    std::vector<float> values;
    for (const Channel& channel : evaluate.program().inputs) {
      const bool is_across = channel.name.ends_with(".x") || channel.name.ends_with(".y");
      values.push_back(is_across && !channel.name.starts_with("state") ? 0.0f : 1.0f);
    }
    std::vector<float> results(evaluate.program().outputs.size());
    std::vector<const void*> in;
    std::vector<void*> out;
    for (const float& value : values) in.push_back(&value);
    for (float& result : results) out.push_back(&result);
    return evaluate.run(in, out, 1) == RunStatus::too_many_steps;
  }

  std::string listed() const {
    std::string all;
    for (const Diagnostic& one : diagnostics_.all()) {
      all += fmt::format("{}{} {}:{} {}: {}; {}", all.empty() ? "" : "\n", one.code,
                         std::filesystem::path(one.where.file).filename().string(), one.where.line,
                         one.where.path, one.expected, one.found);
    }
    return all;
  }
};

TEST_F(TextLobeFaults, AreMissingFunctions) {
  EXPECT_EQ(said("float own_pdf(vec3 wo, vec3 wi, vec3 color) { return 1.0; }"),
            "source-misfit test.mtlx:5 IM_own: vec3 own_evaluate(vec3 wo, vec3 wi, vec3 color); "
            "no such function\n"
            "source-misfit test.mtlx:5 IM_own: vec3 own_sample(vec3 wo, vec3 xi, vec3 color); "
            "no such function\n"
            "source-misfit test.mtlx:5 IM_own: vec3 own_albedo(vec3 wo, vec3 color); "
            "no such function");
}

TEST_F(TextLobeFaults, AreFunctionsThatDoNotFit) {
  const auto with = [&](const std::string& part, const std::string& other) {
    std::string text = LambertText().text();
    return said(text.replace(text.find(part), part.size(), other));
  };
  EXPECT_EQ(with("float own_pdf(vec3 wo, vec3 wi", "vec3 own_pdf(vec3 wo, vec3 wi"),
            "source-misfit own.glsl:6 IM_own: float own_pdf(vec3 wo, vec3 wi, vec3 color); "
            "vec3 own_pdf(vec3 wo, vec3 wi, vec3 color)");
  EXPECT_EQ(with("own_albedo(vec3 wo, vec3 color)", "own_albedo(vec3 color)"),
            "source-misfit own.glsl:7 IM_own: vec3 own_albedo(vec3 wo, vec3 color); "
            "vec3 own_albedo(vec3 color)");
  EXPECT_EQ(with("own_evaluate(vec3 wo, vec3 wi", "own_evaluate(vec3 wo, vec2 wi"),
            "source-misfit own.glsl:1 IM_own: vec3 own_evaluate(vec3 wo, vec3 wi, vec3 color); "
            "vec3 own_evaluate(vec3 wo, vec2 wi, vec3 color)");
  EXPECT_EQ(with("own_sample(vec3 wo, vec2 xi", "own_sample(vec3 wo, out vec2 xi"),
            "source-misfit own.glsl:2 IM_own: vec3 own_sample(vec3 wo, vec3 xi, vec3 color); "
            "vec3 own_sample(vec3 wo, out vec2 xi, vec3 color)");
  EXPECT_EQ(with("own_pdf(vec3 wo, vec3 wi, vec3 color", "own_pdf(vec3 wo, vec3 wi, float color"),
            "source-misfit own.glsl:6 IM_own: vec3; float");
}

TEST_F(TextLobeFaults, AreNodedefsThatNoTextCanBeOf) {
  const std::string text = LambertText().text();
  EXPECT_EQ(said(text, nodedef(ports, "bsdf=\"TR\"")),
            "source-misfit test.mtlx:5 IM_own: R, T or RT; TR");
  EXPECT_EQ(said(text, nodedef("<input name=\"base\" type=\"BSDF\" value=\"\"/>")),
            "source-misfit test.mtlx:3 IM_own: a number, a string of an enumeration or a "
            "structure; BSDF");
  std::string expression = nodedef();
  const std::string function = "file=\"own.glsl\" function=\"own\"";
  expression.replace(expression.find(function), function.size(), "sourcecode=\"vec3(1.0)\"");
  EXPECT_EQ(said(text, expression),
            "source-misfit test.mtlx:5 IM_own: function=\"NAME\", for NAME_evaluate, NAME_sample, "
            "NAME_pdf and NAME_albedo; an expression");
}

/// Found when the kernels are recorded, within regions that are open then.
TEST_F(TextLobeFaults, AreInBodiesToo) {
  const auto undefined = [](std::string LambertText::* place) {
    LambertText text;
    text.*place = "nothing(color)";
    return text.text();
  };
  EXPECT_EQ(said(undefined(&LambertText::f)), "glsl-call own.glsl:1 IM_own: ; ");
  EXPECT_EQ(said(undefined(&LambertText::sample)), "glsl-call own.glsl:5 IM_own: ; ");
  EXPECT_EQ(said(undefined(&LambertText::pdf)), "glsl-call own.glsl:6 IM_own: ; ");
  EXPECT_EQ(said(undefined(&LambertText::albedo)), "glsl-call own.glsl:7 IM_own: ; ");
  const std::string held =
      "<own name=\"o\" type=\"BSDF\"/><conductor_bsdf name=\"m\" type=\"BSDF\"/>";
  const std::string half = "<input name=\"mix\" type=\"float\" value=\"0.5\"/>";
  for (const auto& [category, first, second] :
       {std::tuple{"mix", "fg", "bg"}, {"layer", "top", "base"}, {"add", "in1", "in2"}}) {
    const std::string holder = fmt::format(
        "{}<{} name=\"b\" type=\"BSDF\">{}{}{}</{}>", held, category, reads(first, "BSDF", "o"),
        reads(second, "BSDF", "m"), category == std::string("mix") ? half : "", category);
    EXPECT_EQ(said(undefined(&LambertText::f), nodedef(), holder.c_str()),
              "glsl-call own.glsl:1 IM_own: ; ")
        << category;
  }
}

/// A lobe reads no images: its inputs are fed by nodes that do.
TEST_F(TextLobeFaults, IsReadingAnImage) {
  const std::string inputs = "<input name=\"file\" type=\"filename\" value=\"\"/>";
  const std::string text = R"(
    vec3 own_evaluate(vec3 wo, vec3 wi, sampler2D file) { return texture(file, wi.xy).xyz; }
    vec3 own_sample(vec3 wo, vec2 xi, sampler2D file) { return wo; }
    float own_pdf(vec3 wo, vec3 wi, sampler2D file) { return 1.0; }
    vec3 own_albedo(vec3 wo, sampler2D file) { return wo; })";
  EXPECT_EQ(said(text, nodedef(inputs)), "glsl-texture own.glsl:2 IM_own: ; ");
}

/// A text is not trusted: it ends in time, in the compiler or in the kernel.
TEST_F(TextLobeFaults, AreTextsWithoutEnd) {
  LambertText text;
  text.f = "own_evaluate(wo, wi, color)";
  EXPECT_EQ(said(text.text()).substr(0, 22), "glsl-recursion own.gls");
  std::string calls = "vec3 z(vec3 w) { return w + vec3(sin(w.x)); }\n";
  for (char name = 'y'; name >= 'a'; --name) {
    calls += fmt::format("vec3 {0}(vec3 w) {{ return {1}({1}({1}(w))); }}\n", name,
                         static_cast<char>(name + 1));
  }
  text.f = "a(wi)";
  EXPECT_TRUE(ends(calls + text.text())) << "calls";
  text.f = "forever(wi)";
  EXPECT_TRUE(
      ends("vec3 forever(vec3 w) { while (w.z > 0.0) { w.x += 1.0; } return w; }\n" + text.text()))
      << "a loop";
}

/// MaterialX's own texts of closures are for its generators, whatever is preferred.
TEST_F(TextLobeFaults, AreNotSeenInLobesOfTheLibrary) {
  system_ = ShadingSystem::create(
      {.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}, .standard_texts = true}, diagnostics_);
  options_.graph.prefer = Preference::source;
  const auto kernels = material("<sheen_bsdf name=\"b\" type=\"BSDF\"/>");
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  EXPECT_EQ(kernels->lobes.front().name, "sheen_bsdf");
}

}  // namespace
}  // namespace nacre
