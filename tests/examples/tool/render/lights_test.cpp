// Lights of documents in pictures: what a diffuse card sends back of them, in closed form.
#include <OpenImageIO/imageio.h>

#include <cmath>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

constexpr double pi = 3.14159265358979;

class Lights : public Tool {
 protected:
  /// The middle of a white card at z = 0, in front of which it is dark but for lights.
  double card(const std::string& light, const std::string& look = "",
              const std::string& more = "") {
    const std::vector<std::uint8_t> black(6);
    const auto night = OIIO::ImageOutput::create(file("night.png"));
    EXPECT_TRUE(night->open(file("night.png"), {2, 1, 3, OIIO::TypeDesc::UINT8}) &&
                night->write_image(OIIO::TypeDesc::UINT8, black.data()) && night->close());
    write("card.obj", "o card\nv -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 1 2 3 4\n" + more);
    write("card.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">
      <oren_nayar_diffuse_bsdf name="d" type="BSDF">
        <input name="color" type="color3" value="1, 1, 1"/></oren_nayar_diffuse_bsdf>
      <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>)" +
                           light + look + "</materialx>");
    EXPECT_EQ(run("render " + file("card.mtlx") + " --scene " + file("card.obj") + " --out " +
                  file("a.exr") + " --size 64 --spp 16 --max-depth 1 --no-cache --environment " +
                  file("night.png") + (look.empty() ? " --material M" : "")),
              0)
        << errors_;
    const auto image = OIIO::ImageInput::open(file("a.exr"));
    if (image == nullptr) return NAN;
    const auto channels = static_cast<std::size_t>(image->spec().nchannels);
    std::vector<float> texels(64 * 64 * channels);
    image->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, texels.data());
    double sum = 0.0;
    for (const std::size_t pixel : {2015u, 2016u, 2079u, 2080u}) {
      sum += 0.25 * double(texels[pixel * channels]);
    }
    return sum;
  }
};

// Albedo / pi times cosine times irradiance across the direction.
TEST_F(Lights, ADirectionalOne) {
  const double light = card(R"(<directional_light name="L" type="lightshader">
      <input name="color" type="color3" value="1, 1, 1"/>
      <input name="direction" type="vector3" value="0, 0.6, -0.8"/>
      <input name="intensity" type="float" value="3"/></directional_light>)");
  EXPECT_NEAR(light, 3 * 0.8 / pi, 1e-3);
  EXPECT_EQ(errors_, "");
  // The data library takes the direction as it is; its length is no brightness.
  EXPECT_NEAR(card(R"(<directional_light name="L" type="lightshader">
      <input name="color" type="color3" value="1, 1, 1"/>
      <input name="direction" type="vector3" value="0, 6, -8"/>
      <input name="intensity" type="float" value="3"/></directional_light>)"),
              3 * 0.8 / pi, 1e-3);
}

// The data library's text: intensity / (distance + 1)^decay_rate.
TEST_F(Lights, APointAndASpot) {
  EXPECT_NEAR(card(R"(<point_light name="L" type="lightshader">
      <input name="color" type="color3" value="1, 1, 1"/>
      <input name="position" type="vector3" value="0, 0, 3"/>
      <input name="intensity" type="float" value="32"/></point_light>)"),
              32.0 / 16.0 / pi, 2e-2);
  const auto spot = [](const std::string& direction) {
    return R"(<spot_light name="L" type="lightshader">
      <input name="color" type="color3" value="1, 1, 1"/>
      <input name="position" type="vector3" value="0, 0, 3"/>
      <input name="direction" type="vector3" value=")" +
           direction + R"("/><input name="intensity" type="float" value="32"/>
      <input name="inner_angle" type="float" value="0.95"/>
      <input name="outer_angle" type="float" value="0.9"/></spot_light>)";
  };
  EXPECT_NEAR(card(spot("0, 0, -1")), 32.0 / 16.0 / pi, 2e-2);
  EXPECT_EQ(card(spot("1, 0, 0")), 0.0);
  EXPECT_NEAR(card(spot("0, 0, -1") + spot("0, 0, -1").replace(18, 1, "K")), 2 * 32.0 / 16.0 / pi,
              4e-2);
}

// A mesh that a light is the material of emits it: radiance E / pi over a small square far away.
TEST_F(Lights, ALightOfAMesh) {
  const std::string square =
      "o lamp\nv -0.1 -0.1 4\nv -0.1 0.1 4\nv 0.1 0.1 4\nv 0.1 -0.1 4\nf 5 6 7 8\n";
  const std::string look = R"(<look name="K">
      <materialassign name="a" material="M" geom="/card"/>
      <materialassign name="b" material="N" geom="/lamp"/></look>)";
  const auto lamp = [](const std::string& color) {
    return R"(<uniform_edf name="e" type="EDF"><input name="color" type="color3" value=")" + color +
           R"("/></uniform_edf><light name="L" type="lightshader">
        <input name="edf" type="EDF" nodename="e"/></light>
      <lightmaterial name="N" type="material">
        <input name="lightshader" type="lightshader" nodename="L"/></lightmaterial>)";
  };
  const double light = card(lamp("1000, 0, 0"), look, square);
  EXPECT_EQ(errors_, "");
  // The middle of the scene is at z = 2, seen from (0.55, 0.35, 1): behind it is (-1.1, -0.7, 0).
  const double squared = 1.1 * 1.1 + 0.7 * 0.7 + 16;
  EXPECT_NEAR(light, 1000 * 0.04 * 16 / (squared * squared) / pi, 2e-2);
  // One that is switched off is a lamp, too.
  EXPECT_EQ(card(lamp("0, 0, 0"), look, square), 0.0);
  EXPECT_EQ(errors_, "");
}

TEST_F(Lights, NoMeshIsALightThatStandsSomewhere) {
  write("a.obj", "o card\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
  write("a.mtlx", R"(<materialx version="1.39"><point_light name="L" type="lightshader">
      <input name="color" type="color3" value="1, 1, 1"/></point_light>
    <lightmaterial name="M" type="material">
      <input name="lightshader" type="lightshader" nodename="L"/></lightmaterial></materialx>)");
  EXPECT_EQ(run("render " + file("a.mtlx") + " --scene " + file("a.obj") + " --out " +
                file("a.png") + " --size 4 --spp 1 --no-cache --material M"),
            1);
  EXPECT_TRUE(says("light-has-place")) << errors_;
  EXPECT_FALSE(std::filesystem::exists(file("a.png")));
}

TEST_F(Lights, ALightThatIsNowhereIsSaid) {
  write("a.obj", "o card\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
  write("a.mtlx", R"(<materialx version="1.39"><standard_surface name="S" type="surfaceshader"/>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    <uniform_edf name="e" type="EDF"/>
    <light name="L" type="lightshader"><input name="edf" type="EDF" nodename="e"/></light>
    </materialx>)");
  EXPECT_EQ(run("render " + file("a.mtlx") + " --scene " + file("a.obj") + " --out " +
                file("a.png") + " --size 4 --spp 1 --no-cache"),
            0);
  EXPECT_TRUE(says("light-without-place")) << errors_;
  EXPECT_TRUE(says("(L)")) << errors_;
}

}  // namespace
}  // namespace nacre
