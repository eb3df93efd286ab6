#include "pbs/bsdf.h"
#include "pbs/cosine_lobe.h"

namespace nacre {

/// translucent_bsdf: light that leaves in all directions of the side away from
/// the viewer. MaterialX PBS 1.39, "translucent_bsdf". The library's own shader
/// always lights the back of the normal; here it is the back as the viewer sees
/// it, so that light crosses the surface in either direction.
void record_closure_translucent_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  auto lobe = std::make_shared<LambertLobe>("translucent_bsdf", CosineLobe::Hemisphere::other,
                                            prepare_facing_normal(recorder, call.vector3("normal")),
                                            prepare_tint(recorder, call.vector3("color")));
  set_lobe(call, std::move(lobe));
}

}  // namespace nacre
