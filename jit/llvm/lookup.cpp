#include "jit/llvm/lookup.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <vector>

#include "runtime/program/fold.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

/// How a CPU permutes: `lanes` indices at once into `entries` of a table.
struct Permute {
  int lanes = 0;  ///< 0: it can't, or it does not pay.
  int entries = 0;
};

Permute permute_of(const Features& features, int lanes) {
  if (lanes == 1) return {};
  if (features.avx512) return lanes == 16 ? Permute{16, 32} : Permute{8, 16};
  return features.avx2 ? Permute{8, 8} : Permute{};
}

/// Pieces of a table that are worth permuting and blending.
constexpr std::size_t most_pieces = 4;

/// Table entries first ... first + count - 1; beyond the end, zeros nobody asks for.
Value* entries(FunctionEmitter& e, const std::vector<float>& values, std::size_t first, int count) {
  std::vector<llvm::Constant*> elements;
  for (std::size_t k = first; k < first + static_cast<std::size_t>(count); ++k) {
    const float value = k < values.size() ? values[k] : 0.0f;
    elements.push_back(e.f32_bits(flush_denormal(std::bit_cast<std::uint32_t>(value))));
  }
  return llvm::ConstantVector::get(elements);
}

/// The piece of the table from `first` on, permuted. Only the low bits of the
/// index count.
Value* permute(FunctionEmitter& e, const std::vector<float>& values, std::size_t first,
               Value* index, Permute cpu) {
  Builder& b = e.builder();
  Value* low = entries(e, values, first, cpu.lanes);
  const bool one_register =
      cpu.entries == cpu.lanes || values.size() <= first + static_cast<std::size_t>(cpu.lanes);
  if (one_register && cpu.lanes == 16) {
    return b.CreateIntrinsic(llvm::Intrinsic::x86_avx512_permvar_sf_512, {}, {low, index});
  }
  if (one_register) return b.CreateIntrinsic(llvm::Intrinsic::x86_avx2_permps, {}, {low, index});
  Value* high = entries(e, values, first + static_cast<std::size_t>(cpu.lanes), cpu.lanes);
  const auto both = cpu.lanes == 16 ? llvm::Intrinsic::x86_avx512_vpermi2var_ps_512
                                    : llvm::Intrinsic::x86_avx512_vpermi2var_ps_256;
  return b.CreateIntrinsic(both, {}, {low, index, high});
}

/// For as many lanes as the CPU permutes at once.
Value* look_up_native(FunctionEmitter& e, const std::vector<float>& values, Value* index,
                      Permute cpu) {
  const auto step = static_cast<std::size_t>(cpu.entries);
  Value* result = permute(e, values, 0, index, cpu);
  for (std::size_t first = step; first < values.size(); first += step) {
    Value* reaches =
        e.builder().CreateICmpUGE(index, e.i32(static_cast<std::uint32_t>(first), cpu.lanes));
    result = e.builder().CreateSelect(reaches, permute(e, values, first, index, cpu), result);
  }
  return result;
}

std::vector<int> range(int first, int count) {
  std::vector<int> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

Value* look_up_parts(FunctionEmitter& e, const std::vector<float>& values, Value* index, int lanes,
                     Permute cpu) {
  Builder& b = e.builder();
  if (lanes == cpu.lanes) return look_up_native(e, values, index, cpu);
  if (lanes < cpu.lanes) {
    std::vector<int> widened = range(0, cpu.lanes);
    for (int& k : widened) k = std::min(k, lanes);
    Value* wide = b.CreateShuffleVector(index, e.i32(0, lanes), widened);
    return b.CreateShuffleVector(look_up_native(e, values, wide, cpu), range(0, lanes));
  }
  const int half = lanes / 2;
  const auto part = [&](int first) {
    Value* indices = b.CreateShuffleVector(index, range(first, half));
    return look_up_parts(e, values, indices, half, cpu);
  };
  Value* low = part(0);
  return b.CreateShuffleVector(low, part(half), range(0, lanes));
}

}  // namespace

bool fits_registers(const Features& features, std::size_t entries, int lanes) {
  const Permute cpu = permute_of(features, lanes);
  return cpu.lanes != 0 && entries <= most_pieces * static_cast<std::size_t>(cpu.entries);
}

bool ignores_high_bits(const Features& features, std::size_t entries, int lanes) {
  const Permute cpu = permute_of(features, lanes);
  // With half as many entries as lanes the other half is zeros.
  const auto whole = static_cast<std::size_t>(cpu.entries),
             half = static_cast<std::size_t>(cpu.lanes);
  return cpu.lanes != 0 && (entries == whole || entries == half);
}

llvm::Value* look_up_in_registers(FunctionEmitter& e, const std::vector<float>& values,
                                  llvm::Value* index, int lanes) {
  return look_up_parts(e, values, index, lanes, permute_of(e.module().features(), lanes));
}

}  // namespace nacre::codegen
