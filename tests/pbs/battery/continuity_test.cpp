// T-CON: where a parameter reaches the end of what it means, closures become others: lobes are
// left out, films and mirrors have formulas of their own. What a view sees must not jump there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nacre/lobe_test/probe.hpp>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "tests/support/material_text.h"

namespace nacre {
namespace {

/// Of the light and where it goes to, a jump that is seen in no picture.
constexpr double most_jump = 1e-3, most_jump_fast = 5e-3;
/// The same random numbers on both sides of a limit: what stays is what a choice between lobes
/// costs that a few samples make otherwise.
constexpr std::size_t few_samples = 1 << 14;
/// Where one side has no random part: four standard deviations of few samples were 1.8e-3 there.
constexpr std::size_t many_samples = 1 << 18;

/// A parameter at its limit and next to it; "{}" stands for it in the nodes.
struct Limit {
  std::string name;
  std::string nodes;
  std::string at;
  std::vector<std::string> near;
  bool from_inside = false;  ///< Looked at from there, too.
  /// The texts that `fast` has, whose mirrors begin at 1e-3; empty: the same.
  std::vector<std::string> near_fast = {};
  bool directions = true;  ///< False: whose light goes elsewhere at the limit, as is stated.
  std::size_t samples = few_samples;
};

/// What leaves, and its mean direction: all integrals of f.
struct Seen {
  std::array<double, 3> albedo{};  ///< As the kernel says.
  std::array<double, 3> light{};
  std::array<double, 3> moment{};  ///< Of wi, of the mean light.
};

class Continuity : public testing::TestWithParam<Limit> {
 protected:
  static Seen look(const Shader& shader, Direction wo, std::size_t samples) {
    Seen seen;
    if (!shader.has(NACRE_SAMPLE)) return seen;  // All of it is black.
    detail::LobeProbe probe(shader, nullptr, {});
    const std::array<float, 3> albedo = probe.albedo(wo);
    const detail::LobeProbe::Samples drawn = probe.sample(wo, samples, 1);
    for (std::size_t c = 0; c < 3; ++c) seen.albedo[c] = albedo[c];
    for (std::size_t i = 0; i < samples; ++i) {
      const float* const weight = drawn.weight.data() + 3 * i;
      for (std::size_t c = 0; c < 3; ++c) seen.light[c] += weight[c] / double(samples);
      const double mean = (double(weight[0]) + weight[1] + weight[2]) / 3.0 / double(samples);
      const Direction wi = drawn.wi[i];
      if (mean == 0.0) continue;
      seen.moment[0] += mean * wi.x, seen.moment[1] += mean * wi.y, seen.moment[2] += mean * wi.z;
    }
    return seen;
  }

  static double apart(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    double most = 0.0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
  }

