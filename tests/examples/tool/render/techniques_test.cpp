// Ways to less noise, through the tool: what each leaves out, and that the others change no mean.
#include <cmath>
#include <string>
#include <vector>

#include "tests/examples/tool/render/image_layers.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

constexpr int size = 48;

/// What is seen of which of the two meshes, and of everything.
struct Picture {
  std::vector<float> floor, wall, all;

  /// The share of pixels that differ. Kernels with other inputs round otherwise, and few paths
  /// take another turn for that.
  static double difference(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size() || a.empty()) return 1;
    std::size_t others = 0;
    for (std::size_t i = 0; i < a.size(); ++i) others += std::abs(a[i] - b[i]) > 1e-3f * b[i];
    return static_cast<double>(others) / static_cast<double>(a.size());
  }
  static double mean(const std::vector<float>& values) {
    EXPECT_GT(values.size(), 100u);
    double sum = 0;
    for (const float each : values) sum += static_cast<double>(each);
    return sum / static_cast<double>(values.size());
  }
};

class Techniques : public Tool {
 protected:
  /// A material by the text of its BSDF, which is called "b" and its name, and where it goes.
  static std::string material(const std::string& name, const std::string& bsdf) {
    return bsdf + R"(<surface name="s)" + name +
           R"(" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b)" + name +
           R"("/></surface><surfacematerial name=")" + name +
           R"(" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s)" +
           name + R"("/></surfacematerial><materialassign name="m)" + name + R"(" material=")" +
           name + R"(" geom="/)" + name + R"("/>)";
  }
  static std::string metal(const std::string& name, const std::string& alpha) {
    return material(name, R"(<conductor_bsdf name="b)" + name +
                              R"(" type="BSDF"><input name="roughness" type="vector2" value=")" +
                              alpha + ", " + alpha + R"("/></conductor_bsdf>)");
  }
  static std::string diffuse(const std::string& name, const std::string& color) {
    return material(name, R"(<oren_nayar_diffuse_bsdf name="b)" + name +
                              R"(" type="BSDF"><input name="color" type="color3" value=")" + color +
                              ", " + color + ", " + color + R"("/></oren_nayar_diffuse_bsdf>)");
  }
  static std::string glass(const std::string& name, const std::string& alpha) {
    return material(name, R"(<dielectric_bsdf name="b)" + name +
                              R"(" type="BSDF"><input name="scatter_mode" type="string" value="RT"/>
           <input name="roughness" type="vector2" value=")" +
                              alpha + ", " + alpha + R"("/></dielectric_bsdf>)");
  }

  /// Half way between a black texel and a white one, of which --draw-texels takes one: nodes "dots"
  /// and "dot", its red.
  std::string dots() const {
    std::string pixels(18, '\0');  // Truevision TGA 2.0, image type 2: 2 x 1 of 24 bits.
    pixels[2] = 2, pixels[12] = 2, pixels[14] = 1, pixels[16] = 24;
    write("dots.tga", pixels + std::string(3, '\x00') + std::string(3, '\xff'));
    return R"(<image name="dots" type="color3">
      <input name="file" type="filename" value="dots.tga"/>
      <input name="texcoord" type="vector2" value="0.5, 0.5"/></image>
      <extract name="dot" type="float"><input name="in" type="color3" nodename="dots"/></extract>)";
  }
  static std::string with_image(std::string text, const std::string& before,
                                const std::string& more) {
    return text.replace(text.find(before), 0, more);
  }

  /// A floor that scatters what "dot" says.
  static std::string weighed_floor() {
    return with_image(diffuse("floor", "0.6"), "<input name=\"color\"",
                      "<input name=\"weight\" type=\"float\" nodename=\"dot\"/>");
  }
  static std::string opaque(const std::string& material, const std::string& opacity) {
    return with_image(material, "<input name=\"bsdf\"",
                      "<input name=\"opacity\" type=\"float\" nodename=\"" + opacity + "\"/>");
  }

  /// A floor and a wall of these materials, "floor" and "wall", under the studio.
  Picture render(const std::string& materials, const std::string& options) {
    std::string text = R"(<materialx version="1.39" colorspace="lin_rec709">)" + materials;
    // Assignments belong into a look.
    std::string look;
    for (std::size_t at = text.find("<materialassign"); at != std::string::npos;
         at = text.find("<materialassign")) {
      const std::size_t end = text.find("/>", at) + 2;
      look += text.substr(at, end - at);
      text.erase(at, end - at);
    }
    write("a.mtlx", text + "<look name=\"l\">" + look + "</look></materialx>");
    write("a.obj", R"(v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v -1 2 -1
v 1 2 -1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
o floor
f 4/4 3/3 2/2 1/1
o wall
f 1/1 2/2 6/3 5/4
)");
    EXPECT_EQ(
        run("render " + file("a.mtlx") + " --scene " + file("a.obj") + " --size " +
            std::to_string(size) + " --aov mesh_id --out " + file("a.exr") + " -q " + options),
        0)
        << errors_;
    EXPECT_EQ(errors_, "");
    const Layers layers = layers_of(file("a.exr"));
    const auto value = [&](int x, int y, const char* channel) {
      return layers[channel][static_cast<std::size_t>(y * size + x)];
    };
    // A pixel at an edge shows both.
    const auto is_within = [&](int x, int y, float mesh) {
      for (int k = 0; k < 9; ++k) {
        if (value(x + k % 3 - 1, y + k / 3 - 1, "mesh_id.V") != mesh) return false;
      }
      return true;
    };
    Picture picture;
    for (int y = 1; y + 1 < size; ++y) {
      for (int x = 1; x + 1 < size; ++x) {
        if (is_within(x, y, 1.f)) picture.floor.push_back(value(x, y, "G"));
        if (is_within(x, y, 2.f)) picture.wall.push_back(value(x, y, "G"));
        picture.all.push_back(value(x, y, "G"));
      }
    }
    return picture;
  }

  /// Standard deviations between what options give of the floor and wall together, or of one list
  /// of pixels, of so many seeds each.
  double difference(const std::string& materials, const std::string& one, const std::string& other,
                    std::vector<float> Picture::* of = nullptr) {
    constexpr int seeds = 8;
    double sum[2] = {}, squares[2] = {};
    for (int k = 0; k < 2 * seeds; ++k) {
      const Picture p = render(
          materials, (k % 2 == 0 ? one : other) + " --spp 16 --seed " + std::to_string(100 + k));
      const double mean =
          of != nullptr ? Picture::mean(p.*of) : Picture::mean(p.floor) + Picture::mean(p.wall);
      sum[k % 2] += mean;
      squares[k % 2] += mean * mean;
    }
    double variance = 0;
    for (int k = 0; k < 2; ++k) {
      variance += (squares[k] - sum[k] * sum[k] / seeds) / (seeds * (seeds - 1.0));
    }
    return std::abs(sum[0] - sum[1]) / seeds / std::sqrt(variance);
  }
};

