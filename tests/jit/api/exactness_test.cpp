// Errors that hosts ask for, against what they find at points of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nacre/nacre.hpp>
#include <string>
#include <thread>
#include <vector>

namespace nacre {
namespace {

/// exp(s) of the first texture coordinate.
const char* const exponential = R"(<materialx version="1.39">
  <texcoord name="uv" type="vector2"/>
  <extract name="s" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
  <exp name="e" type="float"><input name="in" type="float" nodename="s"/></exp>
  <output name="out" type="float" nodename="e"/></materialx>)";

const char* const white_metal = R"(<materialx version="1.39">
  <conductor_bsdf name="b" type="BSDF">
    <input name="ior" type="color3" value="0, 0, 0"/>
    <input name="extinction" type="color3" value="1, 1, 1"/>
    <input name="roughness" type="vector2" value="1, 1"/></conductor_bsdf>
  <surface name="S" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="b"/></surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>)";

/// What the largest relative error is of exp(s), s in [0, 1].
double found_error(const Shader& shader) {
  constexpr std::size_t count = 5000;
  std::vector<float> s(count), t(count), out(count);
  for (std::size_t i = 0; i < count; ++i) s[i] = static_cast<float>(i) / count;
  Binder binder;
  binder.array("uv0.x", {.array = 0, .stride = sizeof(float)});
  binder.array("uv0.y", {.array = 1, .stride = sizeof(float)});
  binder.array("out", {.array = 2, .stride = sizeof(float)});
  const Binding binding(binder, shader);
  void* const arrays[]{s.data(), t.data(), out.data()};
  EXPECT_TRUE(binding.run(NACRE_OUTPUTS, arrays, Batch{.count = count}));
  double most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    most = std::max(most, std::abs(out[i] / std::exp(double(s[i])) - 1));
  }
  return most;
}

Shader compiled(System& system, const CompileOptions& options) {
  return system.compile_outputs(Document::parse(exponential), {"out"}, options);
}

TEST(Exactness, IsUnknownWhereNobodyAsks) {
  System system;
  const Shader shader = compiled(system, {});
  EXPECT_FALSE(shader.error());
  EXPECT_EQ(shader.profile(), "");
}

TEST(Exactness, WhatIsMeasuredIsWhatAHostFinds) {
  System system;
  for (const int accuracy : {NACRE_FAST, NACRE_STANDARD, NACRE_PRECISE}) {
    CompileOptions options;
    options.accuracy = accuracy;
    options.measure_error = true;
    const Shader shader = compiled(system, options);
    const auto error = shader.error();
    ASSERT_TRUE(error);
    const double found = found_error(shader);
    // The reference rounds to float: half an ulp, which a host that knows better sees as well.
    const double ulp = std::numeric_limits<float>::epsilon();
    EXPECT_LE(error->maximum, 2 * found + ulp) << accuracy;
    EXPECT_GE(error->maximum, 0.5 * found - ulp) << accuracy;
    EXPECT_LE(error->p999, error->maximum);
    EXPECT_LE(error->mean, error->p999);
    EXPECT_EQ(error->worst, "out");
    EXPECT_FALSE(error->is_absolute);
    EXPECT_NE(error->points.find("2048 points"), std::string::npos) << error->points;
    EXPECT_EQ(shader.profile(), "");
  }
}

TEST(Exactness, WhatIsAskedForIsKept) {
  System system;
  for (const double max_error : {1e-2, 1e-5, 1e-6}) {
    CompileOptions options;
    options.max_error = max_error;
    const Shader shader = compiled(system, options);
    EXPECT_LE(found_error(shader), 3 * max_error);
    ASSERT_TRUE(shader.error());
    EXPECT_LE(shader.error()->p999, max_error);
    CompileOptions again;
    again.profile = shader.profile();
    again.measure_error = true;
    const Shader same = compiled(system, again);
    EXPECT_EQ(found_error(same), found_error(shader));
    EXPECT_EQ(same.error()->p999, shader.error()->p999);
  }
}

TEST(Exactness, NoneIsSaid) {
  System system;
  CompileOptions options;
  options.max_error = 1e-12;
  try {
    compiled(system, options);
    FAIL() << "nothing is that exact";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics().at(0).code, "no-such-error") << error.what();
  }
}

TEST(Exactness, ThatTakesLongEndsWhenItIsAskedTo) {
  System system;
  const Document document = Document::parse(white_metal);
  for (const bool chooses : {false, true}) {
    SCOPED_TRACE(chooses ? "chosen" : "measured");
    StopSource stop;
    CompileOptions options;
    options.max_error = chooses ? 1e-3 : 0;
    options.measure_error = !chooses;
    options.error_points = 1'000'000;  // Minutes.
    options.stop = &stop;
    std::jthread later([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      stop.request();
    });
    try {
      system.compile_material(document, "M", options);
      ADD_FAILURE() << "it came to its end";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("stopped"), std::string::npos) << error.what();
    }
  }
}

