#include "pbs/bsdf.h"
#include "pbs/edf.h"
#include "pbs/vdf.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

class MultiplyEdf final : public Edf {
 public:
  MultiplyEdf(EdfPtr in1, Color3 tint) : Edf(std::move(in1)), tint_(tint) {}
  Color3 radiance(const View&, Color3 in1, Color3) const override { return product(in1, tint_); }
  Color3 part_power(std::size_t, Color3 power) const override { return power_seen(power, tint_); }

 private:
  Color3 tint_;
};

}  // namespace

/// multiply of a closure by a float or colour. MaterialX PBS 1.39, "multiply".
/// For a BSDF the factor is clamped to [0, 1], as the data library's own
/// implementations do; an EDF's and a VDF's only
/// from below.
void record_closure_multiply(NodeCall& call) {
  const Recorded& factor = call.in("in2");
  const Color3 tint = factor.parts.size() == 1 ? Color3(factor.number()) : call.vector3("in2");
  const ClosurePtr& in1 = call.closure("in1");
  const Color3 positive = max(tint, Color3(0.0f));
  switch (call.out_type()) {
    case Type::edf: call.set(std::make_shared<MultiplyEdf>(as_edf(in1), positive)); break;
    case Type::vdf: call.set(scaled(as_vdf(in1), positive)); break;
    default:
      call.set(std::make_shared<MultiplyBsdf>(as_bsdf(in1), keep(call.recorder(), saturate(tint))));
      break;
  }
}

}  // namespace nacre
