#include "nodes/math/safe.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// Absorption coefficient of hair from its melanin: d'Eon et al., "An
/// Energy-Conserving Hair Reflectance Model", 2011, with the concentration c given
/// as 1 - exp(-melanin). MaterialX 1.39 Physically Based Shading Nodes,
/// "deon_hair_absorption_from_melanin". The colours are exp(-absorption) of the two
/// pigments, at least the smallest normal float; 1 - c is at least 1e-4, the
/// result at least 0. A NaN concentration counts as 1. The redness is not limited;
/// NaN in it or in a colour gives 0.
void record_deon_hair_absorption_from_melanin(NodeCall& call) {
  const Float melanin = -log(max(1.0f - call.number("melanin_concentration"), 1e-4f));
  const Float redness = call.number("melanin_redness");
  const Float pheomelanin = melanin * redness;
  const Float eumelanin = melanin - pheomelanin;
  const Float3 eumelanin_color = call.vector3("eumelanin_color");
  const Float3 pheomelanin_color = call.vector3("pheomelanin_color");
  const auto absorption = [&](Float eu, Float pheo) {
    return max(-fma(eumelanin, safe_log(eu), pheomelanin * safe_log(pheo)), 0.0f);
  };
  call.set(Float3(absorption(eumelanin_color.x, pheomelanin_color.x),
                  absorption(eumelanin_color.y, pheomelanin_color.y),
                  absorption(eumelanin_color.z, pheomelanin_color.z)));
}

}  // namespace nacre
