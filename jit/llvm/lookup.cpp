#include "jit/llvm/lookup.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <vector>

#include "jit/llvm/gather.h"
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

/// What is looked up in.
struct Entries {
  std::size_t size;
  /// Those from `first` on as a vector of `count`; beyond the end, what nobody asks for.
  std::function<Value*(std::size_t first, int count)> from;
};

Value* constant_entries(FunctionEmitter& e, const std::vector<float>& values, std::size_t first,
                        int count) {
  std::vector<llvm::Constant*> elements;
  for (std::size_t k = first; k < first + static_cast<std::size_t>(count); ++k) {
    const float value = k < values.size() ? values[k] : 0.0f;
    elements.push_back(e.f32_bits(flush_denormal(std::bit_cast<std::uint32_t>(value))));
  }
  return llvm::ConstantVector::get(elements);
}

/// The piece of the table from `first` on, permuted. Only the low bits of the
/// index count.
Value* permute(FunctionEmitter& e, const Entries& entries, std::size_t first, Value* index,
               Permute cpu) {
  Builder& b = e.builder();
  Value* low = entries.from(first, cpu.lanes);
  const bool one_register =
      cpu.entries == cpu.lanes || entries.size <= first + static_cast<std::size_t>(cpu.lanes);
  if (one_register && cpu.lanes == 16) {
    return b.CreateIntrinsic(llvm::Intrinsic::x86_avx512_permvar_sf_512, {}, {low, index});
  }
  if (one_register) return b.CreateIntrinsic(llvm::Intrinsic::x86_avx2_permps, {}, {low, index});
  Value* high = entries.from(first + static_cast<std::size_t>(cpu.lanes), cpu.lanes);
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
Value* look_up_native(FunctionEmitter& e, const Entries& entries, Value* index, Permute cpu) {
  const auto step = static_cast<std::size_t>(cpu.entries);
  Value* result = permute(e, entries, 0, index, cpu);
  for (std::size_t first = step; first < entries.size; first += step) {
    Value* reaches =
        e.builder().CreateICmpUGE(index, e.i32(static_cast<std::uint32_t>(first), cpu.lanes));
    result = e.builder().CreateSelect(reaches, permute(e, entries, first, index, cpu), result);
  }
  return result;
}

std::vector<int> range(int first, int count) {
  std::vector<int> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

/// native(index): look_up_native() or the like.
Value* look_up_parts(FunctionEmitter& e, const std::function<Value*(Value* index)>& native,
                     Value* index, int lanes, Permute cpu) {
  Builder& b = e.builder();
  if (lanes == cpu.lanes) return native(index);
  if (lanes < cpu.lanes) {
    std::vector<int> widened = range(0, cpu.lanes);
    for (int& k : widened) k = std::min(k, lanes);
    Value* wide = b.CreateShuffleVector(index, e.i32(0, lanes), widened);
    return b.CreateShuffleVector(native(wide), range(0, lanes));
  }
  const int half = lanes / 2;
  const auto part = [&](int first) {
    Value* indices = b.CreateShuffleVector(index, range(first, half));
    return look_up_parts(e, native, indices, half, cpu);
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
  const Permute cpu = permute_of(e.module().features(), lanes);
  const Entries entries{values.size(), [&](std::size_t first, int count) {
                          return constant_entries(e, values, first, count);
                        }};
  const auto native = [&](Value* part) {
    return is_of_bytes(cpu) ? permute_bytes(e, values, part, cpu)
                            : look_up_native(e, entries, part, cpu);
  };
  return look_up_parts(e, native, index, lanes, cpu);
}

llvm::Value* look_up_in_row(FunctionEmitter& e, llvm::Value* row, std::uint32_t count,
                            llvm::Value* index, int lanes) {
  const Permute cpu = permute_of(e.module().features(), lanes);
  const bool fits = fits_registers(e.module().features(), count, lanes) && !is_of_bytes(cpu);
  if (!fits) return gather(e, {Scalar::f32, row}, index, lanes);
  const Entries entries{
      count, [&](std::size_t first, int width) -> Value* {
        Value* from = e.byte_offset(row, first * sizeof(float));
        const llvm::Align align(static_cast<std::uint64_t>(width) * sizeof(float));
        return e.builder().CreateAlignedLoad(e.module().type(Scalar::f32, width), from, align);
      }};
  const auto native = [&](Value* part) { return look_up_native(e, entries, part, cpu); };
  return look_up_parts(e, native, index, lanes, cpu);
}

std::uint32_t row_room(std::uint32_t count) {
  constexpr std::uint32_t step = 32;  // The most that are permuted at once.
  return (count + step - 1) / step * step;
}

}  // namespace nacre::codegen
