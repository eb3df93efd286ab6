// Colour spaces of a host's own.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <nacre/nacre.hpp>
#include <string>

namespace nacre {
namespace {

using Color = std::array<float, 3>;

/// "mirrored" has red and blue exchanged; "looked-up" takes the square roots of four texels'
/// places.
class TestColors : public Colors {
 public:
  std::string name() const override { return "the test's"; }
  ColorSpace find(const std::string& name) const override {
    if (name == "plain" || name == "mirrored" || name == "looked-up" || name == "lost") {
      return {name, false};
    }
    if (name == "another name") return {"mirrored", false};
    if (name == "numbers") return {name, true};
    return {};
  }
  ColorTransform transform(const std::string& from, const std::string& to) const override {
    if (to != "plain") throw std::runtime_error("there is no way to " + to);
    if (from == "mirrored") return {"vec4 f(vec4 c) { return c.bgra; }", "f", {}};
    if (from == "looked-up") {
      return {"uniform sampler1D t;\nvec4 g(vec4 c) { return vec4(texture(t, c.r).r, 0, 0, c.a); }",
              "g",
              {{"t", {4, 1, 1}, 1, false, {0, 2, 4, 8}}}};
    }
    return {};
  }
};

/// The colour (1/8, 1/4, 1/2) of a space, in the space "plain".
Color converted(System& system, const std::string& space) {
  const Document document = Document::parse(
      R"(<materialx version="1.39"><constant name="c" type="color3">
           <input name="value" type="color3" value="0.125, 0.25, 0.5" colorspace=")" +
      space + R"("/></constant>
         <output name="out" type="color3" nodename="c"/></materialx>)");
  CompileOptions options;
  options.engine = NACRE_INTERPRETER;
  options.working_space = "plain";
  const Shader shader = system.compile_outputs(document, {"out"}, options);
  Binder binder;
  binder.array("out", {0, 0, sizeof(Color)});
  const Binding binding(binder, shader);
  Color color{};
  Batch batch;
  batch.count = 1;
  binding.run(NACRE_OUTPUTS, std::vector<void*>{&color}, batch);
  return color;
}

TEST(ApiColors, TheHostsTransformsAreApplied) {
  SystemOptions options;
  options.colors = std::make_shared<TestColors>();
  System system(options);
  EXPECT_EQ(converted(system, "plain"), (Color{0.125f, 0.25f, 0.5f}));
  EXPECT_EQ(converted(system, "mirrored"), (Color{0.5f, 0.25f, 0.125f}));
  EXPECT_EQ(converted(system, "another name"), (Color{0.5f, 0.25f, 0.125f}));
  EXPECT_EQ(converted(system, "numbers"), (Color{0.125f, 0.25f, 0.5f}));
  // 1/8 is the centre of the first of four texels.
  EXPECT_EQ(converted(system, "looked-up"), (Color{0, 0, 0}));
}

TEST(ApiColors, ATransformThatIsNotThereIsAnError) {
  SystemOptions options;
  options.colors = std::make_shared<TestColors>();
  System system(options);
  try {
    converted(system, "lost");
    FAIL() << "there is no such transform";
  } catch (const Error& error) {
    ASSERT_FALSE(error.diagnostics().empty());
    EXPECT_NE(error.diagnostics()[0].text.find("the test's"), std::string::npos) << error.what();
  }
}

TEST(ApiColors, ATableThatCannotBeMeantIsAnError) {
  static const float numbers[4] = {};
  nacre_color_table table{};
  nacre_colors colors{};
  colors.size = sizeof colors;
  colors.name = "c";
  colors.user = &table;
  colors.find = [](void*, const char* name, nacre_color_space* space) {
    space->name = name[0] == 'x' ? "x" : "y";
    return int(std::string(name) == "x" || std::string(name) == "y");
  };
  colors.transform = [](void* user, const char*, const char*, nacre_color_transform* transform) {
    transform->text = "uniform sampler1D t; vec4 f(vec4 c) { return texture(t, c.r); }";
    transform->function = "f";
    transform->tables = static_cast<nacre_color_table*>(user);
    transform->table_count = 1;
    return 1;
  };
  nacre_system_options asked{};
  asked.size = sizeof asked;
  asked.colors = &colors;
  nacre_system* system = nullptr;
  ASSERT_EQ(nacre_system_create(&asked, nullptr, &system), NACRE_OK);
  const Document document = Document::parse(
      R"(<materialx version="1.39"><constant name="c" type="color3">
           <input name="value" type="color3" value="1, 1, 1" colorspace="x"/></constant>
         <output name="out" type="color3" nodename="c"/></materialx>)");
  const auto status = [&](const nacre_color_table& given) {
    table = given;
    nacre_compile_options options{};
    options.size = sizeof options;
    options.engine = NACRE_INTERPRETER;
    options.working_space = "y";
    nacre_shader* shader = nullptr;
    const char* const outputs[] = {"out"};
    const nacre_status done =
        nacre_compile_outputs(system, document.get(), outputs, 1, &options, nullptr, &shader);
    nacre_shader_destroy(shader);
    return done;
  };
  const nacre_color_table good{sizeof good, "t", {4, 1, 1}, 1, 0, numbers};
  EXPECT_EQ(status(good), NACRE_OK);
  nacre_color_table bad = good;
  bad.size = 0;
  EXPECT_EQ(status(bad), NACRE_FAILED);
  bad = good;
  bad.extent[1] = 0;
  EXPECT_EQ(status(bad), NACRE_FAILED);
  bad.extent[1] = SIZE_MAX / 2;
  EXPECT_EQ(status(bad), NACRE_FAILED);
  bad = good;
  bad.channels = 5;
  EXPECT_EQ(status(bad), NACRE_FAILED);
  bad = good;
  bad.values = nullptr;
  EXPECT_EQ(status(bad), NACRE_FAILED);
  nacre_system_destroy(system);
}

}  // namespace
}  // namespace nacre
