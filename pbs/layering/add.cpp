#include "pbs/bsdf.h"
#include "pbs/edf.h"
#include "pbs/vdf.h"
#include "runtime/node/node_call.h"

namespace nacre {

namespace {

class AddEdf final : public Edf {
 public:
  AddEdf(EdfPtr in1, EdfPtr in2) : Edf(std::move(in1), std::move(in2)) {}
  Color3 radiance(const View&, Color3 in1, Color3 in2) const override { return in1 + in2; }
};

}  // namespace

/// add of closures: the sum; energy is the author's business. MaterialX PBS
/// 1.39, "add".
void record_closure_add(NodeCall& call) {
  const ClosurePtr& in1 = call.closure("in1");
  const ClosurePtr& in2 = call.closure("in2");
  switch (call.out_type()) {
    case Type::edf: call.set(std::make_shared<AddEdf>(as_edf(in1), as_edf(in2))); break;
    case Type::vdf: call.set(sum(as_vdf(in1), as_vdf(in2))); break;
    default: call.set(std::make_shared<AddBsdf>(as_bsdf(in1), as_bsdf(in2))); break;
  }
}

}  // namespace nacre
