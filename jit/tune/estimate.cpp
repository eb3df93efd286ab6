#include "jit/tune/estimate.h"

namespace nacre {

namespace {

/// Of vectors as wide as the machine has them, relative to an addition: how often one can begin, by
/// Agner Fog, "Instruction tables" (Zen 4, Ice Lake); a gather is so many loads.
double weight_of(Op op) {
  switch (op) {
    case Op::constant:
    case Op::argument:
    case Op::give:
    case Op::result:
    case Op::keep: return 0;
    case Op::div: return 8;
    case Op::sqrt: return 12;
    case Op::imul:
    case Op::umulhi: return 3;
    case Op::fitted: return 2;
    case Op::table:
    case Op::texel: return 10;
    case Op::texture_call: return 500;
    default: return is_structural(op) ? 0 : 1;
  }
}

}  // namespace

RunStatus CountingKernel::run(const KernelArguments& arguments) const {
  points_ += arguments.count;
  return kernel_->run_counted(arguments, counts_);
}

double CountingKernel::cost() const {
  double sum = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    sum += weight_of(static_cast<Op>(i)) * static_cast<double>(counts_[i]);
  }
  return points_ > 0 ? sum / static_cast<double>(points_) : 0;
}

}  // namespace nacre