// A mirror gives what scatters diffusely nothing: as if it were black there. What the camera sees
// of it stays.
TEST_F(Techniques, WithoutCausticsMirrorsAreBlackToWhatIsDiffuse) {
  const std::string floor = diffuse("floor", "0.7");
  const Picture with = render(floor + metal("wall", "0.01"), "--spp 8");
  const Picture without = render(floor + metal("wall", "0.01"), "--spp 8 --no-caustics");
  const Picture black = render(floor + diffuse("wall", "0"), "--spp 8");
  EXPECT_LT(Picture::difference(without.floor, black.floor), 0.01);
  EXPECT_GT(Picture::mean(with.floor), 1.05 * Picture::mean(without.floor));
  EXPECT_GT(Picture::mean(without.wall), 1.2 * Picture::mean(black.wall));
}

// The same where light is looked for by what lobes draw alone: behind gloss, mirrors stay.
TEST_F(Techniques, CausticsAreOfWhatIsDiffuse) {
  const std::string both = metal("floor", "0.3") + metal("wall", "0.01");
  const Picture with = render(both, "--spp 4"), without = render(both, "--spp 4 --no-caustics");
  EXPECT_LT(Picture::difference(with.floor, without.floor), 0.01);
}

// Behind facets of alpha .25 a mirror is one of alpha .25, and only there.
TEST_F(Techniques, RoughnessIsThatOfThePath) {
  const std::string floor = metal("floor", "0.25");
  const Picture clamped = render(floor + metal("wall", "0.01"), "--spp 8 --clamp-roughness");
  const Picture rough = render(floor + metal("wall", "0.25"), "--spp 8");
  const Picture smooth = render(floor + metal("wall", "0.01"), "--spp 8 --max-depth 1");
  EXPECT_LT(Picture::difference(clamped.floor, rough.floor), 0.01);
  const Picture seen =
      render(floor + metal("wall", "0.01"), "--spp 8 --max-depth 1 --clamp-roughness");
  EXPECT_LT(Picture::difference(seen.wall, smooth.wall), 0.01);
}

// What a contribution brings is limited after the first event, and not before.
TEST_F(Techniques, OnlyIndirectLightIsLimited) {
  const std::string both = diffuse("floor", "0.9") + diffuse("wall", "0.9");
  const Picture direct = render(both, "--spp 4 --max-depth 1");
  EXPECT_EQ(render(both, "--spp 4 --max-depth 1 --clamp-indirect 1e-6").floor, direct.floor);
  const Picture free = render(both, "--spp 4"),
                limited = render(both, "--spp 4 --clamp-indirect 1e-6"),
                wide = render(both, "--spp 4 --clamp-indirect 1e6");
  EXPECT_EQ(wide.floor, free.floor);
  EXPECT_GT(Picture::mean(free.floor), 1.1 * Picture::mean(direct.floor));
  // Eight events bring 1e-6 each at most, two ways each.
  EXPECT_NEAR(Picture::mean(limited.floor), Picture::mean(direct.floor), 2e-5);
}

