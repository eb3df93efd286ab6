// Boxes of what a displacement gives: what its kernel gives at any point is in them.
#include "examples/tool/render/displacement_box.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "examples/common/materialx_libraries.h"
#include "examples/render/batch_buffer.h"
#include "examples/render/batch_channels.h"
#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre::tool {
namespace {

using host::Bounds;
using host::Vec3;

/// Of a scalar that these nodes end in as "d", or a vector.
std::string document(const std::string& nodes, const std::string& type = "float") {
  return R"(<?xml version="1.0"?><materialx version="1.39">
    <position name="p" type="vector3"><input name="space" type="string" value="world"/></position>
    <texcoord name="uv" type="vector2"/>
    <separate2 name="uv2" type="multioutput"><input name="in" type="vector2" nodename="uv"/>
    </separate2>)" +
         nodes + R"(<displacement name="D" type="displacementshader">
      <input name="displacement" type=")" +
         type + R"(" nodename="d"/></displacement>
    <surface name="S" type="surfaceshader"/>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/>
      <input name="displacementshader" type="displacementshader" nodename="D"/></surfacematerial>
    </materialx>)";
}

constexpr const char* constant =
    R"(<constant name="d" type="float"><input name="value" type="float" value="0.25"/></constant>)";
constexpr const char* ramp = R"(<multiply name="d" type="float">
    <input name="in1" type="float" nodename="uv2" output="outx"/>
    <input name="in2" type="float" value="3"/></multiply>)";

struct Row {
  std::string name, document;
  /// Height of the largest box, of any triangle. What a loop passes over for lanes that need it no
  /// longer may stay as it began, for all that is known.
  double most = 1e30;
};

std::vector<Row> rows() {
  const auto of_place = [](const std::string& category, const std::string& more = "") {
    return document("<" + category + R"( name="d" type="float">
      <input name="position" type="vector3" nodename="p"/>)" +
                    more + "</" + category + ">");
  };
  const auto of_u = [](const std::string& category, const std::string& more = "") {
    return document("<" + category + R"( name="d" type="float">
      <input name="in" type="float" nodename="uv2" output="outx"/>)" +
                    more + "</" + category + ">");
  };
  const auto of_two = [](const std::string& category, const std::string& value) {
    return document("<" + category + R"( name="d" type="float">
      <input name="in1" type="float" nodename="uv2" output="outy"/>
      <input name="in2" type="float" value=")" +
                    value + "\"/></" + category + ">");
  };
  return {{"constant", document(constant)},
          {"ramp", document(ramp)},
          {"sine", of_u("sin")},
          {"exponential", of_u("exp")},
          {"smooth", of_u("smoothstep", R"(<input name="high" type="float" value="0.5"/>)")},
          {"steps", of_u("floor")},
          {"root", of_u("sqrt")},
          {"remainder", of_two("modulo", "0.3")},
          {"power", of_two("power", "2")},
          {"quotient", of_two("divide", "7")},
          {"noise", of_place("noise3d"), 9},
          {"flat noise", document(R"(<noise2d name="d" type="float">
             <input name="texcoord" type="vector2" nodename="uv"/></noise2d>)"),
           9},
          {"cells", of_place("cellnoise3d"), 1.1},
          {"fractal", of_place("fractal3d"), 17},
          {"sixteen octaves",
           of_place("fractal3d", R"(<input name="octaves" type="integer" value="16"/>)"), 17},
          {"nearest point", of_place("worleynoise3d")},
          {"vector", document(R"(<multiply name="d" type="vector3">
             <input name="in1" type="vector3" nodename="p"/>
             <input name="in2" type="float" value="-0.5"/></multiply>)",
                              "vector3")}};
}

