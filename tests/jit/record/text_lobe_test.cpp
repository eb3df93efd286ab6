// Lobes by text: what they compute, beside native lobes and closed forms.
#include "jit/record/text_lobe.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "tests/jit/record/text_lobes.h"
#include "tests/support/random.h"

namespace nacre {
namespace {

constexpr std::size_t count = 301;

float number(Random& random) { return static_cast<float>(random.word() >> 40) * 0x1p-24f; }

/// Directions from all sides, and random numbers.
Columns points() {
  Random random(3);
  Columns columns;
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::string name : {"wo", "wi"}) {
      const float z = 2.0f * number(random) - 1.0f, turn = 6.2831853f * number(random);
      const float r = std::sqrt(1.0f - z * z);
      columns[name + ".x"].push_back(r * std::cos(turn));
      columns[name + ".y"].push_back(r * std::sin(turn));
      columns[name + ".z"].push_back(z);
    }
    for (const char* name : {"u.x", "u.y", "u.z"}) columns[name].push_back(number(random));
  }
  return columns;
}

class TextLobe : public TextLobes {
 protected:
  void expect_near(const std::string& text, const std::string& native) {
    for (const Backend engine : {Backend::interpreter, Backend::jit, Backend::reference}) {
      options_.compile.backend = engine;
      const auto one = material(text), other = material(native);
      ASSERT_TRUE(one && other) << diagnostics_.to_string();
      Columns expected = everything(*other, points());
      for (const auto& [name, column] : everything(*one, points())) {
        for (std::size_t i = 0; i < column.size(); ++i) {
          const float wanted = expected.at(name)[i];
          ASSERT_NEAR(column[i], wanted, 2e-5f * std::max(1.0f, std::abs(wanted)))
              << name << " of point " << i << " engine " << static_cast<int>(engine);
        }
      }
    }
  }
  float albedo(const std::string& body, Columns point) {
    const auto kernels = material(body);
    if (kernels == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), 0.0f;
    return everything(*kernels, std::move(point)).at("albedo.x").front();
  }
};

/// `own` where `native` stands: alone, with a bent normal, and in everything that holds lobes.
TEST_F(TextLobe, IsWhatTheNativeOneIs) {
  const std::string translucent =
      "<translucent_bsdf name=\"%\" type=\"BSDF\">"
      "<input name=\"color\" type=\"color3\" value=\"0.5, 0.25, 0.75\"/>+</translucent_bsdf>";
  const std::string lambert =
      "<oren_nayar_diffuse_bsdf name=\"%\" type=\"BSDF\">"
      "<input name=\"color\" type=\"color3\" value=\"0.5, 0.25, "
      "0.75\"/>+</oren_nayar_diffuse_bsdf>";
  const std::string weight = "<input name=\"weight\" type=\"float\" value=\"0.7\"/>";
  const std::string bent = "<input name=\"normal\" type=\"vector3\" value=\"0.6, 0, 0.8\"/>";
  const std::string own = "<own name=\"%\" type=\"BSDF\">+</own>";
  const std::string metal = "<conductor_bsdf name=\"m\" type=\"BSDF\"/>";
  const auto instance = [](std::string node, const std::string& name, const std::string& inputs) {
    node.replace(node.find('%'), 1, name);
    return node.replace(node.find('+'), 1, inputs);
  };
  const std::string mix = "<mix name=\"b\" type=\"BSDF\">" + reads("fg", "BSDF", "o") +
                          reads("bg", "BSDF", "m") +
                          "<input name=\"mix\" type=\"float\" value=\"0.3\"/></mix>";
  const std::string layer =
      "<dielectric_bsdf name=\"d\" type=\"BSDF\"/><layer name=\"b\" type=\"BSDF\">" +
      reads("top", "BSDF", "d") + reads("base", "BSDF", "o") + "</layer>";
  const std::string multiply =
      "<multiply name=\"b\" type=\"BSDF\">" + reads("in1", "BSDF", "o") +
      "<input name=\"in2\" type=\"color3\" value=\"0.5, 1, 0.25\"/></multiply>";
  folder_.write("own.glsl", LambertText().text());
  for (const std::string& inputs : {std::string(), weight, bent, weight + bent}) {
    expect_near(nodedef() + instance(own, "b", inputs), instance(lambert, "b", inputs));
  }
  for (const std::string& holder : {metal + mix, layer, multiply}) {
    expect_near(nodedef() + instance(own, "o", bent) + holder,
                instance(lambert, "o", bent) + holder);
  }
  // The other side.
  LambertText through{.f = "color * -wi.z / M_PI", .pdf = "-wi.z / M_PI"};
  through.sample = "vec3(r * cos(turn), r * sin(turn), -sqrt(1.0 - xi.x))";
  folder_.write("own.glsl", through.text());
  const auto kernels = material(nodedef(ports, "bsdf=\"T\"") + instance(own, "b", bent));
  const auto native = material(instance(translucent, "b", bent));
  ASSERT_TRUE(kernels && native) << diagnostics_.to_string();
  // Which samples are taken is theirs, and so is what of them crosses the surface itself.
  const Columns got = everything(*kernels, points()), wanted = everything(*native, points());
  for (const char* name : {"f.x", "f.y", "f.z", "pdf", "albedo.x"}) {
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_NEAR(got.at(name)[i], wanted.at(name)[std::min(i, wanted.at(name).size() - 1)], 2e-6)
          << name << ' ' << i;
    }
  }
  const auto valid = [](float flags) { return static_cast<int>(flags) & sample_valid; };
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(valid(got.at("next.flags")[i]), valid(wanted.at("next.flags")[i])) << i;
  }
  EXPECT_EQ(kernels->lobes.front().kinds, lobe_diffuse_transmission);
  EXPECT_EQ(kernels->lobes.front().name, "own");
}

