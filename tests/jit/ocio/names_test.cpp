// Which space a name means, and what is said where there is none.
#include <cmath>
#include <cstring>
#include <thread>

#include "jit/graph/color/color_config.h"
#include "tests/jit/ocio/config_fixture.h"
#include "tests/support/run_kernel.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

/// "wide" is ten times the reference, "square" its root: easy to tell apart.
constexpr const char* small_config = R"(ocio_profile_version: 2
search_path: .
roles:
  scene_linear: reference
  default: numbers
  painted: wide
colorspaces:
  - !<ColorSpace>
    name: reference
  - !<ColorSpace>
    name: Wide Gamut (times ten)
    aliases: [wide, srgb_texture]
    to_scene_reference: !<MatrixTransform> {matrix: [10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: square
    to_scene_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}
  - !<ColorSpace>
    name: numbers
    isdata: true
  - !<ColorSpace>
    name: lost
    to_scene_reference: !<FileTransform> {src: lost.cube}
)";

class Names : public Config {
 protected:
  /// A value (0.5, 0.25, 0.125) in a space, with whatever alpha, as compiled.
  std::vector<float> value(const std::string& from, std::optional<std::string> to,
                           const std::string& type = "color3",
                           const std::string& root_attributes = "") {
    const std::string text =
        "<constant name=\"c\" type=\"" + type + "\">\n<input name=\"value\" type=\"" + type +
        "\" value=\"0.5, 0.25, 0.125" + (type == "color4" ? ", 0.75" : "") + "\" colorspace=\"" +
        from + "\"/></constant><output name=\"out\" type=\"" + type + "\" nodename=\"c\"/>";
    const auto document = document_of(text, diagnostics_, root_attributes);
    ShaderOptions options;
    options.graph.working_space = std::move(to);
    options.graph.colors = host_;
    options.compile.backend = Backend::interpreter;
    const auto kernel = system_->compile_outputs(*document, {"out"}, options, diagnostics_);
    if (kernel == nullptr) return {};
    std::vector<float> result;
    const Columns columns = run(kernel->kernel.kernel(), {{"unused", {0.0f}}});
    for (const Channel& channel : kernel->kernel.program().outputs) {
      result.push_back(columns.at(channel.name).at(0));
    }
    return result;
  }

  void expect_complaint(const std::string& code, const std::vector<std::string>& parts) {
    ASSERT_EQ(diagnostics_.error_count(), 1u) << diagnostics_.to_string();
    EXPECT_EQ(diagnostics_.all().front().code, code);
    const std::string text = diagnostics_.to_string();
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
    diagnostics_ = {};
  }

  std::shared_ptr<const ColorConfig> host_;
};

using Numbers = std::vector<float>;
const Numbers same{0.5f, 0.25f, 0.125f};
const Numbers times_ten{5, 2.5f, 1.25f};

