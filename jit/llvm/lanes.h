#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include "jit/llvm/function_emitter.h"

namespace nacre::codegen {

/// Lane k of a vector; of a scalar, itself.
inline llvm::Value* lane(FunctionEmitter& e, llvm::Value* value, int k) {
  if (!value->getType()->isVectorTy()) return value;
  return e.builder().CreateExtractElement(value, static_cast<std::uint64_t>(k));
}

/// make(k) for every lane k, put together.
template <class F>
llvm::Value* each_lane(FunctionEmitter& e, Scalar scalar, int lanes, F&& make) {
  if (lanes == 1) return make(0);
  llvm::Value* all = llvm::PoisonValue::get(e.module().type(scalar, lanes));
  for (int k = 0; k < lanes; ++k) {
    all = e.builder().CreateInsertElement(all, make(k), static_cast<std::uint64_t>(k));
  }
  return all;
}

}  // namespace nacre::codegen
