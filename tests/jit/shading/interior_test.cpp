// What a surface encloses, as a kernel: index and medium.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/jit/shading/own_library.h"

namespace nacre {
namespace {

class Interior : public OwnLibrary {
 protected:
  /// The channels of the kernel; none where there is no kernel.
  Numbers inside(const std::string& category, const std::string& inputs,
                 const std::string& before = "") {
    options_.kernels.entries |= entry_interior;
    const auto document = read(before + node(category, "surfaceshader", "s", inputs) + R"(
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>)");
    if (document == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), Numbers();
    kernels_ = system_->compile_material(*document, "M", options_, diagnostics_);
    if (kernels_ == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), Numbers();
    return kernels_->interior ? run(*kernels_->interior, {{"wo.z", 1.0f}}) : Numbers();
  }

  bool says_medium() const {
    return std::ranges::any_of(kernels_->manifest, [](const std::string& line) {
      return line.starts_with("interior medium");
    });
  }

  std::unique_ptr<MaterialKernels> kernels_;
};

// OpenPBR 1.1, "Translucent base": extinction is -ln(transmission_color) / transmission_depth, of
// which transmission_scatter / transmission_depth scatters.
TEST_F(Interior, OfOpenPbr) {
  const Numbers coffee =
      inside("open_pbr_surface", value_of("transmission_weight", "float", "1") +
                                     value_of("transmission_color", "color3", "0.5, 0.25, 0.125") +
                                     value_of("transmission_depth", "float", "2") +
                                     value_of("transmission_scatter", "color3", "0.2, 0.2, 0.2") +
                                     value_of("transmission_scatter_anisotropy", "float", "0.25") +
                                     value_of("specular_ior", "float", "1.33"));
  ASSERT_FALSE(coffee.empty());
  EXPECT_NEAR(coffee.at("eta"), 1.33f, 1e-5f);
  EXPECT_NEAR(coffee.at("scattering.x"), 0.1f, 1e-5f);
  EXPECT_NEAR(coffee.at("absorption.x") + coffee.at("scattering.x"), std::log(2.0f) / 2, 1e-5f);
  EXPECT_NEAR(coffee.at("absorption.z") + coffee.at("scattering.z"), std::log(8.0f) / 2, 1e-5f);
  EXPECT_NEAR(coffee.at("anisotropy"), 0.25f, 1e-5f);
  EXPECT_FALSE(says_medium());
}

TEST_F(Interior, OnlyWhereLightEnters) {
  EXPECT_TRUE(inside("open_pbr_surface", "").empty());
  const Numbers glass = inside("open_pbr_surface", value_of("transmission_weight", "float", "1"));
  EXPECT_NEAR(glass.at("eta"), 1.5f, 1e-5f);
  EXPECT_FALSE(glass.contains("absorption.x"));
  EXPECT_TRUE(inside("open_pbr_surface", value_of("transmission_weight", "float", "1") +
                                             value_of("geometry_thin_walled", "boolean", "true"))
                  .empty());
}

TEST_F(Interior, IsNotThereUnasked) {
  const auto document = read(node("open_pbr_surface", "surfaceshader", "s",
                                  value_of("transmission_weight", "float", "1") +
                                      value_of("transmission_color", "color3", "0.5, 0.5, 0.5") +
                                      value_of("transmission_depth", "float", "2")) +
                             R"(<surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>)");
  kernels_ = system_->compile_material(*document, "M", options_, diagnostics_);
  ASSERT_NE(kernels_, nullptr) << diagnostics_.to_string();
  EXPECT_FALSE(kernels_->interior);
  EXPECT_TRUE(says_medium());
}

// alSurface: what is left of light after a unit of length is the colour.
TEST_F(Interior, OfAlSurface) {
  const Numbers tea =
      inside("alSurface", value_of("transmissionStrength", "float", "1") +
                              value_of("ssAttenuationColor", "color3", "0.9, 0.5, 0.1") +
                              value_of("ssScattering", "float", "0.25") +
                              value_of("ssDensityScale", "float", "2"));
  const float extinction = -2.0f * std::log(0.5f);
  EXPECT_NEAR(tea.at("scattering.y"), 0.25f * extinction, 1e-5f);
  EXPECT_NEAR(tea.at("absorption.y"), 0.75f * extinction, 1e-5f);
  EXPECT_NEAR(tea.at("eta"), 1.4f, 1e-5f);
}

// Of two interfaces side by side, the mean by how much is seen of each.
TEST_F(Interior, OfTwoIsTheMean) {
  const auto glass = [](const std::string& name, const std::string& absorption,
                        const std::string& ior) {
    return node("absorption_vdf", "VDF", "v" + name,
                value_of("absorption", "vector3", absorption)) +
           node("dielectric_bsdf", "BSDF", "d" + name,
                value_of("scatter_mode", "string", "T") + value_of("ior", "float", ior)) +
           node("layer", "BSDF", name,
                from("top", "BSDF", "d" + name) + from("base", "VDF", "v" + name));
  };
  const Numbers mixed = inside("surface", from("bsdf", "BSDF", "m"),
                               glass("a", "1, 2, 3", "1.2") + glass("b", "5, 2, 7", "1.6") +
                                   node("mix", "BSDF", "m",
                                        from("fg", "BSDF", "a") + from("bg", "BSDF", "b") +
                                            value_of("mix", "float", "0.75")));
  EXPECT_NEAR(mixed.at("absorption.x"), 2.0f, 1e-5f);
  EXPECT_NEAR(mixed.at("absorption.y"), 2.0f, 1e-5f);
  EXPECT_NEAR(mixed.at("absorption.z"), 4.0f, 1e-5f);
  EXPECT_NEAR(mixed.at("eta"), 1.3f, 1e-5f);
}

}  // namespace
}  // namespace nacre
