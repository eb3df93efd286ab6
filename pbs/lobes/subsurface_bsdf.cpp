#include "pbs/bsdf.h"
#include "pbs/cosine_lobe.h"
#include "pbs/sampling.h"
#include "pbs/subsurface_medium.h"
#include "runtime/node/geometry.h"

namespace nacre {

namespace {

/// Light that enters, is scattered below the surface, and leaves elsewhere. Of the colour the lobe
/// knows only the sum: where the host follows the light (View::follows_subsurface), `sample` sends
/// it into the medium, unweakened, and what leaves is the host's; where it does not, light leaves
/// where it entered and has forgotten where it came from: Lambert of the albedo that is meant.
/// That is the limit of a mean free path short against anything that is lit differently.
/// MaterialX PBS 1.39, "subsurface_bsdf".
class SubsurfaceLobe final : public Lobe {
 public:
  /// `normal` and `color` are kept.
  SubsurfaceLobe(Recorder& recorder, Float3 normal, Color3 color, Color3 radius, Float anisotropy)
      : limit_("subsurface_bsdf", CosineLobe::Hemisphere::viewer, normal, color),
        color_(color),
        radius_(radius),
        anisotropy_(anisotropy),
        is_deep_(keep(recorder, max_component(radius) > 0.0f)) {}

  std::string_view name() const override { return limit_.name(); }
  std::int32_t kinds() const override { return limit_.kinds(); }
  bool is_opaque() const override { return true; }
  Color3 throughput(const View& view) const override { return limit_.throughput(view); }
  Color3 albedo(const View& view) const override { return limit_.albedo(view); }
  Float3 normal(const View& view) const override { return limit_.normal(view); }
  Float roughness(const View& view) const override { return limit_.roughness(view); }
  bool goes_below() const override { return !is_deep_.is_constant(false); }
  Vdf medium_below() const override {
    return subsurface_medium(saturate(color_), radius_, anisotropy_);
  }

  LobeValue evaluate(const View& view, Float3 wi) const override {
    LobeValue value = limit_.evaluate(view, wi);
    const Bool enters = this->enters(view);
    value.f = select(enters, Color3(0.0f), value.f);
    value.pdf = select(enters, Float(0.0f), value.pdf);
    return value;
  }

  LobeSample sample(const View& view, Float3 u) const override {
    LobeSample result = limit_.sample(view, u);
    const Bool enters = this->enters(view);
    if (enters.is_constant(false)) return result;
    // By the surface itself and not its shading normal: into the medium, whatever is modelled.
    const Float3 below = -facing(geometric_normal(*view.recorder), view.wo);
    const Float3 wi = make_frame(below).to_world(sample_cosine(u.x, u.y));
    result.wi = select(enters, wi, result.wi);
    result.valid = true;
    result.delta = enters;
    result.delta_weight = Color3(1.0f);
    result.delta_probability = 1.0f;
    return result;
  }

 private:
  Bool enters(const View& view) const {
    if (!view.follows_subsurface) return false;
    return is_deep_ & !view.thin_walled;
  }

  LambertLobe limit_;
  Color3 color_, radius_;
  Float anisotropy_;
  Bool is_deep_;  ///< Any light gets anywhere.
};

}  // namespace

void record_closure_subsurface_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  set_lobe(call, std::make_shared<SubsurfaceLobe>(
                     recorder, prepare_facing_normal(recorder, call.vector3("normal")),
                     prepare_tint(recorder, call.vector3("color")), call.vector3("radius"),
                     call.number("anisotropy")));
}

}  // namespace nacre