TEST_F(Techniques, RouletteHasTheSameMean) {
  const std::string both = diffuse("floor", "0.6") + metal("wall", "0.2");
  EXPECT_LT(difference(both, "--roulette none", "--roulette event --roulette-depth 0"), 3.5);
  EXPECT_LT(difference(both, "--roulette none", "--roulette throughput --roulette-depth 0"), 3.5);
}

// Light of either fork is found by its own density, smooth and rough.
TEST_F(Techniques, ForksHaveTheSameMean) {
  for (const char* alpha : {"0", "0.3"}) {
    const std::string both = glass("floor", alpha) + glass("wall", alpha);
    EXPECT_LT(difference(both, "--split 0", "--split 3"), 3.5) << alpha;
  }
}

// Of a texture and of the same one that shines on it, half way between a black texel and a white
// one: were both drawn by one number, they would be white together, and what is lit twice as
// bright.
TEST_F(Techniques, DrawnTexelsHaveTheSameMean) {
  const std::string wall =
      with_image(with_image(diffuse("wall", "0.6"), "<surface ",
                            R"(<multiply name="bright" type="color3">
                      <input name="in1" type="color3" nodename="dots"/>
                      <input name="in2" type="float" value="50"/></multiply>
                    <uniform_edf name="e" type="EDF"><input name="color" type="color3"
                      nodename="bright"/></uniform_edf>)"),
                 "<input name=\"bsdf\"", R"(<input name="edf" type="EDF" nodename="e"/>)");
  const std::string both = dots() + weighed_floor() + wall;
  EXPECT_LT(difference(both, "--max-depth 1", "--max-depth 1 --draw-texels", &Picture::floor), 3.5);
  const char* const options = "--spp 4 --draw-texels";
  const Picture drawn = render(both, std::string(options) + " --threads 1");
  const Picture again = render(both, std::string(options) + " --threads 3");
  EXPECT_EQ(drawn.floor, again.floor);
  EXPECT_EQ(drawn.wall, again.wall);
  EXPECT_GT(Picture::difference(drawn.floor, render(both, "--spp 4").floor), 0.1);
}

// What lets half of the light pass, by a texel of its own: itself, what is behind it, and its
// shadow.
TEST_F(Techniques, DrawnOpacityHasTheSameMean) {
  const std::string both = dots() + weighed_floor() + opaque(diffuse("wall", "0.6"), "dot");
  EXPECT_LT(difference(both, "--max-depth 1", "--max-depth 1 --draw-texels", &Picture::all), 3.5);
}

// A texel's opacity goes with the same texel's colour, as if each were shaded by itself (Pharr et
// al. 2024, "Filtering After Shading With Stochastic Texture Filtering"): where the white one lets
// all pass and the black one is black, the wall is half as dark as something black, however grey
// their means are.
TEST_F(Techniques, TexelsAreShadedByThemselves) {
  const std::string holes = R"(<subtract name="solid" type="float">
      <input name="in1" type="float" value="1"/>
      <input name="in2" type="float" nodename="dot"/></subtract>)";
  const auto pictures = [&](const std::string& weight, const std::string& options) {
    const std::string wall = with_image(diffuse("wall", "0.6"), "<input name=\"color\"",
                                        "<input name=\"weight\" type=\"float\" " + weight + "/>");
    double sum = 0;
    for (int seed = 0; seed < 4; ++seed) {
      const Picture p = render(dots() + holes + weighed_floor() + opaque(wall, "solid"),
                               "--max-depth 1 --spp 64 --seed " + std::to_string(seed) + options);
      sum += Picture::mean(p.all) / 4;
    }
    return sum;
  };
  const double black = pictures("value=\"0\"", ""), grey = pictures("nodename=\"dot\"", ""),
               drawn = pictures("nodename=\"dot\"", " --draw-texels");
  EXPECT_GT(grey, 1.05 * black);
  EXPECT_NEAR(drawn, black, 0.01 * black);
}

// What a path has met, and where its forks are, hangs on nothing but the path.
TEST_F(Techniques, PicturesAreTheSameForAnyNumberOfThreads) {
  const std::string both = metal("floor", "0.25") + glass("wall", "0.1");
  const char* const options = "--spp 8 --clamp-roughness --no-caustics --split 2";
  const Picture one = render(both, std::string(options) + " --threads 1");
  const Picture three = render(both, std::string(options) + " --threads 3");
  EXPECT_EQ(one.floor, three.floor);
  EXPECT_EQ(one.wall, three.wall);
}

TEST_F(Techniques, ForksAndLobesOfPassesDoNotGoTogether) {
  write("a.mtlx", R"(<materialx version="1.39"/>)");
  EXPECT_NE(run("render " + file("a.mtlx") + " --out " + file("a.exr") +
                " --split 1 --aov direct_diffuse"),
            0);
  EXPECT_TRUE(says("[split-with-passes]")) << errors_;
}

}  // namespace
}  // namespace nacre
