// Solids within one another, through the tool: the look's property dielectric_priority.
#include <OpenImageIO/imageio.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

/// A ball as an object of an OBJ file, whose vertices begin at `first`; that of the next is set.
std::string ball_of(const std::string& name, double y, double radius, int& first) {
  constexpr int rings = 24, steps = 48;
  std::string text = "o " + name + "\n";
  const auto vertex = [&](double theta, double phi) {
    text += "v " + std::to_string(radius * std::sin(theta) * std::cos(phi)) + ' ' +
            std::to_string(y + radius * std::cos(theta)) + ' ' +
            std::to_string(radius * std::sin(theta) * std::sin(phi)) + '\n';
  };
  for (int i = 1; i < rings; ++i) {
    for (int k = 0; k < steps; ++k) {
      vertex(std::numbers::pi * i / rings, 2 * std::numbers::pi * k / steps);
    }
  }
  vertex(0, 0), vertex(std::numbers::pi, 0);
  const int north = first + (rings - 1) * steps, south = north + 1;
  const auto at = [&](int i, int k) { return std::to_string(first + i * steps + k % steps); };
  for (int k = 0; k < steps; ++k) {
    text += "f " + std::to_string(north) + ' ' + at(0, k + 1) + ' ' + at(0, k) + '\n';
    for (int i = 0; i + 2 < rings; ++i) {
      text +=
          "f " + at(i, k) + ' ' + at(i, k + 1) + ' ' + at(i + 1, k + 1) + ' ' + at(i + 1, k) + '\n';
    }
    text +=
        "f " + std::to_string(south) + ' ' + at(rings - 2, k) + ' ' + at(rings - 2, k + 1) + '\n';
  }
  first = south + 1;
  return text;
}

struct Ball {
  std::string name;
  double y, radius;
};
std::string balls(const std::vector<Ball>& all) {
  std::string text;
  int first = 1;
  for (const Ball& each : all) text += ball_of(each.name, each.y, each.radius, first);
  return text;
}

/// In a look: a material on the object of its name, and its priority.
std::string assigned(const std::string& material, const std::string& priority,
                     const std::string& type = "integer") {
  return "<materialassign name=\"m" + material + "\" material=\"" + material + "\" geom=\"/" +
         material + "\"/><propertyassign name=\"p" + material +
         "\" property=\"dielectric_priority\" type=\"" + type + "\" value=\"" + priority +
         "\" geom=\"/" + material + "\"/>";
}

class Nested : public Tool {
 protected:
  /// Glass of an index, full of what absorbs as much.
  static std::string glass(const std::string& name, const std::string& ior,
                           const std::string& alpha = "0, 0",
                           const std::string& absorption = "0, 0, 0") {
    return "<dielectric_bsdf name=\"d" + name + R"(" type="BSDF">
        <input name="scatter_mode" type="string" value="RT"/>
        <input name="roughness" type="vector2" value=")" +
           alpha + R"("/><input name="ior" type="float" value=")" + ior +
           R"("/></dielectric_bsdf><absorption_vdf name="a)" + name + R"(" type="VDF">
        <input name="absorption" type="vector3" value=")" +
           absorption + R"("/></absorption_vdf><layer name="l)" + name + R"(" type="BSDF">
        <input name="top" type="BSDF" nodename="d)" +
           name + R"("/><input name="base" type="VDF" nodename="a)" + name +
           R"("/></layer><surface name="s)" + name + R"(" type="surfaceshader">
        <input name="bsdf" type="BSDF" nodename="l)" +
           name + R"("/></surface><surfacematerial name=")" + name + R"(" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s)" +
           name + R"("/></surfacematerial>)";
  }
  int render(const std::string& materials, const std::string& look, const std::string& scene,
             const std::string& flags = "") {
    write("a.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">)" + materials +
                        "<look name=\"looks\">" + look + "</look></materialx>");
    write("a.obj", scene);
    const float white[] = {1, 1, 1};
    const auto sky = OIIO::ImageOutput::create(file("white.exr"));
    sky->open(file("white.exr"), OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::FLOAT));
    sky->write_image(OIIO::TypeDesc::FLOAT, white);
    sky->close();
    return run("render " + file("a.mtlx") + " --scene " + file("a.obj") + " --environment " +
               file("white.exr") + " --size 32 --no-cache --max-depth 200 --out " + file("a.exr") +
               ' ' + flags);
  }
  /// Of the middle of the picture, by channel.
  std::array<double, 3> light(int border) const {
    std::vector<float> texels(32 * 32 * 3);
    const auto in = OIIO::ImageInput::open(file("a.exr"));
    if (in == nullptr) return {};
    in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, texels.data());
    std::array<double, 3> sum{};
    const int side = 32 - 2 * border;
    for (int y = border; y < 32 - border; ++y) {
      for (int x = border; x < 32 - border; ++x) {
        for (int c = 0; c < 3; ++c) {
          const std::size_t at = static_cast<std::size_t>(3 * (32 * y + x) + c);
          sum[static_cast<std::size_t>(c)] += static_cast<double>(texels[at]) / (side * side);
        }
      }
    }
    return sum;
  }
};

