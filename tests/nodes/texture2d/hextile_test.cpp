#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nodes/nodes.h"
#include "tests/nodes/texture2d/lookups.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

struct Parameters {
  std::array<float, 2> tiling{1, 1};
  float rotation = 1;
  std::array<float, 2> rotation_range{0, 360};
  float scale = 1;
  std::array<float, 2> scale_range{0.5f, 2};
  float offset = 1;
  std::array<float, 2> offset_range{0, 1};
  float falloff = 0.5f;
  float falloff_contrast = 0.5f;
};

using Vec = std::array<double, 3>;

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec scaled(const Vec& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Vec plus(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec unit(const Vec& a) { return scaled(a, 1 / std::sqrt(dot(a, a))); }

float fract32(float x) { return x - std::floor(x); }

/// The hash in binary32, one operation after the other.
std::array<float, 2> hash(float i, float j) {
  const float x = i + 0.12345f;
  const float y = j + 0.12345f;
  float a = fract32(x * 0.1031f);
  float b = fract32(y * 0.1030f);
  float c = fract32(x * 0.0973f);
  const float d = a * (b + 33.33f) + b * (c + 33.33f) + c * (a + 33.33f);
  a += d;
  b += d;
  c += d;
  return {fract32((a + b) * c), fract32((a + c) * b)};
}

struct Copy {
  double weight = 0;
  double u = 0;
  double v = 0;
  double angle = 0;  ///< Radians.
};

/// Every vertex of the lattice whose hexagon reaches the point: the hat functions of a
/// triangulation, 1 - max(|a|, |b|, |a + b|) in the skewed coordinates (a, b) from it.
std::vector<Copy> copies_at(double u, double v, const Parameters& p) {
  const double lattice = 2 * std::sqrt(3.0);
  const double x = u * p.tiling[0];
  const double y = 1 - v * p.tiling[1];  // The library's renderers count v from the top.
  const double skewed_x = lattice * (x - y * std::tan(std::numbers::pi / 6));
  const double skewed_y = lattice * y / std::cos(std::numbers::pi / 6);
  std::vector<Copy> copies;
  for (double i = std::floor(skewed_x) - 1; i <= std::floor(skewed_x) + 2; ++i) {
    for (double j = std::floor(skewed_y) - 1; j <= std::floor(skewed_y) + 2; ++j) {
      const double a = skewed_x - i;
      const double b = skewed_y - j;
      const double weight = 1 - std::max({std::fabs(a), std::fabs(b), std::fabs(a + b)});
      if (weight <= 0) continue;
      const auto random = hash(static_cast<float>(i), static_cast<float>(j));
      const auto mix = [](double from, double to, double t) { return from + (to - from) * t; };
      const double angle = std::numbers::pi / 180 *
                           mix(p.rotation_range[0], p.rotation_range[1], random[0] * p.rotation);
      const double size = mix(1, mix(p.scale_range[0], p.scale_range[1], random[1]), p.scale);
      const double centre_x = (i + 0.5 * j) / lattice;
      const double centre_y = j * std::cos(std::numbers::pi / 6) / lattice;
      const double s = std::sin(angle);
      const double c = std::cos(angle);
      const double dx = x - centre_x;
      const double dy = y - centre_y;
      copies.push_back({weight,
                        (dx * c - dy * s) / size + centre_x +
                            mix(p.offset_range[0], p.offset_range[1], random[0] * p.offset),
                        1 - ((dx * s + dy * c) / size + centre_y +
                             mix(p.offset_range[0], p.offset_range[1], random[1] * p.offset)),
                        angle});
    }
  }
  return copies;
}

/// Weights of up to three copies; `emphasis` one factor each.
std::vector<double> blend(const std::vector<Copy>& copies, const std::vector<double>& emphasis,
                          double falloff) {
  std::vector<double> w;
  const auto to_one = [&] {
    double sum = 0;
    for (const double x : w) sum += x;
    for (double& x : w) x /= sum;
  };
  for (std::size_t k = 0; k < copies.size(); ++k) {
    w.push_back(emphasis[k] * std::pow(copies[k].weight, 7));
  }
  to_one();
  if (falloff == 0.5) return w;
  for (double& x : w) {
    const double slope = (1 / std::clamp(falloff, 0.001, 0.999) - 2) * (1 - 2 * x);
    x = x < 0.5 ? x / (slope + 1) : (slope - x) / (slope - 1);
  }
  to_one();
  return w;
}

class HextileTest : public testing::Test {
 protected:
  void SetUp() override {
    path_ = folder_.file("a.exr");
    WriteOptions options;
    options.type = "float";
    TestImage image = random_image(8, 8, 4, 255);
    // Smooth, so that a small error of a coordinate is a small error of the result.
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const double phase = std::numbers::pi / 4;
        image.at(x, y, 0) = static_cast<float>(0.5 + 0.4 * std::sin(phase * x));
        image.at(x, y, 1) = static_cast<float>(0.5 + 0.4 * std::cos(phase * y + 0.3));
        image.at(x, y, 2) = static_cast<float>(0.8 + 0.1 * std::sin(phase * (x + y)));
        image.at(x, y, 3) = static_cast<float>(0.5 + 0.4 * std::sin(phase * (x - y) + 1));
      }
    }
    ASSERT_TRUE(write_image(path_, image, options));
    reference_ = ReferenceSampler::open(path_);
    ASSERT_TRUE(reference_.has_value());
  }

  std::vector<std::array<float, 4>> run(std::string_view category, Type type, const Parameters& p,
                                        const LookupPoints& points,
                                        const std::vector<NodeCall::Port>& more) {
    const RecordedLookup lookup(store_, [&](Recorder& recorder, TextureProvider& textures,
                                            Float2 uv) {
      const auto pair = [](const std::array<float, 2>& v) {
        return Recorded(Type::vector2, Float2{v[0], v[1]});
      };
      Recorded file;
      file.type = Type::filename;
      file.text = path_;
      Recorded fallback;
      fallback.type = type;
      fallback.parts.resize(static_cast<std::size_t>(component_count(type)), Float(0.25f).ref());
      std::vector<NodeCall::Port> inputs{{"file", file},
                                         {"default", fallback},
                                         {"texcoord", Recorded(Type::vector2, uv)},
                                         {"tiling", pair(p.tiling)},
                                         {"rotation", Recorded(Type::float_, Float(p.rotation))},
                                         {"rotationrange", pair(p.rotation_range)},
                                         {"scale", Recorded(Type::float_, Float(p.scale))},
                                         {"scalerange", pair(p.scale_range)},
                                         {"offset", Recorded(Type::float_, Float(p.offset))},
                                         {"offsetrange", pair(p.offset_range)},
                                         {"falloff", Recorded(Type::float_, Float(p.falloff))}};
      inputs.insert(inputs.end(), more.begin(), more.end());
      Recorded out;
      out.type = type;
      NodeCall call(recorder, category, "ND", std::move(inputs), {{"out", out}}, Accuracy::precise,
                    &textures, diagnostics_, {});
      const auto& all = standard_nodes();
      std::ranges::find_if(all, [&](const NodeBody& b) {
        return b.category == category;
      })->record(call);
      const auto& parts = call.outputs().front().value.parts;
      return Float4{Float(parts[0]), Float(parts[1]), Float(parts[2]),
                    parts.size() > 3 ? Float(parts[3]) : 0.0f};
    });
    return lookup.run(points);
  }

  std::vector<std::array<float, 4>> image(const Parameters& p, const LookupPoints& points) {
    return run("hextiledimage", Type::color4, p, points,
               {{"falloffcontrast", Recorded(Type::float_, Float(p.falloff_contrast))},
                {"lumacoeffs", Recorded(Type::color3, Float3(luma_[0], luma_[1], luma_[2]))}});
  }

  Rgba64 texel(const Copy& copy) const { return reference_->sample(copy.u, copy.v, {}, {}, {}); }

  Rgba64 expected_image(double u, double v, const Parameters& p) const {
    const std::vector<Copy> copies = copies_at(u, v, p);
    std::vector<double> emphasis;
    for (const Copy& copy : copies) {
      const Rgba64 c = texel(copy);
      const double luminance = luma_[0] * c[0] + luma_[1] * c[1] + luma_[2] * c[2];
      emphasis.push_back(1 + p.falloff_contrast * (luminance - 1));
    }
    const auto w = blend(copies, emphasis, p.falloff);
    const auto aw = blend(copies, std::vector<double>(copies.size(), 1), p.falloff);
    Rgba64 sum{};
    for (std::size_t k = 0; k < copies.size(); ++k) {
      const Rgba64 c = texel(copies[k]);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += w[k] * c[i];
      sum[3] += aw[k] * c[3];
    }
    return sum;
  }

  static LookupPoints some_points() {
    LookupPoints points;
    for (int i = 0; i < 400; ++i) {
      points.add(std::fmod(0.6180339f * static_cast<float>(i), 3.0f) - 1.0f,
                 std::fmod(0.4142135f * static_cast<float>(i), 3.0f) - 1.0f);
    }
    return points;
  }

  TemporaryFolder folder_;
  std::string path_;
  TextureStore store_;
  Diagnostics diagnostics_;
  std::optional<ReferenceSampler> reference_;
  std::array<float, 3> luma_{0.2722287f, 0.6740818f, 0.0536895f};
};

