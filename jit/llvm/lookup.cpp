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
  if (features.avx2) return {8, 8};
  return features.ssse3 ? Permute{4, 16} : Permute{};
}

/// By bytes, without AVX2.
bool is_of_bytes(Permute cpu) { return cpu.lanes == 4; }

/// Pieces of a table that are worth permuting and blending.
std::size_t most_pieces(Permute cpu) { return is_of_bytes(cpu) ? 1 : 4; }

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

/// The same where only bytes can be permuted: a permutation for each byte of a word that is not the
/// same zero in all entries.
Value* permute_bytes(FunctionEmitter& e, const std::vector<float>& values, Value* index,
                     Permute cpu) {
  Builder& b = e.builder();
  llvm::Type* bytes = llvm::FixedVectorType::get(b.getInt8Ty(), 16);
  llvm::Type* words = index->getType();
  Value* result = e.i32(0, cpu.lanes);
  for (unsigned byte = 0; byte < 4; ++byte) {
    std::vector<std::uint8_t> table;
    for (const float value : values) {
      const std::uint32_t word = flush_denormal(std::bit_cast<std::uint32_t>(value));
      table.push_back(static_cast<std::uint8_t>(word >> (8 * byte)));
    }
    table.resize(16);
    if (std::ranges::all_of(table, [](std::uint8_t part) { return part == 0; })) continue;
    // A control byte of 0x80 gives 0.
    Value* place = b.CreateShl(index, e.i32(8 * byte, cpu.lanes));
    Value* control = b.CreateOr(place, e.i32(0x80808080u & ~(0x80u << (8 * byte)), cpu.lanes));
    Value* part = b.CreateIntrinsic(
        llvm::Intrinsic::x86_ssse3_pshuf_b_128, {},
        {llvm::ConstantDataVector::get(b.getContext(), table), b.CreateBitCast(control, bytes)});
    result = b.CreateOr(result, b.CreateBitCast(part, words));
  }
  return b.CreateBitCast(result, llvm::FixedVectorType::get(b.getFloatTy(), 4));
}

/// For as many lanes as the CPU permutes at once.
Value* look_up_native(FunctionEmitter& e, const std::vector<float>& values, Value* index,
                      Permute cpu) {
  if (is_of_bytes(cpu)) return permute_bytes(e, values, index, cpu);
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
  return cpu.lanes != 0 && entries <= most_pieces(cpu) * static_cast<std::size_t>(cpu.entries);
}

bool ignores_high_bits(const Features& features, std::size_t entries, int lanes) {
  const Permute cpu = permute_of(features, lanes);
  if (cpu.lanes == 0 || is_of_bytes(cpu)) return false;
  // A table in one register, or in as many as one instruction reaches.
  return entries == static_cast<std::size_t>(cpu.lanes) ||
         entries == static_cast<std::size_t>(cpu.entries);
}

llvm::Value* look_up_in_registers(FunctionEmitter& e, const std::vector<float>& values,
                                  llvm::Value* index, int lanes) {
  return look_up_parts(e, values, index, lanes, permute_of(e.module().features(), lanes));
}

}  // namespace nacre::codegen
