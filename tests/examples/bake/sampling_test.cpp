// Texels as means of samples: what they converge to, and what that takes.
#include <bit>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "examples/bake/sample_set.h"
#include "tests/examples/bake/bake_fixture.h"
#include "tests/examples/bake/independent/polygon.h"

namespace nacre {
namespace {

using independent::Polygon;

/// The share of ones in each texel of a checker_nodes image, by its squares' areas in the texel.
std::vector<double> coverage(double degrees, double count, int size) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const double cosine = count * std::cos(angle);
  const double sine = count * std::sin(angle);
  std::vector<double> shares;
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const double u = double(i) / size, v = 1.0 - double(j + 1) / size, side = 1.0 / size;
      const Polygon texel{{u, v}, {u + side, v}, {u + side, v + side}, {u, v + side}};
      const int reach = static_cast<int>(2.0 * count) + 1;
      double ones = 0.0;
      for (int x = -reach; x <= reach; ++x) {
        // The node turns clockwise: x' = cos u + sin v, y' = -sin u + cos v.
        Polygon column = independent::clipped(texel, cosine, sine, x + 1);
        column = independent::clipped(column, -cosine, -sine, -x);
        if (column.empty()) continue;
        for (int y = -reach; y <= reach; ++y) {
          if ((x + y) % 2 == 0) continue;
          Polygon square = independent::clipped(column, -sine, cosine, y + 1);
          square = independent::clipped(square, sine, -cosine, -y);
          ones += independent::area(square);
        }
      }
      shares.push_back(ones / (side * side));
    }
  }
  return shares;
}

struct Difference {
  double most = 0.0;
  double rms = 0.0;
};

template <class Number>
Difference difference(const std::vector<float>& image, const std::vector<Number>& right) {
  Difference found;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double error = std::abs(static_cast<double>(image[i]) - static_cast<double>(right[i]));
    found.most = std::max(found.most, error);
    found.rms += error * error;
  }
  found.rms = std::sqrt(found.rms / static_cast<double>(image.size()));
  return found;
}

class Samples : public Bake {
 protected:
  struct Baked {
    std::vector<float> texels;
    host::BakeCounts counts;
    double samples_of_a_texel = 0.0;
  };

  /// One component, in blocks of so many rows.
  Baked bake(const OutputKernel& kernel, host::BakeSettings settings, int block_rows = 8) {
    Baked baked;
    const auto append = [&](host::BakedRows& rows) {
      return [&baked, plane = std::move(rows.planes[0])] {
        baked.texels.insert(baked.texels.end(), plane.begin(), plane.end());
        return true;
      };
    };
    const auto result = host::bake(kernel, 0, settings, block_rows, append, {}, &baked.counts);
    EXPECT_EQ(result, host::BakeResult::done);
    baked.samples_of_a_texel = double(baked.counts.samples) / double(baked.texels.size());
    return baked;
  }

  static host::BakeSettings of(int size, int count, float error = 0.0f) {
    host::BakeSettings settings;
    settings.width = settings.height = size;
    settings.sampling = {count, error};
    return settings;
  }
};

TEST_F(Samples, OfACheckerConvergeToItsCoverage) {
  const auto kernel = kernel_of(checker_nodes("20", "5"));
  ASSERT_NE(kernel, nullptr);
  const std::vector<double> right = coverage(20.0, 5.0, 32);
  double before = 1.0;
  double last = 1.0;
  for (const int count : {1, 16, 256, 4096, 65536}) {
    const Difference error = difference(bake(*kernel, of(32, count)).texels, right);
    EXPECT_LT(error.rms, 0.5 * before) << count;
    before = error.rms;
    last = error.most;
    if (count >= 4096) {
      EXPECT_LT(error.rms, 1e-3);
    }
  }
  EXPECT_LT(last, 1e-3);
}

/// Niederreiter's (0, m, 2)-nets: of 2^m places each dyadic rectangle of area 2^-m has one.
bool is_net(std::span<const host::SamplePlace> places) {
  const int m = std::countr_zero(places.size());
  for (int a = 0; a <= m; ++a) {
    std::set<std::pair<int, int>> cells;
    for (const host::SamplePlace& place : places) {
      cells.emplace(static_cast<int>(std::ldexp(place.x, a)),
                    static_cast<int>(std::ldexp(place.y, m - a)));
    }
    if (cells.size() != places.size()) return false;
  }
  return true;
}

