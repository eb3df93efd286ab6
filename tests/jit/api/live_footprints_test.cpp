// Footprints that a host changes when kernels are there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <nacre/nacre.hpp>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace nacre {
namespace {

constexpr std::size_t count = 203;  // No multiple of any width.

/// An image of two filters, edges that are filtered, and a slope.
constexpr const char* document = R"(<materialx version="1.39">
  <image name="linear" type="color3"><input name="file" type="filename" value="painted"/></image>
  <image name="cubic" type="float"><input name="file" type="filename" value="painted.r"/>
    <input name="filtertype" type="string" value="cubic"/></image>
  <splitlr name="edge" type="float"><input name="valuel" type="float" value="0.25"/>
    <input name="valuer" type="float" value="0.75"/></splitlr>
  <heighttonormal name="slope" type="vector3"><input name="in" type="float" nodename="cubic"/>
  </heighttonormal>
  <output name="image" type="color3" nodename="linear"/>
  <output name="smooth" type="float" nodename="cubic"/>
  <output name="split" type="float" nodename="edge"/>
  <output name="normal" type="vector3" nodename="slope"/>
</materialx>)";
constexpr std::size_t numbers_a_point = 8;

/// Texels anywhere in [0, 1].
std::vector<float> noise(std::size_t samples) {
  std::mt19937 random(7);
  std::vector<float> texels(samples);
  for (float& x : texels) x = static_cast<float>(random() >> 8) * 0x1p-24f;
  return texels;
}

/// Points with footprints of any shape, from none of a texel to the whole image, which long ones
/// take many probes of.
struct Points {
  std::vector<float> uv, dx, dy;

  Points() {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> place(-1.0f, 2.0f), octave(-9.0f, 1.0f);
    std::normal_distribution<float> direction;
    for (std::size_t i = 0; i < count; ++i) {
      const float along = std::exp2(octave(random)), across = std::exp2(octave(random));
      for (int k = 0; k < 2; ++k) {
        uv.push_back(place(random));
        dx.push_back(along * direction(random));
        dy.push_back(across * direction(random));
      }
    }
  }
};

class LiveFootprints : public ::testing::Test {
 protected:
  LiveFootprints() {
    const std::vector<float> texels = noise(64 * 40 * 3);
    system.set_image("painted", {64, 40, 3, NACRE_FLOAT32, texels.data(), 0});
    system.set_image("painted.r", {40, 64, 1, NACRE_FLOAT32, texels.data(), 0});
  }

  Shader compile(const CompileOptions& options) {
    return system.compile_outputs(Document::parse(document), {"image", "smooth", "split", "normal"},
                                  options);
  }

  /// Bits of all results. `limits`, `scales`: of each point, where they are varying.
  std::vector<std::uint32_t> run(const Shader& shader, const Instance* instance = nullptr,
                                 const std::vector<std::int32_t>& limits = {},
                                 const std::vector<float>& scales = {}) const {
    std::vector<float> results(numbers_a_point * count, -1.0f);
    Binder binder;
    binder.array("uv0", {0, 0, 8}).array("duv0dx", {1, 0, 8}).array("duv0dy", {2, 0, 8});
    binder.array("max_anisotropy", {3}).array("footprint_scale", {4});
    std::uint32_t first = 0;
    for (const char* name : {"image", "smooth", "split", "normal"}) {
      binder.array(name, {5, 4 * first, 4 * numbers_a_point});
      first += name == std::string("image") || name == std::string("normal") ? 3 : 1;
    }
    const auto address = [](const auto& numbers) {
      return const_cast<void*>(static_cast<const void*>(numbers.data()));
    };
    const std::vector<void*> arrays{address(points.uv), address(points.dx), address(points.dy),
                                    address(limits),    address(scales),    results.data()};
    Batch batch;
    batch.count = count;
    Binding(binder, shader).run(NACRE_OUTPUTS, arrays, batch, instance);
    std::vector<std::uint32_t> bits;
    for (const float x : results) bits.push_back(std::bit_cast<std::uint32_t>(x));
    return bits;
  }

