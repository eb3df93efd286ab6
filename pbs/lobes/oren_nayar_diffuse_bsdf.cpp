#include "pbs/bsdf.h"
#include "pbs/sampling.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

/// Oren and Nayar, "Generalization of Lambert's reflectance model", SIGGRAPH
/// 1994: the qualitative model (eq. 27, without interreflection), with the s / t
/// form that needs no trigonometry. Roughness is the standard deviation of the
/// facets' angle in radians. Loses energy: albedo 0.62 at roughness 1 and
/// normal incidence for a white surface.
class OrenNayar final : public Lobe {
 public:
  OrenNayar(Recorder& recorder, Color3 color, Float roughness, Float3 normal)
      : color_(keep(recorder, color)), normal_(keep(recorder, normal)) {
    const Float sigma2 = square(roughness);
    a_ = keep(recorder, 1.0f - 0.5f * (sigma2 / (sigma2 + 0.33f)));
    b_ = keep(recorder, 0.45f * (sigma2 / (sigma2 + 0.09f)));
  }

  std::string_view name() const override { return "oren_nayar_diffuse_bsdf"; }
  std::int32_t kinds() const override { return lobe_diffuse_reflection; }
  bool is_opaque() const override { return true; }

  LobeValue evaluate(const View& view, Float3 wi) const override {
    const Float3 n = facing(normal_, view.wo);
    const Float cos_o = max(dot(n, view.wo), 0.0f);
    const Float cos_i = dot(n, wi);
    const Float s = dot(view.wo, wi) - cos_i * cos_o;
    const Float t = select(s > 0.0f, max(max(cos_i, cos_o), 1e-8f), 1.0f);
    const Float pdf = max(cos_i, 0.0f) * one_over_pi;
    return {.f = color_ * Float3(fma(b_, s / t, a_) * pdf), .pdf = pdf};
  }

  LobeSample sample(const View& view, Float3 u) const override {
    const Frame frame = make_frame(facing(normal_, view.wo));
    return {.wi = frame.to_world(sample_cosine(u.x, u.y)), .valid = true};
  }

  Color3 albedo(const View&) const override { return saturate(color_ * Float3(a_)); }
  Color3 throughput(const View&) const override { return Color3(0.0f); }

 private:
  Color3 color_;
  Float3 normal_;
  Float a_, b_;
};

}  // namespace

void record_closure_oren_nayar_diffuse_bsdf(NodeCall& call) {
  auto lobe = std::make_shared<OrenNayar>(call.recorder(), max(call.vector3("color"), Color3(0.0f)),
                                          max(call.number("roughness"), 0.0f),
                                          call.vector3("normal"));
  call.set(std::make_shared<LobeBsdf>(std::move(lobe),
                                      keep(call.recorder(), max(call.number("weight"), 0.0f))));
}

}  // namespace nacre