TEST(SampleSequence, PowersOfTwoAreNetsAndFourAreInTheMiddle) {
  const std::vector<host::SamplePlace> places = host::sample_sequence(1024);
  for (std::size_t count = 1; count <= places.size(); count *= 2) {
    for (std::size_t from = 0; from < places.size(); from += count) {
      ASSERT_TRUE(is_net(std::span(places).subspan(from, count))) << count << " from " << from;
    }
  }
  for (std::size_t i = 0; i < places.size(); i += 4) {
    float x = 0.0f, y = 0.0f;
    for (std::size_t k = i; k < i + 4; ++k) {
      x += places[k].x;
      y += places[k].y;
    }
    EXPECT_NEAR(0.25f * x, 0.5f, 1e-4f) << i;
    EXPECT_NEAR(0.25f * y, 0.5f, 1e-4f) << i;
  }
}

/// Of (x - 1/2)^2 over the texel the mean is 1/12.
TEST(SampleSequence, ParabolasAreSoonExact) {
  const std::vector<host::SamplePlace> places = host::sample_sequence(256);
  for (const auto axis : {&host::SamplePlace::x, &host::SamplePlace::y}) {
    for (const std::size_t count : {16, 64, 256}) {
      double sum = 0.0;
      for (std::size_t i = 0; i < count; ++i) sum += std::pow(double(places[i].*axis) - 0.5, 2);
      const auto n = static_cast<double>(count);
      EXPECT_LT(std::abs(sum / n - 1.0 / 12.0), 0.25 / n) << count;
    }
  }
}

/// Of waves exp(i w x) around the texel's middle, whose mean over it is sinc(w_x / 2) sinc(w_y /
/// 2): the root of the mean square, for w at the crossings of a lattice.
double error_of_waves(std::span<const host::SamplePlace> places, double most) {
  const auto sinc = [](double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; };
  constexpr int side = 8;
  double squares = 0.0;
  for (int j = -side; j <= side; ++j) {
    for (int i = -side; i <= side; ++i) {
      const double wx = most * i / side, wy = most * j / side;
      std::complex<double> mean = 0.0;
      for (const host::SamplePlace& place : places) {
        mean += std::polar(1.0, wx * (double(place.x) - 0.5) + wy * (double(place.y) - 0.5));
      }
      mean /= static_cast<double>(places.size());
      squares += std::norm(mean - sinc(0.5 * wx) * sinc(0.5 * wy));
    }
  }
  return std::sqrt(squares);
}

TEST(SampleSequence, SlowWavesAreMoreExactThanOfAGrid) {
  const std::vector<host::SamplePlace> places = host::sample_sequence(16);
  for (const int count : {8, 16}) {
    for (const double most : {0.1, 0.5, 1.5}) {  // Radians a texel.
      const double of_grid = error_of_waves(host::sample_places(count), most);
      const auto first = std::span(places).first(static_cast<std::size_t>(count));
      EXPECT_LT(3.0 * error_of_waves(first, most), of_grid) << count << ", " << most;
    }
  }
}

TEST_F(Samples, OneIsInTheMiddle) {
  const auto kernel = kernel_of(
      "<texcoord name='t' type='vector2'/><extract name='n' "
      "type='float'><input name='in' type='vector2' nodename='t'/>"
      "<input name='index' type='integer' value='1'/></extract>");
  const std::vector<float> texels = bake(*kernel, of(7, 1)).texels;
  for (int j = 0; j < 7; ++j) {
    const float v = 1.0f - (static_cast<float>(j) + 0.5f) * (1.0f / 7.0f);
    EXPECT_EQ(texels[static_cast<std::size_t>(7 * j)], v);
  }
}

TEST_F(Samples, BitsDoNotDependOnThreadsOrBlocks) {
  const auto kernel = kernel_of(checker_nodes("33", "9"));
  for (const int count : {0, 1, 12}) {
    host::BakeSettings settings = of(61, count, 0.01f);
    settings.threads = 1;
    const std::vector<float> texels = bake(*kernel, settings, 61).texels;
    for (const int threads : {2, 5}) {
      settings.threads = threads;
      EXPECT_EQ(bake(*kernel, settings, 1).texels, texels) << count;
      EXPECT_EQ(bake(*kernel, settings, 16).texels, texels) << count;
    }
  }
}