  static void compare(const Limit& limit, int accuracy) {
    static System system;
    CompileOptions options;
    options.engine = NACRE_INTERPRETER;
    options.accuracy = accuracy;
    options.entries =
        1u << NACRE_BEGIN | 1u << NACRE_SAMPLE | 1u << NACRE_EVALUATE | 1u << NACRE_ALBEDO;
    const auto compiled = [&](const std::string& value) {
      const std::string text = material_of(filled(limit.nodes, value));
      return system.compile_material(Document::parse(text), "M", options);
    };
    const bool is_fast = accuracy == NACRE_FAST;
    const double most = is_fast ? most_jump_fast : most_jump;
    std::vector<double> angles{0.0, 45.0, 80.0, 88.0};
    if (limit.from_inside) angles.insert(angles.end(), {110.0, 160.0});
    const Shader at = compiled(limit.at);
    const auto& all = is_fast && !limit.near_fast.empty() ? limit.near_fast : limit.near;
    double worst = 0.0;
    for (const std::string& value : all) {
      const Shader near = compiled(value);
      for (const double angle : angles) {
        const Seen a = look(at, direction(angle), limit.samples);
        const Seen b = look(near, direction(angle), limit.samples);
        const double albedo = apart(a.albedo, b.albedo), light = apart(a.light, b.light);
        const double moment = limit.directions ? apart(a.moment, b.moment) : 0.0;
        worst = std::max({worst, albedo, light, moment});
        EXPECT_LE(albedo, most) << "albedo kernel, " << value << " at " << angle;
        EXPECT_LE(light, most) << "light, " << value << " at " << angle;
        EXPECT_LE(moment, most) << "directions, " << value << " at " << angle;
      }
    }
    fmt::print("| {} | {} | {:.1e} |\n", limit.name, is_fast ? "fast" : "standard", worst);
  }
};

TEST_P(Continuity, NothingJumps) {
  compare(GetParam(), NACRE_STANDARD);
  compare(GetParam(), NACRE_FAST);
}

std::string rough(std::string_view value) { return value_of("roughness", "vector2", value); }
std::string real(std::string_view name, std::string_view value) {
  return value_of(name, "float", value);
}
std::string grey(std::string_view name, const std::string& value) {
  return value_of(name, "color3", value + ", " + value + ", " + value);
}
std::string lobe(std::string_view category, std::string_view inputs) {
  return element(category, "BSDF", "b", inputs);
}
std::string mode(std::string_view value) { return value_of("scatter_mode", "string", value); }
/// On top of paper.
std::string over(std::string_view category, std::string_view inputs) {
  return element(category, "BSDF", "top", inputs) +
         element("oren_nayar_diffuse_bsdf", "BSDF", "paper", grey("color", "0.8")) +
         lobe("layer", from("top", "BSDF", "top") + from("base", "BSDF", "paper"));
}
std::string shader(std::string_view category, std::string_view inputs) {
  return element(category, "surfaceshader", "S", inputs);
}

/// Roughness at the end of mirrors.
std::vector<Limit> mirrors() {
  const std::vector<std::string> near{"0.0001001, 0.0001001", "0.0001001, 0.0002"};
  const std::vector<std::string> fast{"0.001001, 0.001001", "0.001001, 0.002"};
  std::vector<Limit> limits;
  const auto add = [&](const char* name, std::string nodes, bool inside) {
    limits.push_back({std::string("mirror_") + name, std::move(nodes), "0, 0", near, inside, fast});
  };
  add("conductor", lobe("conductor_bsdf", rough("{}")), false);
  add("reflection", lobe("dielectric_bsdf", rough("{}")), true);
  add("reflection_over_paper", over("dielectric_bsdf", rough("{}")), false);
  add("transmission", lobe("dielectric_bsdf", rough("{}") + mode("T")), true);
  add("interface", lobe("dielectric_bsdf", rough("{}") + mode("RT")), true);
  add("schlick", lobe("generalized_schlick_bsdf", rough("{}") + grey("color0", "0.04")), false);
  add("schlick_interface",
      lobe("generalized_schlick_bsdf", rough("{}") + grey("color0", "0.04") + mode("RT")), true);
  add("filmed_interface",
      lobe("dielectric_bsdf", rough("{}") + mode("RT") + real("thinfilm_thickness", "400") +
                                  real("thinfilm_ior", "1.8")),
      true);
  add("beckmann",
      lobe("conductorbrdf", rough("{}") + value_of("distribution", "string", "beckmann")), false);
  return limits;
}

std::vector<Limit> films() {
  const std::vector<std::string> thin{"0.001", "1"};
  const std::string film = real("thinfilm_thickness", "{}") + real("thinfilm_ior", "2");
  std::vector<Limit> limits;
  for (const char* alpha : {"0, 0", "0.2, 0.2", "0.3, 0.1"}) {
    const auto add = [&](const char* of, std::string nodes, bool inside) {
      std::string full = std::string("film_") + of + "_" + alpha;
      std::erase_if(full, [](char c) { return c == ',' || c == ' ' || c == '.'; });
      limits.push_back({full, std::move(nodes), "0", thin, inside});
    };
    add("conductor", lobe("conductor_bsdf", rough(alpha) + film), false);
    add("interface", lobe("dielectric_bsdf", rough(alpha) + mode("RT") + film), true);
    add("schlick_interface",
        lobe("generalized_schlick_bsdf", rough(alpha) + grey("color0", "0.3") + mode("RT") + film),
        true);
    add("over_paper", over("dielectric_bsdf", rough(alpha) + film), false);
    add("schlick", lobe("generalized_schlick_bsdf", rough(alpha) + grey("color0", "0.04") + film),
        false);
  }
  return limits;
}

std::vector<Limit> anisotropies() {
  std::vector<Limit> limits;
  for (const char* alpha : {"0.01", "0.1", "0.4", "0.9"}) {
    const double a = std::atof(alpha);
    const std::vector<std::string> near{fmt::format("{}, {}", a, a * 1.00002),
                                        fmt::format("{}, {}", a * 1.00002, a),
                                        // Where sums over facets come in beside tables.
                                        fmt::format("{}, {}", a, a * 1.0005)};
    const auto add = [&](const char* of, std::string nodes, bool inside) {
      limits.push_back({fmt::format("anisotropy_{}_{}", of, alpha + 2), std::move(nodes),
                        fmt::format("{}, {}", a, a), near, inside});
    };
    add("conductor", lobe("conductor_bsdf", rough("{}")), false);
    add("transmission", lobe("dielectric_bsdf", rough("{}") + mode("T")), true);
    add("interface", lobe("dielectric_bsdf", rough("{}") + mode("RT")), true);
    add("over_paper", over("dielectric_bsdf", rough("{}")), false);
    add("schlick_interface",
        lobe("generalized_schlick_bsdf", rough("{}") + grey("color0", "0.04") + mode("RT")), true);
    add("beckmann",
        lobe("conductorbrdf", rough("{}") + value_of("distribution", "string", "beckmann")), false);
  }
  return limits;
}

/// nodes/DEVIATIONS.md: nearer to 1 than 1e-3 an index does not bend light. What passes goes
/// straight on, where the interface turns all of it from inside at grazing: directions there jump.
std::vector<Limit> indices() {
  std::vector<Limit> limits;
  for (const char* alpha : {"0, 0", "0.1, 0.1", "0.6, 0.6", "1, 1"}) {
    for (const char* const each : {"R", "T", "RT"}) {
      std::string name = std::string("index_") + each + "_" + alpha;
      std::erase_if(name, [](char c) { return c == ',' || c == ' ' || c == '.'; });
      const std::string nodes =
          lobe("dielectric_bsdf", rough(alpha) + mode(each) + real("ior", "{}"));
      // A mirror at grazing is one as soon as the indices differ.
      std::vector<std::string> near{"1.000001", "0.999999"};
      if (each[0] != 'R' || each[1] == 'T') near.insert(near.end(), {"1.0009", "0.9991"});
      limits.push_back({name, nodes, "1", near, true});
      limits.push_back(
          {name + "_bending", nodes, "1.000999", {"1.001001"}, true, {}, false, many_samples});
    }
  }
  return limits;
}

std::vector<Limit> lobes() {
  const std::vector<std::string> small{"0.000001", "0.0001"};
  std::vector<Limit> limits;
  const auto add = [&](const char* name, std::string nodes) {
    limits.push_back({name, std::move(nodes), "0", small});
  };
  add("weight_of_gloss", over("dielectric_bsdf", real("weight", "{}")));
  add("weight_of_sheen", over("sheen_bsdf", real("weight", "{}")));
  add("weight_of_zeltner",
      over("sheen_bsdf", real("weight", "{}") + value_of("mode", "string", "zeltner")));
  add("weight_of_metal", over("conductor_bsdf", real("weight", "{}")));
  add("roughness_of_sheen", over("sheen_bsdf", real("roughness", "{}")));
  add("roughness_of_zeltner",
      over("sheen_bsdf", real("roughness", "{}") + value_of("mode", "string", "zeltner")));
  add("roughness_of_oren_nayar", lobe("oren_nayar_diffuse_bsdf", real("roughness", "{}")));
  add("roughness_of_compensated",
      lobe("oren_nayar_diffuse_bsdf",
           real("roughness", "{}") + value_of("energy_compensation", "boolean", "true")));
  add("roughness_of_burley", lobe("burley_diffuse_bsdf", real("roughness", "{}")));
  add("anisotropy_of_subsurface", lobe("subsurface_bsdf", real("anisotropy", "{}")));
  add("radius_of_subsurface",
      lobe("subsurface_bsdf", grey("color", "0.8") + value_of("radius", "color3", "{}, {}, {}")));
  add("absorption_of_hair",
      lobe("chiang_hair_bsdf", value_of("absorption_coefficient", "vector3", "{}, {}, {}")));
  limits.push_back({"cuticle_of_hair",
                    lobe("chiang_hair_bsdf", real("cuticle_angle", "{}")),
                    "0.5",
                    {"0.50001", "0.49999"}});
  return limits;
}

std::vector<std::string> near_zero(std::string_view model, std::string_view input) {
  // Its root is what the index is above 1.
  const bool is_root = model == "open_pbr_surface" && input == "specular_weight";
  return is_root ? std::vector<std::string>{"0.00000001"}
                 : std::vector<std::string>{"0.000001", "0.00002"};
}

/// Inputs of shading models whose 0 leaves something out.
std::vector<Limit> models() {
  struct Row {
    const char* model;
    const char* rest;  ///< Other inputs.
    std::vector<const char*> inputs;
  };
  const std::vector<Row> rows{
      {"standard_surface",
       "",
       {"base", "diffuse_roughness", "metalness", "specular", "specular_anisotropy", "transmission",
        "subsurface", "sheen", "coat", "emission"}},
      {"standard_surface",
       R"(<input name="coat" type="float" value="1"/>
          <input name="coat_roughness" type="float" value="0.2"/>)",
       {"coat_anisotropy", "coat_affect_color", "coat_affect_roughness", "specular"}},
      {"standard_surface", R"(<input name="sheen" type="float" value="1"/>)", {"sheen_roughness"}},
      {"standard_surface",
       R"(<input name="thin_film_IOR" type="float" value="1.8"/>)",
       {"thin_film_thickness"}},
      {"standard_surface",
       R"(<input name="transmission" type="float" value="1"/>)",
       {"transmission_extra_roughness", "transmission_dispersion", "specular_anisotropy"}},
      {"open_pbr_surface",
       "",
       {"base_weight", "base_metalness", "base_diffuse_roughness", "specular_weight",
        "specular_roughness_anisotropy", "transmission_weight", "subsurface_weight", "fuzz_weight",
        "coat_weight", "thin_film_weight"}},
      {"open_pbr_surface",
       R"(<input name="coat_weight" type="float" value="1"/>
          <input name="coat_roughness" type="float" value="0.3"/>)",
       {"coat_roughness_anisotropy", "coat_darkening", "specular_weight"}},
      {"open_pbr_surface",
       R"(<input name="fuzz_weight" type="float" value="1"/>)",
       {"fuzz_roughness"}},
      {"open_pbr_surface",
       R"(<input name="thin_film_weight" type="float" value="1"/>)",
       {"thin_film_thickness"}},
      {"open_pbr_surface",
       R"(<input name="transmission_weight" type="float" value="1"/>)",
       {"transmission_depth", "transmission_dispersion_scale", "specular_weight"}},
      {"gltf_pbr",
       R"(<input name="metallic" type="float" value="0"/>
          <input name="roughness" type="float" value="0.4"/>)",
       {"metallic", "transmission", "specular", "clearcoat", "sheen_roughness",
        "anisotropy_strength", "iridescence", "dispersion"}},
      {"UsdPreviewSurface", "", {"metallic", "clearcoat"}},
      {"disney_principled",
       "",
       {"metallic", "specular", "specularTint", "anisotropic", "sheen", "sheenTint", "clearcoat",
        "specTrans", "subsurface"}},
      {"alSurface",
       "",
       {"backlightStrength", "sssMix", "specular1Strength", "specular2Strength",
        "transmissionStrength", "diffuseRoughness"}},
  };
  std::vector<Limit> limits;
  for (const Row& row : rows) {
    for (const char* input : row.inputs) {
      std::string rest = row.rest;
      // Where a row says what it is about, that is not said twice.
      const std::string own = std::string("<input name=\"") + input + "\"";
      if (const std::size_t at = rest.find(own); at != std::string::npos) {
        rest.erase(at, rest.find("/>", at) + 2 - at);
      }
      limits.push_back({fmt::format("{}_{}_{}", row.model, limits.size(), input),
                        shader(row.model, rest + real(input, "{}")), "0",
                        near_zero(row.model, input)});
    }
  }
  return limits;
}

std::vector<Limit> limits() {
  std::vector<Limit> all;
  for (const auto& part : {mirrors(), films(), anisotropies(), indices(), lobes(), models()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

void PrintTo(const Limit& limit, std::ostream* out) { *out << limit.name; }

INSTANTIATE_TEST_SUITE_P(All, Continuity, testing::ValuesIn(limits()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace nacre
