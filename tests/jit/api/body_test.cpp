// Nodes and lobes that a host writes, with <nacre/nacre.hpp> and nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nacre/nacre.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/jit/api/surface_points.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

constexpr const char* pack = R"(<materialx version="1.39">
  <nodedef name="ND_ours" node="ours"><input name="in" type="float" value="0"/>
    <input name="tint" type="color3" value="1, 1, 1"/><input name="mode" type="string" value="a"/>
    <output name="out" type="float"/></nodedef>
  <nodedef name="ND_grey" node="grey"><input name="weight" type="float" value="1"/>
    <input name="reflectance" type="float" value="0.5"/><output name="out" type="BSDF"/></nodedef>
</materialx>)";

/// A system with nodedefs of a test's own, the given body being that of one.
class HostNodes : public testing::Test {
 protected:
  TemporaryFolder folder;

  System system_with(const std::string& nodedef, std::function<void(Node&)> record) {
    const std::string file = folder.path() / "pack.mtlx";
    std::ofstream(file) << pack;
    SystemOptions options;
    options.libraries = {data_library(), file};
    options.bodies = {{nodedef, std::move(record)}};
    return System(options);
  }

  Shader compile(std::function<void(Node&)> record, const CompileOptions& options = {}) {
    const Document document = Document::parse(R"(<materialx version="1.39">
      <texcoord name="uv" type="vector2"/>
      <separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="uv"/>
      </separate2>
      <ours name="n" type="float"><input name="in" type="float" nodename="parts" output="outx"/>
      </ours><output name="out" type="float" nodename="n"/></materialx>)");
    System system = system_with("ND_ours", std::move(record));
    return system.compile_outputs(document, {"out"}, options);
  }

  /// The output at some u.
  std::vector<float> run(const Shader& shader, std::vector<float> u,
                         const Instance* instance = nullptr) {
    std::vector<float> uv;
    for (const float x : u) uv.insert(uv.end(), {x, 0.0f});
    std::vector<float> out(u.size()), age(u.size(), 3.0f);
    Binder binder;
    binder.array("uv0", {0, 0, 8}).array("out", {1}).array("age", {2});
    Batch batch;
    batch.count = u.size();
    Binding(binder, shader)
        .run(NACRE_OUTPUTS, std::vector<void*>{uv.data(), out.data(), age.data()}, batch, instance);
    return out;
  }

  /// The one error that a wrong body leads to.
  Diagnostic error_of(std::function<void(Node&)> record) {
    try {
      compile(std::move(record));
    } catch (const Error& error) {
      EXPECT_FALSE(error.diagnostics().empty()) << error.what();
      if (!error.diagnostics().empty()) return error.diagnostics().front();
      return {};
    }
    ADD_FAILURE() << "it compiled";
    return {};
  }
};

TEST_F(HostNodes, ComputeOnTheirInputs) {
  const Shader shader = compile([](Node& node) {
    const Float x = node.number("in");
    EXPECT_EQ(node.text("mode"), "a");
    EXPECT_EQ(node.input_type("tint"), "color3");
    EXPECT_EQ(node.output_type(), "float");
    node.set(select(x < 0.5f, x * x, node.vector3("tint").y - x));
  });
  EXPECT_EQ(run(shader, {0.25f, 0.75f}), (std::vector<float>{0.0625f, 0.25f}));
}

TEST_F(HostNodes, HaveBranchesLoopsTablesChannelsAndSlots) {
  const Shader shader = compile([](Node& node) {
    const Float x = node.number("in");
    // Newton's square root of x + 1, where that is wanted.
    const Float root = if_any(x > 0.0f, Float(-1.0f), [&] {
      return loop(node.recorder(), Bool(true), 12, Float(1.0f), [&](Int, Float& guess) {
        const Float better = 0.5f * (guess + (x + 1.0f) / guess);
        const Bool goes_on = abs(better - guess) > 1e-6f;
        guess = better;
        return goes_on;
      });
    });
    const Float entry = node.look_up("tens", {10.0f, 20.0f, 30.0f}, to_int(x));
    node.set(root + entry + node.channel("age") + node.slot("offset", 100.0f));
  });
  const std::vector<float> found = run(shader, {-1.0f, 1.25f, 3.0f});
  EXPECT_FLOAT_EQ(found[0], -1.0f + 10.0f + 3.0f + 100.0f);
  EXPECT_FLOAT_EQ(found[1], 1.5f + 20.0f + 3.0f + 100.0f);
  EXPECT_FLOAT_EQ(found[2], 2.0f + 30.0f + 3.0f + 100.0f);
  Instance instance(shader);
  instance.set("offset", 0.0f);
  EXPECT_FLOAT_EQ(run(shader, {3.0f}, &instance)[0], 35.0f);
}

