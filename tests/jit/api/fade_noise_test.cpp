// Noise that fades where points have an extent.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nacre/nacre.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace nacre {
namespace {

/// Octaves that a document names, and some that each point brings along.
constexpr const char* document = R"(<materialx version="1.39">
  <noise2d name="flat" type="float"/>
  <noise3d name="solid" type="vector3"/>
  <fractal2d name="cloth" type="float"><input name="octaves" type="integer" value="7"/></fractal2d>
  <fractal3d name="rock" type="float"><input name="octaves" type="integer" value="7"/></fractal3d>
  <geompropvalue name="count" type="integer"><input name="geomprop" type="string" value="n"/>
  </geompropvalue>
  <geompropvalue name="lacunarity" type="float"><input name="geomprop" type="string" value="l"/>
  </geompropvalue>
  <fractal3d name="any" type="vector3"><input name="octaves" type="integer" nodename="count"/>
    <input name="lacunarity" type="float" nodename="lacunarity"/></fractal3d>
  <output name="flat_out" type="float" nodename="flat"/>
  <output name="solid_out" type="vector3" nodename="solid"/>
  <output name="cloth_out" type="float" nodename="cloth"/>
  <output name="rock_out" type="float" nodename="rock"/>
  <output name="any_out" type="vector3" nodename="any"/>
</materialx>)";

using Columns = std::map<std::string, std::vector<float>>;

class FadeNoise : public ::testing::Test {
 protected:
  Shader compile(const std::string& output, bool fades, CompileOptions options = {}) {
    options.fade_noise = fades;
    return system.compile_outputs(Document::parse(document), {output}, options);
  }

  /// The output, component after component; columns that are not given are 0.
  static std::vector<float> run(const Shader& shader, const std::string& output, Columns columns,
                                std::size_t components = 1) {
    Binder binder;
    std::vector<void*> arrays;
    const std::size_t count = columns.begin()->second.size();
    for (auto& [name, column] : columns) {
      binder.array(name, {static_cast<std::uint32_t>(arrays.size())});
      arrays.push_back(column.data());
    }
    std::vector<float> results(components * count);
    for (std::size_t i = 0; i < components; ++i) {
      binder.array(components == 1 ? output : output + '.' + "xyz" [i],
                   { static_cast<std::uint32_t>(arrays.size()) });
      arrays.push_back(results.data() + i * count);
    }
    Batch batch;
    batch.count = count;
    Binding(binder, shader).run(NACRE_OUTPUTS, arrays, batch);
    return results;
  }

  System system;
};

/// Squares of any direction, `width` wide, around points in 200 cells: uv0 of two dimensions, else
/// Po.
struct Squares {
  Columns middles;
  std::string group;
  std::size_t dimensions;

  /// `other`: how wide they are across, of that; 0: lines.
  Squares(const std::string& group_name, std::size_t count, double width, double other = 1)
      : group(group_name), dimensions(group_name == "uv0" ? 2 : 3) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-100, 100);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, 3> x{}, y{};
      for (std::size_t k = 0; k < dimensions; ++k) x[k] = normal(random), y[k] = normal(random);
      const double along = (x[0] * y[0] + x[1] * y[1] + x[2] * y[2]) / squared(x);
      for (std::size_t k = 0; k < dimensions; ++k) y[k] -= along * x[k];
      const double to_x = width / std::sqrt(squared(x)),
                   to_y = other * width / std::sqrt(squared(y));
      for (std::size_t k = 0; k < dimensions; ++k) {
        const std::string c{'.', "xyz"[k]};
        middles[group + c].push_back(static_cast<float>(place(random)));
        middles["d" + group + "dx" + c].push_back(static_cast<float>(to_x * x[k]));
        middles["d" + group + "dy" + c].push_back(static_cast<float>(to_y * y[k]));
      }
    }
  }
  static double squared(const std::array<double, 3>& v) {
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  }

  /// Points of the squares, in [-1/2, 1/2]^2 of them; without an extent.
  Columns at(double s, double t) const {
    Columns moved;
    for (std::size_t k = 0; k < dimensions; ++k) {
      const std::string c{'.', "xyz"[k]};
      std::vector<float>& column = moved[group + c] = middles.at(group + c);
      for (std::size_t i = 0; i < column.size(); ++i) {
        column[i] +=
            static_cast<float>(s * static_cast<double>(middles.at("d" + group + "dx" + c)[i]) +
                               t * static_cast<double>(middles.at("d" + group + "dy" + c)[i]));
      }
    }
    return moved;
  }
};

/// Means over points: of the product of two columns.
double mean(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i]) * double(b[i]);
  return sum / static_cast<double>(a.size());
}

double squared_distance(const std::vector<float>& a, const std::vector<float>& b) {
  return mean(a, a) - 2 * mean(a, b) + mean(b, b);
}

/// Averages over the squares.
using Averages = std::vector<float>;

class FadeNoiseOfAverages : public FadeNoise {
 protected:
  static Averages average(const Shader& plain, const std::string& output, const Squares& squares,
                          int steps, std::size_t components = 1) {
    Averages sum;
    const float weight = 1.0f / static_cast<float>(steps * steps);
    for (int k = 0; k < steps * steps; ++k) {
      const double s = (k % steps + 0.5) / steps - 0.5, t = (k / steps + 0.5) / steps - 0.5;
      const auto part = run(plain, output, squares.at(s, t), components);
      sum.resize(part.size());
      for (std::size_t i = 0; i < part.size(); ++i) sum[i] += weight * part[i];
    }
    return sum;
  }