/// A fixed grid of three times as many samples is less exact: by the same measure as the error
/// that was asked for, the root of the mean square over the texels.
TEST_F(Samples, AdaptiveTakesAThirdOfAGrids) {
  constexpr float asked = 0.002f;
  constexpr int size = 256;
  const std::string circles =
      "<tiledcircles name='c' type='color3'><input name='uvtiling' type='vector2' value='5, 5'/>"
      "<input name='size' type='float' value='0.3'/></tiledcircles><extract name='n' "
      "type='float'><input name='in' type='color3' nodename='c'/></extract>";
  const std::string line =
      "<line name='n' type='float'><input name='radius' type='float' value='0.05'/>"
      "<input name='point1' type='vector2' value='0.1, 0.2'/>"
      "<input name='point2' type='vector2' value='0.9, 0.7'/></line>";
  for (const std::string& nodes : {checker_nodes("20", "5"), circles, line}) {
    const auto kernel = kernel_of(nodes);
    ASSERT_NE(kernel, nullptr);
    const std::vector<float> right = bake(*kernel, of(size, 16384)).texels;
    const Baked adaptive = bake(*kernel, of(size, 0, asked));
    const int grid = static_cast<int>(3.0 * adaptive.samples_of_a_texel);
    const Difference error = difference(adaptive.texels, right);
    const Difference of_grid = difference(bake(*kernel, of(size, grid)).texels, right);
    std::printf("%.1f samples a texel: error %.5f, most %.4f; grid of %d: %.5f, most %.4f\n",
                adaptive.samples_of_a_texel, error.rms, error.most, grid, of_grid.rms,
                of_grid.most);
    EXPECT_LT(error.rms, asked);
    EXPECT_LT(error.rms, of_grid.rms);
  }
}

// An image makes nothing of an edge that no node filters: squares that agree may all lie beside it.
TEST_F(Samples, AdaptiveSeesEdgesBesideImages) {
  constexpr float asked = 0.004f;
  std::string checker = checker_nodes("20", "5");
  checker.replace(checker.find("<modulo name='n'"), 16, "<modulo name='m'");
  std::vector<unsigned char> texels(16, 255);
  texels[5] = 254;  // One value alone would be no image.
  const auto kernel =
      kernel_of(checker + grey_image(4, texels) +
                "<max name='one' type='float'><input name='in1' type='float' nodename='image'/>"
                "<input name='in2' type='float' value='1'/></max>"
                "<multiply name='n' type='float'><input name='in1' type='float' nodename='m'/>"
                "<input name='in2' type='float' nodename='one'/></multiply>");
  ASSERT_NE(kernel, nullptr);
  const std::vector<double> right = coverage(20.0, 5.0, 128);
  const Baked baked = bake(*kernel, of(128, 0, asked));
  std::size_t above = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (std::abs(double(baked.texels[i]) - right[i]) > double(asked)) ++above;
  }
  const Difference error = difference(baked.texels, right);
  std::printf("%.1f samples a texel: %zu above, most %.4f\n", baked.samples_of_a_texel, above,
              error.most);
  EXPECT_LT(above, right.size() / 100);
  // Edges of height 1 are looked into by 8 x 8 squares, beside whose middles are sixteenths.
  EXPECT_LT(error.most, 1.0 / 16.0);
}

TEST_F(Samples, AdaptiveSaysWhatItCouldNotDo) {
  const auto kernel = kernel_of(checker_nodes("20", "5"));
  EXPECT_GT(bake(*kernel, of(64, 0, 1e-5f)).counts.unfinished, 0u);
  EXPECT_EQ(bake(*kernel, of(64, 0, 0.1f)).counts.unfinished, 0u);
}

TEST_F(Samples, WhatHasNoMeanHasOne) {
  const auto kernel = kernel_of(
      "<texcoord name='t' type='vector2'/><extract name='e' type='float'>"
      "<input name='in' type='vector2' nodename='t'/></extract>"
      "<ifgreater name='n' type='integer'><input name='value1' "
      "type='float' nodename='e'/><input name='value2' type='float' "
      "value='0.45'/><input name='in1' type='integer' value='8'/>"
      "<input name='in2' type='integer' value='3'/></ifgreater>",
      "integer");
  ASSERT_NE(kernel, nullptr);
  const Baked baked = bake(*kernel, of(4, 64));
  EXPECT_EQ(baked.samples_of_a_texel, 1.0);
  for (const float texel : baked.texels) EXPECT_TRUE(texel == 8.0f || texel == 3.0f) << texel;
}

}  // namespace
}  // namespace nacre