class DisplacementBox : public testing::Test {
 protected:
  void SetUp() override {
    Diagnostics diagnostics;
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics);
    ASSERT_NE(system_, nullptr) << diagnostics.to_string();
  }

  void compile(const std::string& text) {
    Diagnostics diagnostics;
    const auto read = read_document_text(text, "a.mtlx", {}, diagnostics);
    ASSERT_NE(read, nullptr) << diagnostics.to_string();
    ShaderOptions options;
    options.compile.backend = Backend::interpreter;
    kernels_ = system_->compile_material(*read, "M", options, diagnostics);
    ASSERT_NE(kernels_, nullptr) << diagnostics.to_string();
    ASSERT_TRUE(kernels_->displacement);
    ASSERT_NE(kernels_->recorded_displacement, nullptr);
  }

  struct Point {
    Vec3 P, N;
    host::Vec2 uv;
  };
  void fill(host::BatchBuffer& buffer, const std::vector<Point>& points) const {
    buffer.batch.count = static_cast<std::uint32_t>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      store(buffer.batch.P, i, points[i].P);
      store(buffer.batch.N, i, points[i].N);
      const Vec3 t = normalize(Vec3{points[i].N.z, 0.f, -points[i].N.x});
      store(buffer.batch.T, i, t);
      store(buffer.batch.B, i, cross(points[i].N, t));
      store(buffer.batch.uv, i, points[i].uv);
    }
  }
  std::vector<Vec3> offsets(host::BatchBuffer& buffer) const {
    host::Capabilities unused;
    std::vector<const void*> inputs;
    for (const Channel& channel : kernels_->displacement->program().inputs) {
      inputs.push_back(host::batch_channel(channel.name, unused)(buffer.batch));
    }
    const host::Lanes3 rgb = buffer.rgb;
    const std::array<void*, 3> outputs{rgb.x, rgb.y, rgb.z};
    EXPECT_EQ(kernels_->displacement->run(inputs, outputs, buffer.batch.count), RunStatus::done);
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < buffer.batch.count; ++i) all.push_back(load(rgb, i));
    return all;
  }

  Point random_corner(float size) {
    std::uniform_real_distribution<float> any(-1.f, 1.f);
    const Vec3 n = {size * any(random_), size * any(random_), 1.f};
    return {{size * any(random_), size * any(random_), any(random_)},
            normalize(n),
            {any(random_) + 1.f, any(random_) + 1.f}};
  }
  Point random_point(const std::array<Point, 3>& c) {
    std::uniform_real_distribution<float> share(0.f, 1.f);
    float v = share(random_), w = share(random_);
    if (v + w > 1.f) v = 1.f - v, w = 1.f - w;
    const float u = 1.f - v - w;
    const auto mixed = [&](auto&& get) { return u * get(c[0]) + v * get(c[1]) + w * get(c[2]); };
    return {mixed([](const Point& p) { return p.P; }),
            normalize(mixed([](const Point& p) { return p.N; })),
            {mixed([](const Point& p) { return p.uv.x; }),
             mixed([](const Point& p) { return p.uv.y; })}};
  }

  std::unique_ptr<ShadingSystem> system_;
  std::unique_ptr<MaterialKernels> kernels_;
  std::mt19937 random_{1};
};

TEST_F(DisplacementBox, HasAllThatTheKernelGives) {
  constexpr std::uint32_t triangles = 80, points = 128;
  std::size_t tried = 0;
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.name);
    ASSERT_NO_FATAL_FAILURE(compile(row.document));
    host::BatchBuffer buffer(points, 0, 0);
    for (std::uint32_t t = 0; t < triangles; ++t) {
      const float size = t % 2 == 0 ? 1.f : 0.01f;
      const std::array<Point, 3> corners{random_corner(size), random_corner(size),
                                         random_corner(size)};
      fill(buffer, {corners.begin(), corners.end()});
      const Bounds box = displacement_box(*kernels_->recorded_displacement, buffer.batch);
      EXPECT_LE(box.high.z - box.low.z, row.most);
      std::vector<Point> inside;
      for (std::uint32_t i = 0; i < points; ++i) inside.push_back(random_point(corners));
      fill(buffer, inside);
      for (const Vec3 d : offsets(buffer)) {
        ++tried;
        ASSERT_TRUE(d.x >= box.low.x && d.x <= box.high.x) << d.x;
        ASSERT_TRUE(d.y >= box.low.y && d.y <= box.high.y) << d.y;
        ASSERT_TRUE(d.z >= box.low.z && d.z <= box.high.z) << d.z;
      }
    }
  }
  EXPECT_GE(tried, 100'000u);
}

// What is no more than sums and products of channels that are each met once has no slack but the
// room for rounding.
TEST_F(DisplacementBox, IsTight) {
  const Vec3 up{0.f, 0.f, 1.f};
  host::BatchBuffer buffer(3, 0, 0);
  const std::vector<Point> corners{
      {{0, 0, 0}, up, {0.25f, 0}}, {{1, 0, 0}, up, {0.5f, 0}}, {{0, 1, 0}, up, {0.25f, 1}}};
  fill(buffer, corners);
  const auto box = [&](const std::string& text) {
    compile(text);
    return displacement_box(*kernels_->recorded_displacement, buffer.batch);
  };
  const Bounds still = box(document(constant)), rising = box(document(ramp));
  for (const float x : {still.low.x, still.high.x, rising.low.y, rising.high.y}) {
    EXPECT_NEAR(x, 0.f, 1e-4f);
  }
  EXPECT_NEAR(still.low.z, 0.25f, 1e-3f);
  EXPECT_NEAR(still.high.z, 0.25f, 1e-3f);
  EXPECT_NEAR(rising.low.z, 0.75f, 4e-3f);
  EXPECT_NEAR(rising.high.z, 1.5f, 4e-3f);
}

}  // namespace
}  // namespace nacre::tool
