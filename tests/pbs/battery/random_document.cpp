#include "tests/pbs/battery/random_document.h"

#include <fmt/format.h>

#include <vector>

#include "tests/support/material_text.h"
#include "tests/support/random.h"

namespace nacre {

namespace {

/// What an input may be.
enum class Kind { weight, roughness, alpha, color, index, film };

struct Input {
  const char* name;
  Kind kind;
};
struct Closure {
  const char* category;
  std::vector<Input> inputs;
  std::vector<std::string> modes = {""};  ///< Further inputs, one of them.
};

std::string mode(const char* value) { return value_of("scatter_mode", "string", value); }

const std::vector<Closure>& models() {
  using enum Kind;
  static const std::vector<Closure> all{
      {"standard_surface",
       {{"base", weight},
        {"base_color", color},
        {"diffuse_roughness", weight},
        {"metalness", weight},
        {"specular", weight},
        {"specular_roughness", roughness},
        {"specular_IOR", index},
        {"specular_anisotropy", weight},
        {"transmission", weight},
        {"subsurface", weight},
        {"sheen", weight},
        {"coat", weight},
        {"coat_roughness", roughness},
        {"coat_color", color},
        {"thin_film_thickness", film},
        {"emission", weight}}},
      {"open_pbr_surface",
       {{"base_weight", weight},
        {"base_color", color},
        {"base_metalness", weight},
        {"base_diffuse_roughness", weight},
        {"specular_weight", weight},
        {"specular_color", color},
        {"specular_roughness", roughness},
        {"specular_ior", index},
        {"transmission_weight", weight},
        {"subsurface_weight", weight},
        {"fuzz_weight", weight},
        {"coat_weight", weight},
        {"coat_roughness", roughness},
        {"thin_film_weight", weight}}},
      {"gltf_pbr",
       {{"base_color", color},
        {"metallic", weight},
        {"roughness", roughness},
        {"transmission", weight},
        {"specular", weight},
        {"specular_color", color},
        {"ior", index},
        {"sheen_color", color},
        {"sheen_roughness", roughness},
        {"clearcoat", weight},
        {"clearcoat_roughness", roughness},
        {"iridescence", weight}}},
      {"UsdPreviewSurface",
       {{"diffuseColor", color},
        {"metallic", weight},
        {"roughness", roughness},
        {"clearcoat", weight},
        {"clearcoatRoughness", roughness},
        {"ior", index}},
       {"", value_of("useSpecularWorkflow", "integer", "1")}},
      {"disney_principled",
       {{"baseColor", color},
        {"metallic", weight},
        {"roughness", roughness},
        {"specular", weight},
        {"specularTint", weight},
        {"sheen", weight},
        {"clearcoat", weight},
        {"specTrans", weight},
        {"subsurface", weight}}},
      {"alSurface",
       {{"diffuseColor", color},
        {"diffuseRoughness", weight},
        {"backlightStrength", weight},
        {"sssMix", weight},
        {"specular1Strength", weight},
        {"specular1Roughness", roughness},
        {"specular2Strength", weight},
        {"specular2Roughness", roughness},
        {"transmissionStrength", weight}}},
  };
  return all;
}

const std::vector<Closure>& lobes() {
  using enum Kind;
  static const std::vector<Closure> all{
      {"oren_nayar_diffuse_bsdf",
       {{"weight", weight}, {"color", color}, {"roughness", weight}},
       {"", value_of("energy_compensation", "boolean", "true")}},
      {"burley_diffuse_bsdf", {{"weight", weight}, {"color", color}, {"roughness", weight}}},
      {"translucent_bsdf", {{"weight", weight}, {"color", color}}},
      {"subsurface_bsdf", {{"weight", weight}, {"color", color}}},
      {"sheen_bsdf",
       {{"weight", weight}, {"color", color}, {"roughness", roughness}},
       {"", value_of("mode", "string", "zeltner")}},
      {"conductor_bsdf", {{"weight", weight}, {"roughness", alpha}, {"thinfilm_thickness", film}}},
      {"dielectric_bsdf",
       {{"weight", weight},
        {"tint", color},
        {"ior", index},
        {"roughness", alpha},
        {"thinfilm_thickness", film}},
       {mode("R"), mode("T"), mode("RT")}},
      {"generalized_schlick_bsdf",
       {{"weight", weight}, {"color0", color}, {"roughness", alpha}},
       {mode("R"), mode("RT")}},
  };
  return all;
}

class Writing {
 public:
  explicit Writing(std::uint64_t seed) : random_(seed) {}

  std::string write() {
    add_patterns();
    if (random_.chance(0.6)) {
      const Closure& model = random_.pick(models());
      text_ += element(model.category, "surfaceshader", "S", inputs(model));
      return material_of(text_);
    }
    const std::string root = tree(3);
    return material_of(text_ +
                       element("multiply", "BSDF", "b", from("in1", "BSDF", root) + share("in2")));
  }

 private:
  std::string literal(double low, double high) {
    const double t = static_cast<double>(random_.word() >> 40) * 0x1p-24;
    return fmt::format("{:.4f}", low + t * (high - low));
  }
  std::string name(const char* prefix) { return fmt::format("{}{}", prefix, ++names_); }

  std::string share(std::string_view input) { return value_of(input, "float", literal(0.3, 1.0)); }

  /// A number in [0, 1] or a link to one.
  std::string number(std::string_view input, double low = 0.0, double high = 1.0) {
    if (random_.chance(0.4)) return value_of(input, "float", literal(low, high));
    return from(input, "float", random_.pick(numbers_));
  }
  std::string shade(std::string_view input) {
    if (random_.chance(0.4)) return value_of(input, "color3", color());
    return from(input, "color3", random_.pick(colors_));
  }
  std::string color() { return literal(0, 1) + ", " + literal(0, 1) + ", " + literal(0, 1); }

