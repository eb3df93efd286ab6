#include "pbs/edf.h"
#include "pbs/sampling.h"
#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

class UniformEdf final : public Emitter {
 public:
  explicit UniformEdf(Color3 color) : color_(color) {}
  Color3 radiance(const View&, Color3, Color3) const override { return color_; }

  Color3 power() const override { return power_seen(color_, Color3(2.0f * pi)); }
  // By the cosine to the surface itself, on both its sides: all samples weigh the same.
  Float3 sample(const View& view, Float3 u) const override {
    Float3 local = sample_cosine(u.x, u.y);
    local.z = select(u.z < 0.5f, local.z, -local.z);
    return make_frame(geometric_normal(*view.recorder)).to_world(local);
  }
  Float pdf(const View& view) const override {
    return abs(dot(geometric_normal(*view.recorder), view.wo)) * (0.5f * one_over_pi);
  }

 private:
  Color3 color_;
};

}  // namespace

EdfPtr uniform_edf(Color3 radiance) { return std::make_shared<UniformEdf>(radiance); }

/// uniform_edf: the same radiance in all directions, on both sides. MaterialX
/// PBS 1.39, "uniform_edf". Components below zero, and NaN, count as zero.
void record_closure_uniform_edf(NodeCall& call) {
  call.set(uniform_edf(max(call.vector3("color"), Color3(0.0f))));
}

}  // namespace nacre