/// A glass with air in it, a drink in that, and ice in the drink: one over the other.
std::string drink() {
  return balls({{"glass", 0, 2}, {"air", 0, 1.9}, {"drink", -0.5, 1.45}, {"ice", 0.5, 0.6}});
}

std::string look_of_drink() {
  return assigned("glass", "3") + assigned("air", "4") + assigned("drink", "5") +
         assigned("ice", "6");
}

// White furnace: nothing is lost, whatever is in what.
TEST_F(Nested, AGlassOfADrinkLosesNoLight) {
  ASSERT_EQ(render(glass("glass", "1.5") + glass("air", "1") + glass("drink", "1.33") +
                       glass("ice", "1.31"),
                   look_of_drink(), drink(), "--spp 64"),
            0)
      << errors_;
  EXPECT_EQ(errors_, "");
  for (const double each : light(8)) EXPECT_NEAR(each, 1, 5e-3);
}

TEST_F(Nested, RoughSolidsLoseNoLight) {
  ASSERT_EQ(render(glass("glass", "1.5", "0.3, 0.3") + glass("air", "1") +
                       glass("drink", "1.33", "0.2, 0.2") + glass("ice", "1.31", "0.4, 0.4"),
                   look_of_drink(), drink(), "--spp 256"),
            0)
      << errors_;
  // What rough interfaces give back is exact to some per cent in all (bench/results/furnace.md).
  for (const double each : light(8)) EXPECT_NEAR(each, 1, 0.03);
}

// Beer's law along the middle: of an index of 1 nothing is bent. The property decides who is where
// both are; without it the one that is entered last.
TEST_F(Nested, ThePropertyDecides) {
  const std::string scene = balls({{"red", 0, 2}, {"blue", 0, 1}});
  const std::string two =
      glass("red", "1", "0, 0", "0, 0.5, 0.5") + glass("blue", "1", "0, 0", "0.5, 0.5, 0");
  const auto seen = [&](const std::string& look) {
    EXPECT_EQ(render(two, look, scene, "--spp 1024"), 0) << errors_;
    return light(15);  // Beside the middle, where ways through balls of facets are shorter by 2 %;
                       // Russian roulette adds as much.
  };
  const auto higher = seen(assigned("red", "1") + assigned("blue", "2"));
  EXPECT_NEAR(higher[0], std::exp(-1.0), 4e-2);
  EXPECT_NEAR(higher[1], std::exp(-2.0), 4e-2);
  EXPECT_NEAR(higher[2], std::exp(-1.0), 4e-2);
  const auto lower = seen(assigned("red", "1") + assigned("blue", "-2"));
  EXPECT_NEAR(lower[0], 1, 1e-6);
  EXPECT_NEAR(lower[2], std::exp(-2.0), 4e-2);
}

TEST_F(Nested, PrioritiesAreIntegers) {
  const std::string scene = balls({{"red", 0, 2}});
  for (const auto& [value, type] :
       {std::pair{"1.5", "float"}, {"true", "boolean"}, {"high", "string"}}) {
    EXPECT_NE(render(glass("red", "1.5"), assigned("red", value, type), scene, "--spp 1"), 0);
    EXPECT_TRUE(says("[bad-priority]")) << errors_;
    EXPECT_TRUE(says("a.mtlx:7:")) << errors_;
    EXPECT_TRUE(says("look 'looks'")) << errors_;
    EXPECT_TRUE(says(std::string(type) + " '" + value + "'")) << errors_;
  }
  EXPECT_NE(render(glass("red", "1.5"), assigned("red", "1.5"), scene, "--spp 1"), 0);
  EXPECT_TRUE(says("a.mtlx:7:")) << errors_;
}

}  // namespace
}  // namespace nacre