TEST_F(Names, ASpaceIsFoundByNameAliasAndRole) {
  open_text(small_config);
  for (const char* name : {"Wide Gamut (times ten)", "wide", "painted", "srgb_texture"}) {
    EXPECT_EQ(value(name, "reference"), times_ten) << name;
    EXPECT_EQ(value("reference", name), (Numbers{0.05f, 0.025f, 0.0125f})) << name;
    EXPECT_EQ(value(name, "wide"), same) << name;
  }
  EXPECT_EQ(value("wide", "scene_linear"), times_ten);
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(Names, NumbersAreNotConverted) {
  open_text(small_config);
  EXPECT_EQ(value("numbers", "reference"), same);
  EXPECT_EQ(value("wide", "numbers"), same);
  EXPECT_EQ(value("wide", "none"), same);
  EXPECT_EQ(value("raw", "reference"), same);  // No space of this one, but a name of ours.
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(Names, AlphaGoesThroughTheTransformAsWell) {
  open_text(small_config);
  EXPECT_EQ(value("wide", "reference", "color4"), (Numbers{5, 2.5f, 1.25f, 0.75f}));
}

/// rec2020 is known to us only, srgb_texture to both: the configuration's counts.
TEST_F(Names, BuiltInSpacesServeWhereBothEndsAreBuiltIn) {
  open_text(small_config);
  const Numbers with = value("lin_rec2020", "lin_rec709");
  EXPECT_EQ(value("srgb_texture", "reference"), times_ten);
  system_ = ShadingSystem::create({.libraries = {standard_library_folder()}}, diagnostics_);
  EXPECT_EQ(with, value("lin_rec2020", "lin_rec709"));
  EXPECT_EQ(with.size(), 3u);
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(Names, OneEndInEachIsAnError) {
  open_text(small_config);
  EXPECT_TRUE(value("lin_rec2020", "reference").empty());
  expect_complaint("unknown-colorspace",
                   {"test.mtlx:3:", "(c/value)", "config.ocio", "'reference'", "'lin_rec2020'"});
  EXPECT_TRUE(value("wide", "lin_rec2020").empty());
  expect_complaint("unknown-colorspace", {"test.mtlx:3:", "'wide'", "'lin_rec2020'"});
  EXPECT_TRUE(value("nowhere", "reference").empty());
  expect_complaint("unknown-colorspace", {"'nowhere'"});
  EXPECT_TRUE(value("refrence", "lin_rec709").empty());
  expect_complaint("unknown-colorspace", {"'refrence'", "did you mean 'reference'?"});
  EXPECT_TRUE(value("reference", "lin_rec79").empty());
  expect_complaint("unknown-colorspace", {"'lin_rec79'", "did you mean 'lin_rec709'?"});
}

/// "reference" said to be ACES 2065-1: what is built in is converted to that and on.
TEST_F(Names, EndsMeetAtTheInterchangeRole) {
  std::string text = small_config;
  text.insert(text.find("  painted"), "  aces_interchange: reference\n");
  open_text(text);
  // Curves and matrices, each way, against the built-in transforms made of nodes.
  for (const char* built_in : {"acescg", "g22_rec709", "lin_rec2020_scene", "srgb_displayp3"}) {
    for (const char* type : {"color3", "color4"}) {
      const Numbers to_aces = value(built_in, "lin_ap0", type);
      const Numbers from_aces = value("lin_ap0", built_in, type);
      const Numbers there = value(built_in, "wide", type);
      const Numbers back = value("reference", built_in, type);
      ASSERT_EQ(there.size(), to_aces.size()) << diagnostics_.to_string();
      ASSERT_EQ(back.size(), from_aces.size()) << diagnostics_.to_string();
      for (std::size_t i = 0; i < to_aces.size(); ++i) {
        const bool is_alpha = i == 3;
        EXPECT_NEAR(there[i], is_alpha ? 0.75f : to_aces[i] / 10, 4e-7) << built_in;
        EXPECT_NEAR(back[i], is_alpha ? 0.75f : from_aces[i], 4e-7) << built_in;
      }
    }
  }
  EXPECT_EQ(value("lin_rec2020", "numbers"), same);
  EXPECT_EQ(value("reference", std::nullopt), value("reference", "lin_rec709"));
  EXPECT_EQ(diagnostics_.to_string(), "");
  EXPECT_TRUE(value("nowhere", "reference").empty());
  expect_complaint("unknown-colorspace", {"'nowhere' to 'reference'", "aces_interchange"});
}

/// See GraphOptions::working_space.
TEST_F(Names, TheWorkingSpaceUnlessTheHostSays) {
  open_text(small_config);
  EXPECT_EQ(value("square", std::nullopt), (Numbers{0.25f, 0.0625f, 0.015625f}));
  EXPECT_EQ(value("square", ""), (Numbers{0.25f, 0.0625f, 0.015625f}));
  EXPECT_EQ(value("reference", "", "color3", "colorspace=\"square\""),
            (Numbers{std::sqrt(0.5f), 0.5f, std::sqrt(0.125f)}));
  std::string text = small_config;
  text.replace(text.find("name: square"), 12, "name: square\n    aliases: [lin_rec709]");
  open_text(text);
  EXPECT_EQ(value("square", std::nullopt), same);
  EXPECT_EQ(value("reference", std::nullopt), (Numbers{std::sqrt(0.5f), 0.5f, std::sqrt(0.125f)}));
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(Names, AMissingTableIsAnError) {
  open_text(small_config);
  EXPECT_TRUE(value("lost", "reference").empty());
  expect_complaint("no-color-transform", {"test.mtlx:3:", "(c/value)", "config.ocio", "'lost'",
                                          "'reference'", "lost.cube"});
}

TEST_F(Names, AConfigurationThatCannotBeReadIsAnError) {
  const auto create = [&](const std::string& path) {
    return ShadingSystem::create({.libraries = {standard_library_folder()}, .ocio_config = path},
                                 diagnostics_);
  };
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_EQ(create(folder_.file("nothing.ocio")), nullptr);
  expect_complaint("bad-color-config", {"nothing.ocio", "no such file"});
  EXPECT_EQ(create(folder_.path().string()), nullptr);
  expect_complaint("bad-color-config", {"no such file"});
  EXPECT_EQ(create(folder_.write("bad.ocio", "{[")), nullptr);
  expect_complaint("bad-color-config", {"bad.ocio", "line 1"});
  EXPECT_EQ(create(folder_.write("empty.ocio", "")), nullptr);
  expect_complaint("bad-color-config", {"empty.ocio"});
  EXPECT_EQ(create(folder_.write("new.ocio", "ocio_profile_version: 99\n")), nullptr);
  expect_complaint("bad-color-config", {"new.ocio", "99"});
  // A key that OpenColorIO does not know is no fault, and it would print a warning.
  EXPECT_NE(create(folder_.write("odd.ocio", std::string(small_config) + "odd_key: 1\n")), nullptr);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// What a host gives in place of a configuration.
class HostColors : public ColorConfig {
 public:
  explicit HostColors(ColorTransform transform) : transform_(std::move(transform)) {}
  std::string name() const override { return "host"; }
  std::optional<Space> find(std::string_view name) const override {
    if (name != "a" && name != "b") return std::nullopt;
    return Space{std::string(name), false};
  }
  std::shared_ptr<const ColorTransform> transform(const std::string&, const std::string&,
                                                  std::string&) const override {
    return std::make_shared<ColorTransform>(transform_);
  }

 private:
  ColorTransform transform_;
};

TEST_F(Names, AHostsOwnSpacesCount) {
  open_text(small_config);
  host_ = std::make_shared<HostColors>(
      ColorTransform{"vec4 f(vec4 c) { return vec4(c.bgr * c.a, c.a); }", "f", {}});
  EXPECT_EQ(value("a", "b"), (Numbers{0.125f, 0.25f, 0.5f}));
  EXPECT_EQ(value("a", "b", "color4"), (Numbers{0.09375f, 0.1875f, 0.375f, 0.75f}));
  EXPECT_TRUE(value("wide", "b").empty());
}

TEST_F(Names, ATextOutsideTheSubsetIsAnError) {
  open_text(small_config);
  const auto complain = [&](const std::string& text, std::vector<TextTable> tables,
                            const std::string& code) {
    host_ = std::make_shared<HostColors>(ColorTransform{text, "f", std::move(tables)});
    EXPECT_TRUE(value("a", "b").empty());
    expect_complaint(code, {"host: 'a' to 'b'"});
  };
  complain("vec4 f(vec4 c) {\n c += 1.0 );\n return c; }", {}, "glsl-syntax");
  complain("vec4 f(vec4 c) { return imageLoad(c); }", {}, "glsl-call");
  complain("vec3 f(vec3 c) { return c; }", {}, "glsl-call");
  complain("vec4 g(vec4 c) { return c; }", {}, "glsl-call");
  const std::string reads = "uniform sampler1D t;\nvec4 f(vec4 c) { return texture(t, c.r); }";
  complain(reads, {}, "glsl-texture");
  // Fewer numbers than texels.
  complain(reads,
           {{"t",
             {4, 1, 1},
             1,
             TextTable::Filter::linear,
             std::make_shared<TableValues>(std::vector<float>{1, 2, 3})}},
           "glsl-texture");
}

/// A kernel for one configuration must not serve another.
TEST_F(Names, TheConfigurationIsPartOfTheTopology) {
  const auto hash_with = [&](const std::string& text) {
    open_text(text);
    const auto graph = graph_of("color3", "square", "reference");
    EXPECT_TRUE(graph) << diagnostics_.to_string();
    return topology_hash(*graph);
  };
  const auto cube = [&](const char* number) {
    folder_.write("lost.cube", std::string("LUT_3D_SIZE 2\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n"
                                           "1 0 1\n0 1 1\n1 1 ") +
                                   number + "\n");
    open_text(small_config);
    const auto graph = graph_of("color3", "lost", "reference");
    EXPECT_TRUE(graph) << diagnostics_.to_string();
    return topology_hash(*graph);
  };
  std::string other = small_config;
  other.replace(other.find("[2, 2, 2, 1]"), 12, "[2, 2, 3, 1]");
  const std::uint64_t hash = hash_with(small_config);
  EXPECT_EQ(hash_with(small_config), hash);
  EXPECT_NE(hash_with(other), hash);
  const std::uint64_t table_hash = cube("1");
  EXPECT_EQ(cube("1"), table_hash);
  EXPECT_NE(cube("0.5"), table_hash);
}

TEST_F(Names, AnyThreadMayAsk) {
  open_text(small_config);
  std::vector<std::thread> threads;
  std::vector<std::uint64_t> hashes(8);
  const auto document = document_of(
      "<constant name=\"c\" type=\"color3\"><input name=\"value\" type=\"color3\" "
      "value=\"1, 1, 1\" colorspace=\"wide\"/></constant>"
      "<output name=\"out\" type=\"color3\" nodename=\"c\"/>",
      diagnostics_);
  for (std::uint64_t& hash : hashes) {
    threads.emplace_back([&] {
      Diagnostics diagnostics;
      const auto graph =
          build_graph(*document, system_->library(), {.outputs = {"out"}, .material = {}},
                      system_->graph_options({}), diagnostics);
      if (graph) hash = topology_hash(*graph);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
  EXPECT_NE(hashes.front(), 0u);
}

}  // namespace
}  // namespace nacre
