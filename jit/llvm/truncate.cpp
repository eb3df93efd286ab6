#include "jit/llvm/truncate.h"

#include <numeric>
#include <vector>

namespace nacre::codegen {

namespace {

using llvm::Value;

/// cvttps2dq: 0x80000000 for NaN and beyond the range. Its intrinsics, because
/// LLVM's own fptosi is undefined there.
Value* convert(FunctionEmitter& e, Value* x, unsigned lanes) {
  Builder& b = e.builder();
  switch (lanes) {
    case 4: return b.CreateIntrinsic(llvm::Intrinsic::x86_sse2_cvttps2dq, {}, {x});
    case 8: return b.CreateIntrinsic(llvm::Intrinsic::x86_avx_cvtt_ps2dq_256, {}, {x});
    default: break;
  }
  constexpr std::uint32_t current_rounding = 4;  // _MM_FROUND_CUR_DIRECTION.
  return b.CreateIntrinsic(llvm::Intrinsic::x86_avx512_mask_cvttps2dq_512, {},
                           {x, e.i32(0, 16), llvm::ConstantInt::getAllOnesValue(b.getInt16Ty()),
                            b.getInt32(current_rounding)});
}

Value* convert_scalar(FunctionEmitter& e, Value* x) {
  Builder& b = e.builder();
  Value* vector = b.CreateInsertElement(llvm::PoisonValue::get(e.module().type(Scalar::f32, 4)), x,
                                        std::uint64_t{0});
  return b.CreateIntrinsic(llvm::Intrinsic::x86_sse_cvttss2si, {}, {vector});
}

std::vector<int> range(int first, int count) {
  std::vector<int> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

/// In pieces that the CPU has an instruction for.
Value* convert_in_pieces(FunctionEmitter& e, Value* x, int lanes) {
  const Features& features = e.module().features();
  const int widest = features.avx512 && lanes == 16 ? 16 : features.avx ? 8 : 4;
  if (lanes <= widest) return convert(e, x, static_cast<unsigned>(lanes));
  Builder& b = e.builder();
  Value* low = convert_in_pieces(e, b.CreateShuffleVector(x, range(0, lanes / 2)), lanes / 2);
  Value* high =
      convert_in_pieces(e, b.CreateShuffleVector(x, range(lanes / 2, lanes / 2)), lanes / 2);
  return b.CreateShuffleVector(low, high, range(0, lanes));
}

}  // namespace

llvm::Value* truncate_saturated(FunctionEmitter& e, Value* x, int lanes) {
  Builder& b = e.builder();
  Value* converted = lanes == 1 ? convert_scalar(e, x) : convert_in_pieces(e, x, lanes);
  // Below the range the instruction gives the right answer by itself.
  Value* limit = llvm::ConstantFP::get(x->getType(), 2147483648.0);
  Value* numbers = b.CreateSelect(b.CreateFCmpORD(x, x), converted, e.i32(0, lanes));
  return b.CreateSelect(b.CreateFCmpOGE(x, limit), e.i32(0x7fffffffu, lanes), numbers);
}

}  // namespace nacre::codegen
