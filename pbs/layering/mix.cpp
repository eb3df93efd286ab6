#include "pbs/bsdf.h"
#include "pbs/displacement.h"
#include "pbs/edf.h"
#include "pbs/surface.h"
#include "pbs/volume.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

class MixEdf final : public Edf {
 public:
  MixEdf(EdfPtr fg, EdfPtr bg, Float mix) : Edf(std::move(fg), std::move(bg)), mix_(mix) {}
  Color3 radiance(const View&, Color3 fg, Color3 bg) const override {
    return product(fg, Color3(mix_)) + product(bg, Color3(1.0f - mix_));
  }
  Color3 part_power(std::size_t i, Color3 power) const override {
    return power_seen(power, Color3(i == 0 ? mix_ : 1.0f - mix_));
  }

 private:
  Float mix_;
};

/// As lerp; of two equal literals that literal, whatever the mix: what is opaque or flat
/// on both sides is so everywhere.
Float between(Float a, Float b, Float mix) {
  const bool same = a.is_constant() && b.is_constant() && a.constant() == b.constant();
  return same ? a : lerp(a, b, mix);
}

Float3 between(Float3 a, Float3 b, Float mix) {
  return {between(a.x, b.x, mix), between(a.y, b.y, mix), between(a.z, b.z, mix)};
}

/// An unconnected shader: present, black.
SurfacePtr or_black(SurfacePtr surface) {
  return surface != nullptr ? std::move(surface) : std::make_shared<Surface>();
}

std::shared_ptr<Surface> mix_surfaces(SurfacePtr fg, SurfacePtr bg, Float mix) {
  auto surface = std::make_shared<Surface>();
  surface->bsdf = std::make_shared<MixBsdf>(fg->bsdf, bg->bsdf, mix);
  if (fg->edf != nullptr || bg->edf != nullptr) {
    surface->edf = std::make_shared<MixEdf>(fg->edf, bg->edf, mix);
  }
  surface->opacity = between(bg->opacity, fg->opacity, mix);
  surface->transmission = between(bg->transmission, fg->transmission, mix);
  // PBS 1.39, "Surfaces": if either is thin-walled, both are.
  surface->thin_walled = fg->thin_walled | bg->thin_walled;
  return surface;
}

VdfPtr mix_media(const VdfPtr& fg, const VdfPtr& bg, Float mix) {
  return sum(scaled(fg, Color3(mix)), scaled(bg, Color3(1.0f - mix)));
}

std::shared_ptr<Volume> mix_volumes(const VolumePtr& fg, const VolumePtr& bg, Float mix) {
  const Volume& a = fg == nullptr ? Volume() : *fg;
  const Volume& b = bg == nullptr ? Volume() : *bg;
  auto volume = std::make_shared<Volume>();
  volume->vdf = mix_media(a.vdf, b.vdf, mix);
  volume->edf = std::make_shared<MixEdf>(a.edf, b.edf, mix);
  return volume;
}

std::shared_ptr<Displacement> mix_displacements(const DisplacementPtr& fg,
                                                const DisplacementPtr& bg, Float mix) {
  const Float3 a = fg == nullptr ? Float3(0.0f) : fg->offset;
  const Float3 b = bg == nullptr ? Float3(0.0f) : bg->offset;
  auto displacement = std::make_shared<Displacement>();
  displacement->offset = between(b, a, mix);
  return displacement;
}

}  // namespace

/// mix of closures: fg in proportion mix, bg in 1 - mix, mix clamped to [0, 1].
/// MaterialX PBS 1.39, "mix"; of shaders, their closures, opacities and offsets.
void record_closure_mix(NodeCall& call) {
  const Float mix = keep(call.recorder(), saturate(call.number("mix")));
  const ClosurePtr& fg = call.closure("fg");
  const ClosurePtr& bg = call.closure("bg");
  switch (call.out_type()) {
    case Type::edf: call.set(std::make_shared<MixEdf>(as_edf(fg), as_edf(bg), mix)); break;
    case Type::vdf: call.set(mix_media(as_vdf(fg), as_vdf(bg), mix)); break;
    case Type::volumeshader: call.set(mix_volumes(as_volume(fg), as_volume(bg), mix)); break;
    case Type::displacementshader:
      call.set(mix_displacements(as_displacement(fg), as_displacement(bg), mix));
      break;
    case Type::surfaceshader:
      call.set(mix_surfaces(or_black(as_surface(fg)), or_black(as_surface(bg)), mix));
      break;
    default: call.set(std::make_shared<MixBsdf>(as_bsdf(fg), as_bsdf(bg), mix)); break;
  }
}

}  // namespace nacre
