#include "pbs/edf.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

class UniformEdf final : public Edf {
 public:
  explicit UniformEdf(Color3 color) : color_(color) {}
  Color3 radiance(const View&, Color3, Color3) const override { return color_; }

 private:
  Color3 color_;
};

}  // namespace

/// uniform_edf: the same radiance in all directions, on both sides. MaterialX
/// PBS 1.39, "uniform_edf". Components below zero, and NaN, count as zero.
void record_closure_uniform_edf(NodeCall& call) {
  call.set(std::make_shared<UniformEdf>(max(call.vector3("color"), Color3(0.0f))));
}

}  // namespace nacre
