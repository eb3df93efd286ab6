#include "pbs/bsdf.h"
#include "pbs/cosine_lobe.h"

namespace nacre {

/// subsurface_bsdf in its diffuse limit: a mean free path short against anything
/// that is lit differently. Light leaves where it entered and has forgotten where
/// it came from: Lambert of the given albedo, which is what `color` means.
/// MaterialX PBS 1.39, "subsurface_bsdf". `radius` and `anisotropy` say how far
/// light spreads and have no part in that limit, so nothing is recorded for them.
/// What is not modelled, and said in the manifest: light that leaves elsewhere.
void record_closure_subsurface_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  auto lobe = std::make_shared<LambertLobe>("subsurface_bsdf", CosineLobe::Hemisphere::viewer,
                                            prepare_normal(recorder, call.vector3("normal")),
                                            prepare_tint(recorder, call.vector3("color")));
  std::vector<std::string> left_out;
  if (!is_zero(call.vector3("radius"))) {
    left_out.emplace_back("subsurface_bsdf: radius and anisotropy; light leaves where it enters");
  }
  set_lobe(call, std::move(lobe), std::move(left_out));
}

}  // namespace nacre