  /// Numbers and colours in [0, 1], each of those before.
  void add_patterns() {
    text_ += element("texcoord", "vector2", "uv", "") + element("position", "vector3", "at", "");
    text_ += element("extract", "float", "n0", from("in", "vector2", "uv"));
    text_ += element("fractal3d", "float", "cloud", from("position", "vector3", "at"));
    text_ += element("smoothstep", "float", "n1",
                     from("in", "float", "cloud") + value_of("low", "float", "-1"));
    text_ += element("constant", "float", "n2", value_of("value", "float", literal(0, 1)));
    numbers_ = {"n0", "n1", "n2"};
    text_ += element("constant", "color3", "c0", value_of("value", "color3", color()));
    colors_ = {"c0"};
    const std::uint32_t count = 4 + random_.below(9);
    for (std::uint32_t i = 0; i < count; ++i) random_.chance(0.6) ? add_number() : add_color();
  }

  void add_number() {
    const std::string made = name("f");
    const auto write = [&](std::string_view category, std::string_view inputs) {
      text_ += element(category, "float", made, inputs);
    };
    switch (random_.below(8)) {
      case 0: write("multiply", number("in1") + number("in2")); break;
      case 1: write("mix", number("fg") + number("bg") + number("mix")); break;
      case 2: write("min", number("in1") + number("in2")); break;
      case 3: write("max", number("in1") + number("in2")); break;
      case 4: write("invert", number("in")); break;
      case 5: write("smoothstep", number("in")); break;
      case 6: write("absval", number("in")); break;
      default:
        write("remap", number("in") + value_of("outlow", "float", literal(0, 1)) +
                           value_of("outhigh", "float", literal(0, 1)));
    }
    numbers_.push_back(made);
  }

  void add_color() {
    const std::string made = name("c");
    const auto write = [&](std::string_view category, std::string_view inputs) {
      text_ += element(category, "color3", made, inputs);
    };
    switch (random_.below(5)) {
      case 0: write("combine3", number("in1") + number("in2") + number("in3")); break;
      case 1: write("mix", shade("fg") + shade("bg") + number("mix")); break;
      case 2: write("multiply", shade("in1") + number("in2")); break;
      case 3: write("saturate", shade("in") + number("amount")); break;
      default: write("invert", shade("in"));
    }
    colors_.push_back(made);
  }

  std::string input(const Input& input) {
    switch (input.kind) {
      case Kind::weight:
        if (random_.chance(0.35)) return value_of(input.name, "float", "0");
        if (random_.chance(0.25)) return value_of(input.name, "float", "1");
        return number(input.name);
      case Kind::roughness: {
        if (random_.chance(0.5)) return value_of(input.name, "float", literal(0.2, 1.0));
        return from(input.name, "float", at_least(random_.pick(numbers_)));
      }
      case Kind::alpha: {
        const std::string a = literal(0.05, 1), b = random_.chance(0.5) ? a : literal(0.05, 1);
        return value_of(input.name, "vector2", a + ", " + b);
      }
      case Kind::color:
        if (random_.chance(0.15)) return value_of(input.name, "color3", "0, 0, 0");
        return shade(input.name);
      case Kind::index:
        return value_of(input.name, "float", random_.chance(0.2) ? "1" : literal(1.05, 2.5));
      case Kind::film:
        return value_of(input.name, "float", random_.chance(0.6) ? "0" : literal(50, 900));
    }
    return {};
  }

  std::string at_least(const std::string& of) {
    const std::string made = name("r");
    text_ +=
        element("clamp", "float", made, from("in", "float", of) + value_of("low", "float", "0.2"));
    return made;
  }

  /// Most inputs; the others stay as the nodedef has them.
  std::string inputs(const Closure& closure) {
    std::string all = random_.pick(closure.modes);
    for (const Input& each : closure.inputs) {
      if (each.kind == Kind::roughness || random_.chance(0.7)) all += input(each);
    }
    return all;
  }

  /// The name of a BSDF of so many levels at most.
  std::string tree(int levels) {
    const std::string made = name("b");
    if (levels == 0 || random_.chance(0.2)) {
      const Closure& lobe = random_.pick(lobes());
      text_ += element(lobe.category, "BSDF", made, inputs(lobe));
      return made;
    }
    const std::string x = tree(levels - 1), y = tree(levels - 1);
    const auto both = [&](const char* first, const char* second) {
      return from(first, "BSDF", x) + from(second, "BSDF", y);
    };
    switch (random_.below(4)) {
      case 0: text_ += element("layer", "BSDF", made, both("top", "base")); break;
      case 1:
        text_ += element("mix", "BSDF", made, both("fg", "bg") + input({"mix", Kind::weight}));
        break;
      case 2: text_ += element("add", "BSDF", made, both("in1", "in2")); break;
      default:
        text_ += element("multiply", "BSDF", made + "s",
                         from("in1", "BSDF", x) + input({"in2", Kind::color}));
        text_ += element("layer", "BSDF", made,
                         from("top", "BSDF", made + "s") + from("base", "BSDF", y));
    }
    return made;
  }

  Random random_;
  std::string text_;
  std::vector<std::string> numbers_, colors_;  ///< Names of nodes.
  int names_ = 2;
};

}  // namespace

std::string random_document(std::uint64_t seed) { return Writing(seed).write(); }

}  // namespace nacre