const std::array<Parameters, 5> cases{
    Parameters{},
    Parameters{.tiling = {2.5f, -1.5f}, .falloff = 0.2f, .falloff_contrast = 1},
    Parameters{.rotation = 0.3f, .rotation_range = {-700, 45}, .scale = 0, .offset = 0},
    Parameters{.rotation = 0, .scale_range = {0.9f, 1.1f}, .offset_range = {-3, 2}, .falloff = 2},
    Parameters{.falloff = 0, .falloff_contrast = 0},
};

// Coordinates are of the order of 5, rounded in binary32 and magnified by up to 2, with 8
// texels a unit that differ by up to 0.4; weights^7 add their share.
TEST_F(HextileTest, ImageIsTheBlendOfCopiesOnALattice) {
  const LookupPoints points = some_points();
  for (const Parameters& p : cases) {
    const auto values = image(p, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Rgba64 expected = expected_image(points.u[i], points.v[i], p);
      for (std::size_t c = 0; c < 4; ++c) {
        ASSERT_NEAR(values[i][c], expected[c], 2e-5)
            << "case " << &p - cases.data() << " at " << points.u[i] << ' ' << points.v[i];
      }
    }
  }
}

// Each copy's frame turns with its image.
TEST_F(HextileTest, NormalMapBlendsSurfaceGradients) {
  const LookupPoints points = some_points();
  const Vec n = unit({0.2, -0.3, 0.9});
  const Vec t = unit({n[2], 0, -n[0]});
  const Vec b{n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]};
  const auto literal = [](const Vec& v) {
    return Recorded(Type::vector3, Float3(v[0], v[1], v[2]));
  };
  constexpr float strength = 0.7f;
  for (const bool flip : {false, true}) {
    for (const Parameters& p : cases) {
      const auto values = run("hextilednormalmap", Type::vector3, p, points,
                              {{"strength", Recorded(Type::float_, Float(strength))},
                               {"flip_g", Recorded(Type::boolean, Bool(flip))},
                               {"normal", literal(n)},
                               {"tangent", literal(t)},
                               {"bitangent", literal(b)}});
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto copies = copies_at(points.u[i], points.v[i], p);
        const auto w = blend(copies, std::vector<double>(copies.size(), 1), p.falloff);
        Vec sum = n;
        for (std::size_t k = 0; k < copies.size(); ++k) {
          const Rgba64 c = texel(copies[k]);
          const double x = strength * (2 * c[0] - 1);
          const double y = strength * (flip ? 1 - 2 * c[1] : 2 * c[1] - 1);
          // In an orthonormal frame, turning the frame is turning the vector's components.
          const double cosine = std::cos(copies[k].angle);
          const double sine = std::sin(copies[k].angle);
          const Vec m =
              unit(plus(plus(scaled(t, x * cosine - y * sine), scaled(b, x * sine + y * cosine)),
                        scaled(n, 2 * c[2] - 1)));
          const double d = dot(n, m);
          const Vec gradient =
              scaled(plus(scaled(n, d), scaled(m, -1)), 1 / std::max(1e-8, std::fabs(d)));
          sum = plus(sum, scaled(gradient, -std::clamp(w[k], 0.0, 1.0)));
        }
        const Vec expected = unit(sum);
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_NEAR(values[i][c], expected[c], 1e-4)
              << "case " << &p - cases.data() << " at " << points.u[i] << ' ' << points.v[i];
        }
      }
    }
  }
}

TEST_F(HextileTest, MissingImageIsTheDefault) {
  path_ = folder_.file("absent.exr");
  for (const auto& value : image({}, some_points())) {
    EXPECT_EQ(value, (std::array<float, 4>{0.25f, 0.25f, 0.25f, 0.25f}));
  }
}

// No luminance anywhere: the weights have no sum to be divided by.
TEST_F(HextileTest, BlackStaysBlack) {
  TestImage black{2, 2, 3, std::vector<float>(12, 0.0f)};
  path_ = folder_.file("black.png");
  ASSERT_TRUE(write_image(path_, black));
  for (const auto& value : image({.falloff_contrast = 1}, some_points())) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(value[c], 0.0f);
    EXPECT_NEAR(value[3], 1, 2e-7);
  }
}

}  // namespace
}  // namespace nacre
