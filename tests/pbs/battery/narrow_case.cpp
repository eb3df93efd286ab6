#include "tests/pbs/battery/narrow_case.h"

#include <cmath>
#include <utility>
#include <vector>

namespace nacre {

namespace {

using In = const LobeInputs&;

// 1e-4 is the threshold below which facets are mirrors.
constexpr float alphas[] = {1e-4f, 1e-3f, 3e-3f, 1e-2f};
constexpr float variances[] = {1e-6f, 1e-5f, 1e-4f, 1e-3f};
constexpr double outside[] = {0.0, 45.0, 80.0, 89.0, 89.9};
/// And inside, near 41.8 degrees, beyond which index 1.5 reflects all, and on both sides.
constexpr double everywhere[] = {0.0,   45.0,  80.0,  89.0,  89.9, 180.0,
                                 150.0, 138.5, 138.0, 120.0, 95.0, 90.5};
constexpr double about_fibre[] = {0.0, 45.0, 80.0, 89.0};

constexpr float index_of_glass = 1.5f;
constexpr float index_of_hair = 1.55f;
constexpr float tilted_cuticle = 0.52f;

/// The other alpha over that along the tangent.
template <int stretch>
Recorded facets(In in) {
  // One value twice is known to be isotropic.
  const Float along = in.roughness;
  return stretch == 1 ? roughness(along, along)
                      : roughness(along, along * static_cast<float>(stretch));
}

Ports metal(Recorded alpha) {
  return {{"ior", colour(0.2f)}, {"extinction", colour(3.0f)}, {"roughness", std::move(alpha)}};
}
Ports glass(const char* mode, Recorded alpha) {
  return {{"ior", number(index_of_glass)},
          {"roughness", std::move(alpha)},
          {"scatter_mode", text(mode)}};
}
Ports with(Ports ports, const char* name, Recorded value) {
  ports[name] = std::move(value);
  return ports;
}
/// Of the index that glass() has.
Ports schlick(const char* mode, Recorded alpha) {
  return {{"color0", colour(0.04f)},
          {"color90", colour(1.0f)},
          {"roughness", std::move(alpha)},
          {"scatter_mode", text(mode)}};
}
/// Logistics as narrow as the Gaussians along the fibre are.
Ports hair(In in, float cuticle_angle) {
  const Float v = in.roughness, s = sqrt(v);
  return {{"tint_R", colour(1.0f)},
          {"tint_TT", colour(1.0f)},
          {"tint_TRT", colour(1.0f)},
          {"ior", number(index_of_hair)},
          {"roughness_R", roughness(v, s)},
          {"roughness_TT", roughness(0.25f * v, s)},
          {"roughness_TRT", roughness(4.0f * v, s)},
          {"cuticle_angle", number(cuticle_angle)}};
}

template <int stretch, bool turned = false>
std::unique_ptr<NarrowWarp> by_facets(float width, Direction wo) {
  return facet_warp(wo, width, stretch * width, index_of_glass, turned);
}

template <bool tilted>
std::unique_ptr<NarrowWarp> by_fibre(float width, Direction wo) {
  const double v = width, root_eighth_pi = 0.626657069, s = root_eighth_pi * std::sqrt(v);
  const double tilt = tilted ? 3.14159265 * (tilted_cuticle - 0.5f) : 0.0;
  return fibre_warp(wo, {{v, 0.25 * v, 4.0 * v}, {s, s, s}, tilt, index_of_hair});
}

NarrowCase metal_case(std::string name, Ports (*ports)(In),
                      std::unique_ptr<NarrowWarp> (*warp)(float, Direction),
                      std::size_t daily_share = 0) {
  return {{.name = std::move(name), .category = "conductor_bsdf", .ports = ports},
          warp,
          alphas,
          outside,
          daily_share};
}
NarrowCase glass_case(std::string name, Ports (*ports)(In),
                      std::unique_ptr<NarrowWarp> (*warp)(float, Direction),
                      std::size_t daily_share = 0) {
  return {{.name = std::move(name), .category = "dielectric_bsdf", .ports = ports},
          warp,
          alphas,
          everywhere,
          daily_share};
}
NarrowCase schlick_case(std::string name, Ports (*ports)(In), std::size_t daily_share = 0) {
  return {{.name = std::move(name), .category = "generalized_schlick_bsdf", .ports = ports},
          by_facets<1>,
          alphas,
          everywhere,
          daily_share};
}
NarrowCase hair_case(std::string name, Ports (*ports)(In),
                     std::unique_ptr<NarrowWarp> (*warp)(float, Direction),
                     std::size_t daily_share = 0) {
  return {{.name = std::move(name), .category = "chiang_hair_bsdf", .ports = ports},
          warp,
          variances,
          about_fibre,
          daily_share};
}

Ports of_beckmann(Ports ports) { return with(std::move(ports), "distribution", text("beckmann")); }

std::vector<NarrowCase> make_cases() {
  return {
      metal_case(
          "metal", [](In in) { return metal(facets<1>(in)); }, by_facets<1>, 3),
      metal_case(
          "metal_4", [](In in) { return metal(facets<4>(in)); }, by_facets<4>, 9),
      metal_case(
          "metal_100", [](In in) { return metal(facets<100>(in)); }, by_facets<100>),
      metal_case(
          "metal_back",
          [](In in) {
            return with(metal(facets<4>(in)), "retroreflective", {Type::boolean, Bool(true)});
          },
          by_facets<4, true>),
      metal_case(
          "beckmann_metal", [](In in) { return of_beckmann(metal(facets<1>(in))); }, by_facets<1>,
          3),
      metal_case(
          "beckmann_metal_4", [](In in) { return of_beckmann(metal(facets<4>(in))); },
          by_facets<4>),
      glass_case(
          "reflection", [](In in) { return glass("R", facets<1>(in)); }, by_facets<1>),
      glass_case(
          "transmission", [](In in) { return glass("T", facets<1>(in)); }, by_facets<1>, 5),
      glass_case(
          "interface", [](In in) { return glass("RT", facets<1>(in)); }, by_facets<1>, 5),
      glass_case(
          "transmission_4", [](In in) { return glass("T", facets<4>(in)); }, by_facets<4>, 13),
      glass_case(
          "interface_4", [](In in) { return glass("RT", facets<4>(in)); }, by_facets<4>, 13),
      glass_case(
          "interface_100", [](In in) { return glass("RT", facets<100>(in)); }, by_facets<100>, 13),
      glass_case(
          "beckmann_transmission", [](In in) { return of_beckmann(glass("T", facets<1>(in))); },
          by_facets<1>),
      glass_case(
          "beckmann_interface_4", [](In in) { return of_beckmann(glass("RT", facets<4>(in))); },
          by_facets<4>, 13),
      schlick_case("schlick_reflection", [](In in) { return schlick("R", facets<1>(in)); }),
      schlick_case("schlick_transmission", [](In in) { return schlick("T", facets<1>(in)); }),
      schlick_case("schlick_interface", [](In in) { return schlick("RT", facets<1>(in)); }),
      hair_case(
          "hair", [](In in) { return hair(in, 0.5f); }, by_fibre<false>),
      hair_case(
          "tilted_hair", [](In in) { return hair(in, tilted_cuticle); }, by_fibre<true>, 6),
  };
}

}  // namespace

std::span<const NarrowCase> narrow_cases() {
  static const std::vector<NarrowCase> cases = make_cases();
  return cases;
}

}  // namespace nacre