  std::vector<std::uint32_t> run_with(const Shader& shader, std::optional<std::int32_t> limit,
                                      std::optional<float> scale) const {
    Instance instance(shader);
    if (limit) instance.set("max_anisotropy", *limit);
    if (scale) instance.set("footprint_scale", *scale);
    return run(shader, &instance);
  }

  System system;
  Points points;
};

/// All that can run a kernel.
std::vector<CompileOptions> all_engines() {
  std::vector<CompileOptions> engines(6);
  for (std::size_t i = 0; i < 4; ++i) engines[i].lanes = std::array{1, 4, 8, 16}[i];
  engines[4].engine = NACRE_INTERPRETER;
  engines[5].engine = NACRE_REFERENCE;
  return engines;
}

TEST_F(LiveFootprints, LimitsGiveTheBitsOfKernelsThatAreCompiledWithThem) {
  std::vector<std::vector<std::uint32_t>> seen;
  for (CompileOptions options : all_engines()) {
    options.live_footprints = true;
    const Shader live = compile(options);
    options.live_footprints = false;
    std::vector<std::uint32_t> all;
    for (const int most : {1, 2, 5, 31, 32}) {
      options.max_anisotropy = most;
      const auto expected = run(compile(options));
      ASSERT_EQ(run_with(live, most, {}), expected) << options.lanes << ' ' << most;
      all.insert(all.end(), expected.begin(), expected.end());
    }
    EXPECT_EQ(run_with(live, {}, {}), run_with(live, 32, {}));
    EXPECT_EQ(run_with(live, 1000, {}), run_with(live, 32, {}));
    EXPECT_EQ(run_with(live, -5, {}), run_with(live, 1, {}));
    EXPECT_NE(run_with(live, 1, {}), run_with(live, 32, {}));
    if (options.engine != NACRE_REFERENCE) seen.push_back(std::move(all));
  }
  for (const auto& bits : seen) EXPECT_EQ(bits, seen.front());
}

TEST_F(LiveFootprints, AScaleIsThatOfTheChangesThatAHostGives) {
  const Points given = points;
  std::vector<std::vector<std::uint32_t>> seen;
  for (CompileOptions options : all_engines()) {
    const Shader plain = compile(options);
    options.live_footprints = true;
    const Shader live = compile(options);
    std::vector<std::uint32_t> all;
    for (const float scale : {0.0f, 0.3f, 1.0f, 2.0f, 64.0f}) {
      // The oracle rounds no product.
      if (options.engine == NACRE_REFERENCE && scale == 0.3f) continue;
      points = given;
      const auto scaled = run_with(live, {}, scale);
      for (float& d : points.dx) d *= scale;
      for (float& d : points.dy) d *= scale;
      ASSERT_EQ(scaled, run(plain)) << options.lanes << ' ' << scale;
      all.insert(all.end(), scaled.begin(), scaled.end());
    }
    points = given;
    EXPECT_EQ(run_with(live, {}, {}), run(plain));
    EXPECT_EQ(run_with(live, {}, -1.0f), run_with(live, {}, 0.0f));
    EXPECT_EQ(run_with(live, {}, std::nanf("")), run_with(live, {}, 0.0f));
    options.no_footprints = true;
    EXPECT_EQ(run_with(live, {}, 0.0f), run(compile(options)));
    EXPECT_EQ(nacre_shader_parameter_count(compile(options).get()), 0u);
    if (options.engine != NACRE_REFERENCE) seen.push_back(std::move(all));
  }
  for (const auto& bits : seen) EXPECT_EQ(bits, seen.front());
}

TEST_F(LiveFootprints, ComeWithEachPoint) {
  std::vector<std::int32_t> limits;
  std::vector<float> scales;
  for (std::size_t i = 0; i < count; ++i) {
    limits.push_back(static_cast<std::int32_t>(1 + i * i % 7));
    scales.push_back(0.5f * static_cast<float>(i % 3));
  }
  for (CompileOptions options : all_engines()) {
    options.live_footprints = true;
    const Shader live = compile(options);
    options.varying = {"max_anisotropy", "footprint_scale"};
    const auto mixed = run(compile(options), nullptr, limits, scales);
    for (int limit = 1; limit < 8; ++limit) {
      for (const float scale : {0.0f, 0.5f, 1.0f}) {
        const auto all = run_with(live, limit, scale);
        for (std::size_t i = 0; i < count; ++i) {
          if (limits[i] != limit || scales[i] != scale) continue;
          for (std::size_t k = numbers_a_point * i; k < numbers_a_point * (i + 1); ++k) {
            ASSERT_EQ(mixed[k], all[k]) << options.lanes << ' ' << i;
          }
        }
      }
    }
  }
}

