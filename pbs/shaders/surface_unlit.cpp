#include "pbs/surface.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// surface_unlit: emission and straight transmission, no scattering. MaterialX
/// 1.39 Standard Nodes, "Shader Nodes". Colours below zero count as zero.
void record_closure_surface_unlit(NodeCall& call) {
  const auto weighted = [&](std::string_view weight, std::string_view color) {
    return weigh(max(call.number(weight), 0.0f), max(call.vector3(color), Color3(0.0f)));
  };
  auto surface = std::make_shared<Surface>();
  surface->edf = uniform_edf(weighted("emission", "emission_color"));
  surface->transmission = saturate(weighted("transmission", "transmission_color"));
  surface->opacity = saturate(call.number("opacity"));
  call.set(std::move(surface));
}

}  // namespace nacre
