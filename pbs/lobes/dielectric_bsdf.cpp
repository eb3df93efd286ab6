#include "pbs/bsdf.h"
#include "pbs/microfacet_interface.h"

namespace nacre {

namespace {

/// Index of the inside over the outside, real; seen from inside it inverts.
class DielectricFresnel final : public FacetFresnel {
 public:
  DielectricFresnel(Recorder& recorder, Float index) : index_(keep(recorder, index)) {}

  Color3 at(Float cosine, Bool inside) const override {
    return Color3(fresnel_dielectric(cosine, relative_index(index_, inside)));
  }

  Float index() const override { return index_; }
  bool has_inside() const override { return true; }
  bool is_dielectric() const override { return true; }

 private:
  Float index_;
};

}  // namespace

void record_closure_dielectric_bsdf(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const Float index = clamp(call.number("ior"), 0.02f, 50.0f);
  const Color3 tint = prepare_tint(recorder, call.vector3("tint"));
  const auto fresnel = std::make_shared<DielectricFresnel>(recorder, index);
  const MicrofacetReflection::Options options{
      .name = "dielectric_bsdf", .tint = tint, .retroreflective = call.boolean("retroreflective")};
  call.set(std::make_shared<LobeBsdf>(
      microfacet_lobe(recorder, call.text("scatter_mode"), prepare_facets(call), fresnel, options),
      prepare_weight(call)));
}

}  // namespace nacre