TEST_F(HostNodes, KnowTheFootprint) {
  const Shader shader = compile([](Node& node) {
    const Float x = node.number("in");
    node.set(footprint_derivative(x * x, 0));
  });
  std::vector<float> uv{3.0f, 0.0f}, out(1);
  Binder binder;
  binder.array("uv0", {0, 0, 8}).array("out", {1}).constant("duv0dx", {0.5f, 0});
  Batch batch;
  batch.count = 1;
  Binding(binder, shader).run(NACRE_OUTPUTS, std::vector<void*>{uv.data(), out.data()}, batch);
  EXPECT_FLOAT_EQ(out[0], 3.0f);  // 2 x dx
}

TEST_F(HostNodes, SayWhatTheyDoWrong) {
  const auto expect_error = [&](const char* part, std::function<void(Node&)> record) {
    const Diagnostic said = error_of(std::move(record));
    EXPECT_NE(said.message.find(part), std::string::npos) << said.text;
    EXPECT_EQ(said.line, 5) << said.text;
  };
  expect_error("no input 'on'", [](Node& node) { node.set(node.number("on")); });
  expect_error("another type", [](Node& node) { node.set(node.number("tint")); });
  expect_error("as many numbers", [](Node& node) { node.set(node.vector3("tint")); });
  expect_error("no output", [](Node& node) { node.set("other", node.number("in")); });
  expect_error("nothing like it", [](Node&) { throw std::runtime_error("nothing like it"); });
  expect_error("another type", [](Node& node) { node.set(Int(1)); });
  expect_error("another recording", [](Node& node) {
    Float inner;
    if_any(node.number("in") > 0.0f, Float(0.0f), [&] { return inner = sqrt(node.number("in")); });
    node.set(inner);
  });
  expect_error("left open", [](Node& node) {
    nacre_begin_if(node.recorder(), (node.number("in") > 0.0f).value());
    node.set(node.number("in"));
  });
  expect_error("goes on", [](Node& node) {
    nacre_begin_loop(node.recorder(), Bool(true).value(), 4);
    nacre_end_loop(node.recorder());
    node.set(node.number("in"));
  });
  expect_error("wrong operands", [](Node& node) {
    const nacre_value one[]{node.number("in").value()};
    nacre_record(NACRE_ADD, one, 1, 0);
    node.set(node.number("in"));
  });
  expect_error("outside of its region", [](Node& node) {
    node.set(Float(nacre_merge(node.recorder(), node.number("in").value(), Float(0).value())));
  });
}

TEST_F(HostNodes, MayNotKeepValuesFromOneRecordingToTheNext) {
  const auto kept = std::make_shared<Float>();
  compile([kept](Node& node) { node.set(*kept = node.number("in")); });
  const Diagnostic said = error_of([kept](Node& node) { node.set(*kept); });
  EXPECT_EQ(said.code, "host-body");
}

/// A lobe of constant reflectance: f cos / pdf is the reflectance in every direction.
class Grey final : public Lobe {
 public:
  Grey(Float3 normal, Float reflectance) : normal_(normal), reflectance_(reflectance) {}
  const char* name() const override { return "grey"; }
  int kinds() const override { return NACRE_DIFFUSE_REFLECTION; }
  bool is_opaque() const override { return true; }
  LobeValue evaluate(const View&, Float3 wi) const override {
    const Float pdf = max(dot(normal_, wi), 0.0f) * 0.318309886f;
    return {Float3(reflectance_ * pdf), pdf};
  }
  LobeSample sample(const View&, Float3 u) const override {
    // Malley's method, about the z axis.
    const Float r = sqrt(u.x);
    const Float angle = 6.283185307f * u.y;
    return {{r * cos(angle), r * sin(angle), sqrt(max(1.0f - u.x, 0.0f))}, true};
  }
  Float3 albedo(const View&) const override { return Float3(reflectance_); }

 private:
  Float3 normal_;
  Float reflectance_;
};

TEST_F(HostNodes, MayBeLobes) {
  System system = system_with("ND_grey", [](Node& node) {
    nacre_recorder* const recorder = node.recorder();
    const Float3 normal{node.channel("N.x"), node.channel("N.y"), node.channel("N.z")};
    node.set_lobe(
        std::make_shared<Grey>(keep(recorder, normal), keep(recorder, node.number("reflectance"))));
  });
  const Document document = Document::parse(R"(<materialx version="1.39">
    <grey name="g" type="BSDF"><input name="reflectance" type="float" value="0.75"/></grey>
    <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="g"/></surface>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)");
  const Shader shader = system.compile_material(document, "M");
  ASSERT_EQ(shader.lobes().size(), 1u);
  EXPECT_EQ(shader.lobes()[0].name, "grey");
  EXPECT_EQ(shader.lobes()[0].kinds, NACRE_DIFFUSE_REFLECTION);
  SurfacePoints points(500);
  points.shade(shader);
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    ASSERT_EQ(points.albedo[3 * i], 0.75f);
    ASSERT_TRUE(points.flags[i] & NACRE_SAMPLE_VALID) << i;
    ASSERT_NEAR(points.weight[3 * i], 0.75f, 1e-5f) << i;
    ASSERT_NEAR(points.pdf[i], points.wi[3 * i + 2] / 3.14159265f, 1e-5f) << i;
  }
}

}  // namespace
}  // namespace nacre
