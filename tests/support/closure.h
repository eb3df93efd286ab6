#pragma once

#include <map>
#include <memory>
#include <string>

#include "pbs/bsdf.h"
#include "pbs/kernels.h"
#include "runtime/node/recorded.h"

namespace nacre {

/// Inputs of a closure node that differ from its nodedef's defaults.
using Ports = std::map<std::string, Recorded, std::less<>>;

/// Records one microfacet BSDF node: conductor_bsdf, dielectric_bsdf or
/// generalized_schlick_bsdf, roughness and all as given.
BsdfPtr microfacet_bsdf(Recorder& recorder, std::string_view category, Ports ports,
                        Accuracy accuracy = Accuracy::standard);

inline Recorded colour(Float x) { return {Type::color3, Color3(x)}; }
inline Recorded number(Float x) { return {Type::float_, x}; }
inline Recorded roughness(Float x, Float y) { return {Type::vector2, Float2{x, y}}; }
inline Recorded text(std::string x) {
  Recorded value;
  value.type = Type::string;
  value.text = std::move(x);
  return value;
}

}  // namespace nacre
