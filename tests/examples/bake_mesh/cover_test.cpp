// Which texels a layout covers and what is in them, beside triangles cut by squares.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "examples/bake_mesh/texel_cover.h"
#include "tests/examples/bake_mesh/mesh_samples.h"

namespace nacre::host {
namespace {

using Polygon = std::vector<FlatPlace>;

/// What is left of a polygon where `inside` is not negative (Sutherland and Hodgman 1974).
template <class Inside>
Polygon cut(const Polygon& polygon, Inside inside) {
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const FlatPlace a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double at_a = inside(a), at_b = inside(b);
    if (at_a >= 0.0) left.push_back(a);
    if ((at_a >= 0.0) == (at_b >= 0.0)) continue;
    const double t = at_a / (at_a - at_b);
    left.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
  }
  return left;
}

/// The area of a triangle within the texel at (x, y).
double area_within(const Polygon& triangle, double x, double y) {
  Polygon part = triangle;
  part = cut(part, [&](FlatPlace p) { return p.x - x; });
  part = cut(part, [&](FlatPlace p) { return x + 1 - p.x; });
  part = cut(part, [&](FlatPlace p) { return p.y - y; });
  part = cut(part, [&](FlatPlace p) { return y + 1 - p.y; });
  double twice = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const FlatPlace a = part[i], b = part[(i + 1) % part.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(0.5 * twice);
}

bool is_inside(const Polygon& triangle, FlatPlace p) {
  const auto side = [&](std::size_t i) {
    const FlatPlace a = triangle[i], b = triangle[(i + 1) % 3];
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  return (side(0) > 0 && side(1) > 0 && side(2) > 0) || (side(0) < 0 && side(1) < 0 && side(2) < 0);
}

/// The distance of p from a triangle, 0 inside, by a search along its edges.
double distance(const Polygon& triangle, FlatPlace p) {
  if (is_inside(triangle, p)) return 0.0;
  double least = 1e9;
  constexpr int steps = 2000;
  for (std::size_t i = 0; i < 3; ++i) {
    const FlatPlace a = triangle[i], b = triangle[(i + 1) % 3];
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      least = std::min(least, std::hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y));
    }
  }
  return least;
}

class Cover : public ::testing::Test {
 protected:
  void lay_out(Mesh mesh, int width, int height) {
    scene_ = scene_of(std::move(mesh));
    layout_ =
        std::make_unique<UvLayout>(scene_, std::vector<std::uint32_t>{0}, 0, "a.obj", diagnostics_);
    index_ = std::make_unique<RowIndex>(*layout_, MapFrame{width, height, {}});
  }
  /// In texels.
  Polygon triangle(std::size_t i) const {
    const Mesh& mesh = scene_.meshes[0];
    const MapFrame& frame = index_->frame();
    Polygon polygon;
    for (const std::uint32_t v : mesh.triangles[i].v) {
      polygon.push_back(
          {double(mesh.uv[v].x) * frame.width, (1.0 - double(mesh.uv[v].y)) * frame.height});
    }
    return polygon;
  }

  Scene scene_;
  Diagnostics diagnostics_;
  std::unique_ptr<UvLayout> layout_;
  std::unique_ptr<RowIndex> index_;
};

TEST_F(Cover, HasEveryTexelThatATriangleHasPartOf) {
  constexpr int width = 37, height = 29;
  lay_out(random_triangles(12, 1), width, height);
  TexelCover whole(*index_), part(*index_);
  whole.enter(0, height);
  for (int y = 0; y < height; ++y) {
    if (y % 5 == 0) part.enter(y, std::min(5, height - y));
    for (int x = 0; x < width; ++x) {
      double most = 0.0;
      for (std::size_t i = 0; i < 12; ++i) most = std::max(most, area_within(triangle(i), x, y));
      const auto texel = static_cast<std::size_t>(y * width + x);
      // What is smaller than rounding is either.
      if (most > 0.0 && most < 1e-9) continue;
      EXPECT_EQ(whole.covers(texel), most > 0.0) << x << ' ' << y << ' ' << most;
      EXPECT_EQ(part.covers(texel), most > 0.0) << x << ' ' << y;
    }
  }
}

TEST_F(Cover, IsTheFirstTriangleAtAPlaceOrThePointNextToTheMiddle) {
  constexpr int width = 23, height = 31;
  lay_out(random_triangles(9, 2), width, height);
  TexelCover cover(*index_);
  cover.enter(0, height);
  int beside = 0;
  for (std::size_t texel = 0; texel < width * height; ++texel) {
    if (!cover.covers(texel)) continue;
    const FlatPlace middle{static_cast<double>(texel % width) + 0.5,
                           static_cast<double>(texel / width) + 0.5};
    const CoverPoint point = cover.at(texel, middle);
    double least = 1e9;
    std::size_t first = 0;
    for (std::size_t i = 0; i < 9; ++i) {
      if (area_within(triangle(i), middle.x - 0.5, middle.y - 0.5) == 0.0) continue;
      const double d = distance(triangle(i), middle);
      if (d < least) first = i;
      least = std::min(least, d);
    }
    const Polygon corners = triangle(point.piece);
    const double b0 = 1.0 - point.weights.b1 - point.weights.b2;
    EXPECT_GE(std::min({b0, point.weights.b1, point.weights.b2}), -1e-12);
    const double x =
        b0 * corners[0].x + point.weights.b1 * corners[1].x + point.weights.b2 * corners[2].x;
    const double y =
        b0 * corners[0].y + point.weights.b1 * corners[1].y + point.weights.b2 * corners[2].y;
    EXPECT_EQ(point.is_inside, least == 0.0);
    if (least == 0.0) {
      EXPECT_EQ(point.piece, first);
    }
    EXPECT_NEAR(std::hypot(x - middle.x, y - middle.y), least, 1e-2);
    beside += point.is_inside ? 0 : 1;
  }
  EXPECT_GT(beside, 20);
}

TEST_F(Cover, NeighboursDoNotOverlapAndTwiceTheSameDoes) {
  lay_out(make_sphere("ball", {}, 1.0f, 24), 200, 100);
  EXPECT_TRUE(find_overlaps(*index_).empty());
  Mesh twice = make_sphere("ball", {}, 1.0f, 24);
  const std::vector<Triangle> once = twice.triangles;
  twice.triangles.insert(twice.triangles.end(), once.begin(), once.begin() + 40);
  lay_out(std::move(twice), 200, 100);
  const std::vector<Overlap> overlaps = find_overlaps(*index_);
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_EQ(overlaps[0].mesh, 0u);
  EXPECT_EQ(overlaps[0].other, 0u);
  // Middles that these have, counted one by one.
  std::size_t texels = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      const FlatPlace middle{x + 0.5, y + 0.5};
      for (std::size_t i = 0; i < 40; ++i) {
        if (!is_inside(triangle(i), middle)) continue;
        ++texels;
        break;
      }
    }
  }
  EXPECT_EQ(overlaps[0].texels, texels);
}

}  // namespace
}  // namespace nacre::host