  /// How much more of noise of one octave is left by nodes/noise/fade.h than the share of a point's
  /// value that is nearest to the average around it: by least squares over 2,500 of them.
  double excess(const std::string& output, const std::string& group, double width, double other) {
    const std::size_t components = group == "Po" ? 3 : 1;
    const Shader plain = compile(output, false);
    const Squares squares(group, 2500, width, other);
    const auto middle = run(plain, output, squares.at(0, 0), components);
    const Averages averages = average(plain, output, squares, 8, components);
    const auto left = run(compile(output, true), output, squares.middles, components);
    return (mean(left, middle) - mean(averages, middle)) / mean(middle, middle);
  }
};

const std::pair<const char*, const char*> one_octave[]{{"flat_out", "uv0"}, {"solid_out", "Po"}};

TEST_F(FadeNoiseOfAverages, OfSquaresIsTheShareThatTellsMost) {
  for (const auto& [output, group] : one_octave) {
    for (const double width : {0.125, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0}) {
      EXPECT_NEAR(excess(output, group, width, 1.0), 0.0, 0.07) << output << ' ' << width;
    }
  }
}

/// Noise that nearly cancels along a line is left out: it is never more than there is.
TEST_F(FadeNoiseOfAverages, OfLinesIsLess) {
  for (const auto& [output, group] : one_octave) {
    for (const double width : {0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0}) {
      const double found = excess(output, group, width, 0.0);
      EXPECT_LT(found, 0.03) << output << ' ' << width;
      EXPECT_GT(found, -0.25) << output << ' ' << width;
    }
  }
}

/// With octaves: nearer to the average, where squares cover cells of some of them.
TEST_F(FadeNoiseOfAverages, FractalsAreNearer) {
  const std::pair<const char*, const char*> kinds[]{{"cloth_out", "uv0"}, {"rock_out", "Po"}};
  for (const auto& [output, group] : kinds) {
    const Shader plain = compile(output, false);
    const Shader fading = compile(output, true);
    for (const double width : {0.1, 0.5}) {
      const Squares squares(group, 1000, width);
      const auto middle = run(plain, output, squares.at(0, 0));
      const Averages averages = average(plain, output, squares, 16);
      const auto faded = run(fading, output, squares.middles);
      EXPECT_LT(squared_distance(faded, averages), 0.35 * squared_distance(middle, averages))
          << output << ' ' << width;
    }
  }
}

/// Bits of results.
std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  for (const float x : values) bits.push_back(std::bit_cast<std::uint32_t>(x));
  return bits;
}

TEST_F(FadeNoise, PointsWithoutAnExtentHaveAllOfIt) {
  Squares squares("Po", 203, 0);
  squares.middles.merge(Columns(Squares("uv0", 203, 0).middles));
  squares.middles["geomprop.l"] = std::vector<float>(203, 2.0f);
  squares.middles["geomprop.n"] = std::vector<float>(203, std::bit_cast<float>(5));
  for (const char* output : {"flat_out", "solid_out", "cloth_out", "rock_out", "any_out"}) {
    const std::size_t components =
        output == std::string("solid_out") || output == std::string("any_out") ? 3 : 1;
    const auto all = bits_of(run(compile(output, false), output, squares.middles, components));
    EXPECT_EQ(bits_of(run(compile(output, true), output, squares.middles, components)), all);
    CompileOptions none;
    none.no_footprints = true;
    EXPECT_EQ(bits_of(run(compile(output, true, none), output, squares.middles, components)), all);
  }
}

/// Points of all sizes beside each other, hostile ones among them.
TEST_F(FadeNoise, EnginesAndWidthsGiveTheSameBits) {
  Columns points;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-9, 9), octave(-12, 4);
  constexpr float hostile[]{0.0f, std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN(), 3e38f, -1e-30f};
  for (int i = 0; i < 1009; ++i) {
    for (const char* name : {"uv0.x", "uv0.y", "Po.x", "Po.y", "Po.z"})
      points[name].push_back(place(random));
    for (const char* name : {"duv0dx.x", "duv0dx.y", "duv0dy.x", "duv0dy.y", "dPodx.x", "dPody.y",
                             "dPodx.z", "dPody.z", "dPodx.y", "dPody.x"}) {
      points[name].push_back(i % 5 == 4 ? hostile[random() % 5] : std::exp2(octave(random)));
    }
    points["geomprop.l"].push_back(i % 7 == 6 ? hostile[random() % 5]
                                              : 0.25f * static_cast<float>(random() % 16));
    points["geomprop.n"].push_back(std::bit_cast<float>(static_cast<std::int32_t>(random() % 9)));
  }
  std::vector<CompileOptions> engines(5);
  for (std::size_t i = 0; i < 4; ++i) engines[i].lanes = std::array{1, 4, 8, 16}[i];
  engines[4].engine = NACRE_INTERPRETER;
  for (const char* output : {"flat_out", "solid_out", "cloth_out", "rock_out", "any_out"}) {
    const std::size_t components =
        output == std::string("solid_out") || output == std::string("any_out") ? 3 : 1;
    const auto first = run(compile(output, true, engines[4]), output, points, components);
    for (const float x : first) ASSERT_TRUE(std::isfinite(x)) << output;
    for (const CompileOptions& engine : engines) {
      EXPECT_EQ(bits_of(run(compile(output, true, engine), output, points, components)),
                bits_of(first))
          << output << ' ' << engine.lanes;
    }
  }
}

}  // namespace
}  // namespace nacre