/// Loops, branches and calls in a text of many lobes, in every width.
TEST_F(TextLobe, HasTheSameBitsOnEveryEngine) {
  LambertText phong;
  phong.f = "color * lobe(wo, wi, color.y) * wi.z";
  phong.pdf = "0.5 * wi.z / M_PI + 0.5 * lobe(wo, wi, color.x)";
  phong.sample =
      "xi.x < 0.5 ? vec3(r * cos(turn), r * sin(turn), sqrt(1.0 - xi.x)) : vec3(-wo.xy, wo.z)";
  phong.albedo = "color * (1.0 - wo.z * log(1.0 + 1.0 / max(wo.z, 1e-3)))";
  phong.more = "float own_roughness(vec3 color) { return color.x; }";
  folder_.write("own.glsl", R"(float lobe(vec3 wo, vec3 wi, float amount) {
      float c = dot(vec3(-wo.xy, wo.z), wi), sum = 1.0;
      if (c <= 0.0) return 0.0;
      for (int i = 0; i < int(100.0 * amount); ++i) { sum *= c; if (sum < 1e-3) break; }
      return sum; })" + phong.text());
  const std::string body = nodedef() + R"(<texcoord name="uv" type="vector2"/>
      <combine3 name="c" type="color3"><input name="in1" type="float" value="0.3"/>
      <input name="in2" type="float" value="0.6"/><input name="in3" type="float" value="0.9"/></combine3>
      <own name="o" type="BSDF">)" +
                           reads("color", "color3", "c") +
                           R"(</own><conductor_bsdf name="m" type="BSDF"/><mix name="b" type="BSDF">
      <input name="mix" type="float" value="0.4"/>)" +
                           reads("fg", "BSDF", "o") + reads("bg", "BSDF", "m") + "</mix>";
  const auto interpreted = material(body);
  ASSERT_NE(interpreted, nullptr) << diagnostics_.to_string();
  EXPECT_EQ(interpreted->lobes.front().kinds, lobe_glossy_reflection);
  const Columns expected = everything(*interpreted, points());
  options_.compile.backend = Backend::jit;
  for (const int lanes : {1, 4, 8, 16}) {
    options_.compile.lanes = lanes;
    const auto compiled = material(body);
    ASSERT_NE(compiled, nullptr) << diagnostics_.to_string();
    for (const auto& [name, column] : everything(*compiled, points())) {
      for (std::size_t i = 0; i < column.size(); ++i) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(column[i]),
                  std::bit_cast<std::uint32_t>(expected.at(name)[i]))
            << name << " of point " << i << ", " << lanes << " lanes";
      }
    }
  }
}

/// What lies below sees what the text lets pass, or what its albedo leaves.
TEST_F(TextLobe, LetsPassWhatItSays) {
  const std::string layer =
      "<own name=\"o\" type=\"BSDF\"><input name=\"color\" type=\"color3\" value=\"0.3, 0.3, "
      "0.3\"/></own>"
      "<oren_nayar_diffuse_bsdf name=\"l\" type=\"BSDF\">"
      "<input name=\"color\" type=\"color3\" value=\"0.5, 0.5, 0.5\"/></oren_nayar_diffuse_bsdf>"
      "<layer name=\"b\" type=\"BSDF\">" +
      reads("top", "BSDF", "o") + reads("base", "BSDF", "l") + "</layer>";
  LambertText text;
  folder_.write("own.glsl", text.text());
  EXPECT_NEAR(albedo(nodedef() + layer, {{"wo.z", {1.0f}}}), 0.3 + 0.7 * 0.5, 1e-6);
  text.more = "vec3 own_throughput(vec3 wo, vec3 color) { return vec3(0.1); }";
  folder_.write("own.glsl", text.text());
  EXPECT_NEAR(albedo(nodedef() + layer, {{"wo.z", {1.0f}}}), 0.3 + 0.1 * 0.5, 1e-6);
}