TEST(Exactness, WhatCannotBeMeantIsRefused) {
  System system;
  const auto refused = [&](auto&& change) {
    CompileOptions options;
    change(options);
    EXPECT_THROW(compiled(system, options), Error);
  };
  refused([](CompileOptions& o) { o.max_error = -1; });
  refused([](CompileOptions& o) { o.max_error = std::nan(""); });
  refused([](CompileOptions& o) { o.error_floor = 2; });
  refused([](CompileOptions& o) { o.error_points = 999; });
  refused([](CompileOptions& o) {
    o.max_error = 0.1;
    o.profile = R"({"nacre_profile": 1, "subjects": []})";
  });
  refused([](CompileOptions& o) {
    o.measure_error = true;
    o.error_record = "[]";
  });
}

/// White metal without what several scatterings bring back.
class WhereRecorded : public ::testing::Test {
 protected:
  static CompileOptions uncompensated() {
    CompileOptions options;
    options.compensation = NACRE_COMPENSATE_NOTHING;
    options.no_footprints = true;
    return options;
  }

  /// Four times one point, seen along wo, or from anywhere.
  ShaderError error(const std::string& wo) {
    CompileOptions options = uncompensated();
    options.measure_error = true;
    const auto up = [](const std::string& n) {
      return '"' + n + R"(.x": [0, 0, 0, 0], ")" + n + R"(.y": [0, 0, 0, 0], ")" + n +
             R"(.z": [1, 1, 1, 1])";
    };
    options.error_record = R"({"nacre_points": 1, "materials": [{"material": "M", "count": 4,
      "channels": {)" + wo +
                           up("N") + ", " + up("Ng") + "}}]}";
    return *system_.compile_material(document_, "M", options).error();
  }

  /// What does not leave of the light that arrives; all does in nature.
  double lost(float x, float z) {
    const Shader shader = system_.compile_material(document_, "M", uncompensated());
    Binder binder;
    binder.constant("N", {0, 0, 1}).constant("wo", {x, 0, z});
    float rgb[3] = {};
    binder.array("albedo", {.array = 0, .stride = sizeof rgb, .component_stride = sizeof(float)});
    const Binding binding(binder, shader, 1u << NACRE_ALBEDO);
    void* const arrays[]{rgb};
    EXPECT_TRUE(binding.run(NACRE_ALBEDO, arrays, Batch{.count = 1}));
    return 1 - rgb[0];
  }

  System system_;
  Document document_ = Document::parse(white_metal);
};

TEST_F(WhereRecorded, ErrorsAreThoseOfThePoints) {
  const ShaderError along = error(R"("wo.x": [0, 0, 0, 0], "wo.y": [0, 0, 0, 0],
    "wo.z": [1, 1, 1, 1],)");
  const ShaderError grazing = error(R"("wo.x": [0.96, 0.96, 0.96, 0.96], "wo.y": [0, 0, 0, 0],
    "wo.z": [0.28, 0.28, 0.28, 0.28],)");
  EXPECT_EQ(along.points, "2 points that a renderer has recorded");
  const double lost_along = lost(0, 1), lost_grazing = lost(0.96f, 0.28f);
  EXPECT_GE(along.maximum, 0.99 * lost_along);
  EXPECT_GE(grazing.maximum, 0.99 * lost_grazing);
  EXPECT_GT(std::abs(lost_along - lost_grazing), 0.05);
  EXPECT_EQ(along.maximum > grazing.maximum, lost_along > lost_grazing);
}

TEST_F(WhereRecorded, WhatIsNotRecordedIsSaid) {
  EXPECT_EQ(error("").points, "2 points that a renderer has recorded, but for wo.x, wo.y, wo.z");
}

TEST(Exactness, IsThatOfAllEntriesWhateverHostsAskBesides) {
  System system;
  CompileOptions options;
  options.measure_error = true;
  const Document document = Document::parse(white_metal);
  const double usual = system.compile_material(document, "M", options).error()->p999;
  options.lobe_mask = options.by_lobe = options.min_alpha = options.transport = true;
  options.lobes_wanted = true;
  options.entries = 1u << NACRE_SHADE | 1u << NACRE_ALBEDO;
  EXPECT_EQ(system.compile_material(document, "M", options).error()->p999, usual);
}

}  // namespace
}  // namespace nacre
