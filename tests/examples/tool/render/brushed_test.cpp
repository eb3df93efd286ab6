// A card that is brushed around its middle, under a light far away: each pixel in closed form.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

constexpr int size = 48;      // Pixels.
constexpr int subpixels = 6;  // Along either side of a pixel, whose middles stand for it.
constexpr double along = 0.06, across = 0.3;  // Alpha.
constexpr double index = 1.5;
constexpr double pi = 3.14159265358979;

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector scaled(double s, const Vector& v) { return {s * v[0], s * v[1], s * v[2]}; }
Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector unit(const Vector& v) { return scaled(1.0 / std::sqrt(dot(v, v)), v); }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// What the document's direction has the opposite of.
const Vector to_light = unit({-0.5, 0.3, 1.0});

/// Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2),
/// 2014, equations 85, 86 and 99, and Fresnel's equations; directions by tangent, bitangent and
/// normal.
double brdf_times_cosine(const Vector& wo, const Vector& wi) {
  const Vector h = unit(sum(wo, wi));
  const double x = h[0] / along, y = h[1] / across;
  const double base = x * x + y * y + h[2] * h[2];
  const double facets = 1.0 / (pi * along * across * base * base);
  const auto lambda = [](const Vector& w) {
    const double slope = along * along * w[0] * w[0] + across * across * w[1] * w[1];
    return 0.5 * (std::sqrt(1.0 + slope / (w[2] * w[2])) - 1.0);
  };
  const double seen = 1.0 / (1.0 + lambda(wo) + lambda(wi));
  const double cosine = dot(wo, h);
  const double refracted = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
  const double s = (cosine - index * refracted) / (cosine + index * refracted);
  const double p = (index * cosine - refracted) / (index * cosine + refracted);
  return 0.5 * (s * s + p * p) * facets * seen / (4.0 * wo[2]);
}

/// Of what a pixel shows: light, distance from the middle, and the part of the half vector that is
/// along the brushing.
struct Shown {
  double light = 0.0, distance = 0.0, along_brushing = 0.0;
};

/// By the camera that a scene without one gets: from (0.55, 0.35, 1), 0.6 radians, around the
/// card's bounding sphere.
Shown expected(int column, int row) {
  const Vector eye = scaled(std::sqrt(2.0) / std::sin(0.3), unit({0.55, 0.35, 1.0}));
  const Vector forward = unit(scaled(-1.0, eye));
  const Vector right = unit(cross(forward, {0.0, 1.0, 0.0}));
  const Vector up = cross(right, forward);
  Shown shown;
  for (int i = 0; i < subpixels * subpixels; ++i) {
    const double x = column + (i % subpixels + 0.5) / subpixels;
    const double y = row + (i / subpixels + 0.5) / subpixels;
    const double step = 2.0 * std::tan(0.3) / size;
    const Vector way = sum(
        forward, sum(scaled((x - 0.5 * size) * step, right), scaled((0.5 * size - y) * step, up)));
    const Vector place = sum(eye, scaled(-eye[2] / way[2], way));
    const Vector wo = unit(scaled(-1.0, way));
    const Vector tangent = unit(cross({0.0, 0.0, 1.0}, place));
    const Vector bitangent = cross({0.0, 0.0, 1.0}, tangent);
    const auto local = [&](const Vector& v) {
      return Vector{dot(v, tangent), dot(v, bitangent), v[2]};
    };
    const double share = 1.0 / (subpixels * subpixels);
    shown.light += share * brdf_times_cosine(local(wo), local(to_light));
    shown.distance += share * std::hypot(place[0], place[1]);
    shown.along_brushing += share * dot(unit(sum(wo, to_light)), tangent);
  }
  return shown;
}

class Brushed : public Tool {
 protected:
  std::vector<float> rendered() {
    write("card.obj", "o card\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
    write("card.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">
      <position name="place" type="vector3">
        <input name="space" type="string" value="object"/></position>
      <crossproduct name="around" type="vector3">
        <input name="in1" type="vector3" value="0, 0, 1"/>
        <input name="in2" type="vector3" nodename="place"/></crossproduct>
      <normalize name="groove" type="vector3">
        <input name="in" type="vector3" nodename="around"/></normalize>
      <conductor_bsdf name="b" type="BSDF">
        <input name="ior" type="color3" value="1.5, 1.5, 1.5"/>
        <input name="extinction" type="color3" value="0, 0, 0"/>
        <input name="roughness" type="vector2" value="0.06, 0.3"/>
        <input name="tangent" type="vector3" nodename="groove"/></conductor_bsdf>
      <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
      <directional_light name="L" type="lightshader">
        <input name="color" type="color3" value="1, 1, 1"/>
        <input name="direction" type="vector3" value="0.5, -0.3, -1"/>
        <input name="intensity" type="float" value="1"/></directional_light></materialx>)");
    EXPECT_EQ(run("render " + file("card.mtlx") + " --scene " + file("card.obj") + " --out " +
                  file("a.exr") + " --size " + std::to_string(size) +
                  " --spp 256 --max-depth 1 --no-cache --environment-scale 0"),
              0)
        << errors_;
    const auto image = OIIO::ImageInput::open(file("a.exr"));
    if (image == nullptr) return {};
    std::vector<float> red(size * size);
    image->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, red.data());
    return red;
  }
};

TEST_F(Brushed, HighlightsRunAcrossTheBrushing) {
  const std::vector<float> picture = rendered();
  ASSERT_EQ(picture.size(), std::size_t{size * size});
  std::vector<Shown> all;
  for (int i = 0; i < size * size; ++i) all.push_back(expected(i % size, i / size));
  const auto is_meant = [&](int i) { return all[i].distance > 0.25 && all[i].distance < 0.9; };
  double brightest = 0.0;
  int where = -1;
  for (int i = 0; i < size * size; ++i) {
    if (!is_meant(i) || !(picture[i] > brightest)) continue;
    brightest = picture[i];
    where = i;
  }
  ASSERT_GE(where, 0);
  EXPECT_NEAR(all[where].along_brushing, 0.0, 0.02);
  int compared = 0;
  double dimmest = brightest;
  for (int i = 0; i < size * size; ++i) {
    if (!is_meant(i)) continue;
    dimmest = std::min(dimmest, double(picture[i]));
    if (all[i].light < 0.01 * brightest) continue;
    // A metal of so low an index sends next to nothing from facet to facet.
    EXPECT_NEAR(picture[i] / all[i].light, 1.0, 0.02) << i % size << ", " << i / size;
    ++compared;
  }
  EXPECT_GT(compared, 200);
  EXPECT_LT(dimmest, 0.02 * brightest);
}

}  // namespace
}  // namespace nacre