/// z is the normal on the viewer's side, x the tangent made orthogonal.
TEST_F(TextLobe, SeesDirectionsInItsFrame) {
  folder_.write("own.glsl", LambertText{.albedo = "abs(wo)"}.text());
  const std::string inputs =
      std::string(ports) + "<input name=\"tangent\" type=\"vector3\" defaultgeomprop=\"Tworld\"/>";
  const auto kernels = material(nodedef(inputs) + R"(<own name="b" type="BSDF">
      <input name="normal" type="vector3" value="0.6, 0, 0.8"/>
      <input name="tangent" type="vector3" value="0.3, 2, 0.4"/></own>)");
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  for (const float z : {1.0f, -1.0f}) {
    const Columns all = everything(*kernels, {{"wo.z", {z}}, {"wi.z", {z}}});
    EXPECT_NEAR(all.at("albedo.x").front(), 0.0f, 1e-6f);
    EXPECT_NEAR(all.at("albedo.y").front(), 0.6f, 1e-6f);
    EXPECT_NEAR(all.at("albedo.z").front(), 0.8f, 1e-6f);
    EXPECT_NEAR(all.at("pdf").front(), 0.8f / 3.14159265f, 1e-6f);
  }
}

/// Of wi on a side that the nodedef does not name nothing is asked.
TEST_F(TextLobe, ScattersOnItsSides) {
  folder_.write("own.glsl", LambertText{.f = "vec3(1.0)",
                                        .sample = "vec3(0.0, 0.0, xi.x < 0.5 ? 1.0 : -1.0)",
                                        .pdf = "1.0"}
                                .text());
  const std::string own = "<own name=\"b\" type=\"BSDF\"/>";
  for (const auto& [sides, above, below] : {std::tuple{"", 1.0f, 0.0f},
                                            {"bsdf=\"R\"", 1.0f, 0.0f},
                                            {"bsdf=\"T\"", 0.0f, 1.0f},
                                            {"bsdf=\"RT\"", 1.0f, 1.0f}}) {
    const auto kernels = material(nodedef(ports, sides) + own);
    ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
    const Columns all =
        everything(*kernels, {{"wo.z", {1.0f}}, {"wi.z", {1.0f, -1.0f}}, {"u.x", {0.25f, 0.75f}}});
    EXPECT_EQ(all.at("f.x"), (std::vector{above, below})) << sides;
    EXPECT_EQ(all.at("pdf"), (std::vector{above, below})) << sides;
    for (std::size_t i = 0; i < 2; ++i) {
      const int flags = static_cast<int>(all.at("next.flags")[i]);
      EXPECT_EQ((flags & sample_valid) != 0, (i == 0 ? above : below) == 1.0f) << sides;
    }
  }
}

/// Light is finite whatever a text gives; who looks at the text sees what it gives.
TEST_F(TextLobe, IsHeldToWhatLobesPromise) {
  const std::string own = "<own name=\"b\" type=\"BSDF\"/>";
  for (const char* bad : {"1.0 / (wi.z - wi.z)", "log(-wi.z)", "-wi.z", "1e38 * (1.0 + wi.z)"}) {
    for (const bool is_density : {false, true}) {
      LambertText text;
      (is_density ? text.pdf : text.f) = is_density ? bad : "vec3(" + std::string(bad) + ")";
      text.albedo = "vec3(1e30, log(-1.0 - wo.z), -3.0)";
      folder_.write("own.glsl", text.text());
      const auto kernels = material(nodedef() + own);
      ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
      for (const auto& [name, column] : everything(*kernels, points())) {
        if (name.find("wi.") != std::string::npos || name == "next.lobe") continue;
        for (const float x : column) {
          ASSERT_TRUE(x >= 0.0f && x <= 3.4e38f) << name << ' ' << x << ' ' << bad;
        }
      }
    }
  }
  folder_.write("own.glsl", LambertText{.f = "vec3(log(-wi.z))"}.text());
  const Columns point{{"wo.z", {1.0f}}, {"wi.z", {1.0f}}};
  EXPECT_EQ(everything(*material(nodedef() + own), point).at("f.x").front(), 0.0f);
  options_.holds_lobes = false;
  EXPECT_TRUE(std::isnan(everything(*material(nodedef() + own), point).at("f.x").front()));
}

}  // namespace
}  // namespace nacre