TEST_F(LiveFootprints, AreSlotsOfWhoReadsThem) {
  CompileOptions options;
  options.engine = NACRE_INTERPRETER;
  EXPECT_TRUE(compile(options).parameters().empty());
  options.live_footprints = true;
  options.max_anisotropy = 12;
  const Shader shader = compile(options);
  ASSERT_EQ(shader.parameters().size(), 2u);
  EXPECT_EQ(shader.parameters()[0].name, "footprint_scale");
  EXPECT_EQ(shader.parameters()[0].number_type, NACRE_FLOAT);
  EXPECT_EQ(shader.parameters()[1].name, "max_anisotropy");
  EXPECT_EQ(shader.parameters()[1].number_type, NACRE_INT);
  // A look-up of a level at a time has nothing to bound.
  options.max_anisotropy = 1;
  ASSERT_EQ(compile(options).parameters().size(), 1u);
  // Nor have points where nothing is filtered.
  const Document flat = Document::parse(R"(<materialx version="1.39">
    <constant name="c" type="float"/><output name="out" type="float" nodename="c"/></materialx>)");
  EXPECT_TRUE(system.compile_outputs(flat, {"out"}, options).parameters().empty());
}

/// Its red is the limit of a call, its green how u changes along x.
class Limits : public HostImage {
 public:
  int width() const override { return 640; }
  int height() const override { return 480; }
  void look_up(const nacre_texture_lookup& lookup, float* const* rgba) const noexcept override {
    for (int i = 0; i < lookup.count; ++i) {
      rgba[0][i] = static_cast<float>(lookup.max_anisotropy);
      rgba[1][i] = lookup.dudx[i];
      rgba[2][i] = lookup.u[i];
      rgba[3][i] = 1;
    }
  }
};

TEST_F(LiveFootprints, TextureSystemsAreToldOfThem) {
  SystemOptions hooked;
  hooked.textures = [](const std::string&, const std::string&) {
    return std::make_unique<Limits>();
  };
  System other(hooked);
  std::vector<std::int32_t> limits;
  std::vector<float> scales;
  for (std::size_t i = 0; i < count; ++i) {
    limits.push_back(static_cast<std::int32_t>(i / 5 % 10));
    scales.push_back(0.25f * static_cast<float>(i % 7));
  }
  for (CompileOptions options : all_engines()) {
    options.max_anisotropy = 6;
    options.live_footprints = true;
    options.varying = {"max_anisotropy", "footprint_scale"};
    const Shader each = other.compile_outputs(Document::parse(document), {"image"}, options);
    const auto bits = run(each, nullptr, limits, scales);
    options.varying = {};
    const Shader live = other.compile_outputs(Document::parse(document), {"image"}, options);
    const auto one = run_with(live, 3, 2.0f);
    options.live_footprints = false;
    const Shader plain = other.compile_outputs(Document::parse(document), {"image"}, options);
    const auto none = run(plain);
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = [&](const std::vector<std::uint32_t>& all, std::size_t k) {
        return std::bit_cast<float>(all[numbers_a_point * i + k]);
      };
      const auto limit = static_cast<float>(std::clamp(limits[i], 1, 6));
      ASSERT_EQ(number(bits, 0), limit) << options.lanes << ' ' << i;
      ASSERT_EQ(number(bits, 1), scales[i] * points.dx[2 * i]);
      ASSERT_EQ(number(bits, 2), points.uv[2 * i]);
      ASSERT_EQ(number(one, 0), 3.0f);
      ASSERT_EQ(number(one, 1), 2.0f * points.dx[2 * i]);
      ASSERT_EQ(number(none, 0), 6.0f);
      ASSERT_EQ(number(none, 1), points.dx[2 * i]);
    }
  }
}

}  // namespace
}  // namespace nacre
