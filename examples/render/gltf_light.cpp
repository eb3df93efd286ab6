#include "examples/render/gltf_light.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace nacre::host {

namespace {

std::optional<PunctualLight::Kind> kind_of(const GltfValue& type) {
  using Kind = PunctualLight::Kind;
  const auto text = type.need("\"directional\", \"point\" or \"spot\"").text();
  if (!text) return {};
  if (*text == "directional") return Kind::directional;
  if (*text == "point") return Kind::point;
  if (*text == "spot") return Kind::spot;
  type.error("there is no such light", "\"directional\", \"point\" or \"spot\"", type.shown());
  return {};
}

}  // namespace

std::optional<PunctualLight> read_light(const GltfValue& light, const Affine& world) {
  constexpr double largest = 1e30;
  constexpr double right = std::numbers::pi / 2;
  const auto kind = kind_of(light["type"]);
  const auto intensity = light["intensity"].within(0.0, largest, 1.f);
  const auto range = light["range"].within(0.0, largest, 0.f);
  const GltfValue spot = light["spot"];
  const auto inner = spot["innerConeAngle"].within(0.0, right, 0.f);
  const auto outer =
      spot["outerConeAngle"].within(0.0, right, static_cast<float>(std::numbers::pi / 4));
  std::vector<double> color{1.0, 1.0, 1.0};
  if (light["color"]) {
    const auto given = light["color"].numbers(3);
    if (!given) return {};
    color = *given;
  }
  if (!kind || !intensity || !range || !inner || !outer) return {};
  PunctualLight result;
  result.kind = *kind;
  result.color = {*intensity * std::max(0.f, static_cast<float>(color[0])),
                  *intensity * std::max(0.f, static_cast<float>(color[1])),
                  *intensity * std::max(0.f, static_cast<float>(color[2]))};
  result.position = world.origin;
  result.direction = normalize_or(-world.z, {0.f, 0.f, -1.f});
  result.range = *range;
  result.inner_cos = std::cos(*inner);
  result.outer_cos = std::cos(*outer);
  if (is_finite(result.color)) return result;
  light.error("a light is too bright", "a product of colour and intensity that float holds",
              light["color"].shown());
  return {};
}

}  // namespace nacre::host
