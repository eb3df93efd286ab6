#include "jit/llvm/gather.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <numeric>

#include "jit/llvm/lanes.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

/// As many as an instruction of the CPU gathers at once.
constexpr int native_lanes = 16;

/// Lane k of an index as 64 bits. One by one: lanes in pairs, a tenth faster, LLVM
/// 19.1 miscompiles at times (the mask of the lower one is lost).
Value* offset(FunctionEmitter& e, Value* index, int k) {
  return e.builder().CreateZExt(lane(e, index, k), e.builder().getInt64Ty());
}

/// Vectors of equal type, one after the other.
Value* concatenate(Builder& b, std::vector<Value*> parts) {
  while (parts.size() > 1) {
    const auto* type = llvm::cast<llvm::FixedVectorType>(parts.front()->getType());
    std::vector<int> both(2 * type->getNumElements());
    std::iota(both.begin(), both.end(), 0);
    std::vector<Value*> longer;
    for (std::size_t k = 0; k < parts.size(); k += 2) {
      longer.push_back(b.CreateShuffleVector(parts[k], parts[k + 1], both));
    }
    parts = std::move(longer);
  }
  return parts.front();
}

/// In every four elements of two vectors the same: element k of `pattern` is 0 to
/// 3 from a, 4 to 7 from b. The shuffles that cost least.
Value* shuffle_fours(Builder& b, Value* first, Value* second, const std::array<int, 4>& pattern) {
  const auto* type = llvm::cast<llvm::FixedVectorType>(first->getType());
  const int lanes = static_cast<int>(type->getNumElements());
  std::vector<int> indices;
  for (int four = 0; four < lanes; four += 4) {
    for (const int k : pattern) indices.push_back(four + k % 4 + (k < 4 ? 0 : lanes));
  }
  return b.CreateShuffleVector(first, second, indices);
}

/// Vectors of the words w of all lanes, from runs of two words a lane.
std::vector<Value*> transpose_twos(Builder& b, const std::vector<Value*>& runs) {
  std::array<std::vector<Value*>, 2> rows;
  for (std::size_t k = 0; k < runs.size(); ++k) rows[k / 2 % 2].push_back(runs[k]);
  Value* front = concatenate(b, rows[0]);
  Value* back = concatenate(b, rows[1]);
  return {shuffle_fours(b, front, back, {0, 2, 4, 6}), shuffle_fours(b, front, back, {1, 3, 5, 7})};
}

/// The same from runs of four: lanes 0, 4, 8, ... make one row, so that each group
/// of four lanes is a matrix of its own.
std::vector<Value*> transpose_fours(Builder& b, const std::vector<Value*>& runs) {
  std::array<std::vector<Value*>, 4> parts;
  for (std::size_t k = 0; k < runs.size(); ++k) parts[k % 4].push_back(runs[k]);
  std::array<Value*, 4> row{};
  for (std::size_t k = 0; k < 4; ++k) row[k] = concatenate(b, parts[k]);
  constexpr std::array<int, 4> low{0, 4, 1, 5}, high{2, 6, 3, 7};
  Value* front_low = shuffle_fours(b, row[0], row[1], low);
  Value* front_high = shuffle_fours(b, row[0], row[1], high);
  Value* back_low = shuffle_fours(b, row[2], row[3], low);
  Value* back_high = shuffle_fours(b, row[2], row[3], high);
  constexpr std::array<int, 4> even{0, 1, 4, 5}, odd{2, 3, 6, 7};
  return {shuffle_fours(b, front_low, back_low, even), shuffle_fours(b, front_low, back_low, odd),
          shuffle_fours(b, front_high, back_high, even),
          shuffle_fours(b, front_high, back_high, odd)};
}

bool gathers_natively(FunctionEmitter& e, int lanes) {
  return lanes == native_lanes && e.module().features().fast_gather;
}

/// What an instruction of the CPU gathers from.
struct Gathered {
  Value* array;
  Value* index;
};

/// By indices as the CPU takes them, which has signed ones: where there are more words, from the
/// middle of what 32 bits reach.
Gathered by_signed_index(FunctionEmitter& e, const Words& words, Value* index) {
  if (!words.are_many) return {words.first, index};
  Builder& b = e.builder();
  constexpr std::uint32_t middle = 0x8000'0000u;
  Value* address = b.CreateConstGEP1_64(b.getInt32Ty(), words.first, middle);
  return {address, b.CreateXor(index, e.i32(middle, native_lanes))};
}

/// For each element of the index what lies there, a word or a pair of them. LLVM does not know that
/// nobody writes there, and moves none of these over a store.
Value* gather_natively(FunctionEmitter& e, llvm::Intrinsic::ID intrinsic, llvm::Type* element,
                       Value* array, Value* index) {
  Builder& b = e.builder();
  const unsigned count = llvm::cast<llvm::FixedVectorType>(index->getType())->getNumElements();
  llvm::Type* result = llvm::FixedVectorType::get(element, count);
  llvm::Type* mask = llvm::FixedVectorType::get(b.getInt1Ty(), count);
  return b.CreateIntrinsic(intrinsic, {},
                           {llvm::PoisonValue::get(result), array, index,
                            llvm::Constant::getAllOnesValue(mask), b.getInt32(sizeof(float))});
}

/// Vectors of the words w of all lanes, from runs of two words a lane.
std::vector<Value*> gather_twos(FunctionEmitter& e, Scalar scalar, const Gathered& from) {
  Builder& b = e.builder();
  std::vector<Value*> halves;
  for (const int first : {0, native_lanes / 2}) {
    std::vector<int> lanes(native_lanes / 2);
    std::iota(lanes.begin(), lanes.end(), first);
    Value* pairs =
        gather_natively(e, llvm::Intrinsic::x86_avx512_mask_gather_dpd_512, b.getDoubleTy(),
                        from.array, b.CreateShuffleVector(from.index, lanes));
    halves.push_back(b.CreateBitCast(pairs, e.module().type(scalar, native_lanes)));
  }
  std::vector<Value*> words;
  for (const int word : {0, 1}) {
    std::vector<int> places;
    for (int lane = 0; lane < native_lanes; ++lane) places.push_back(2 * lane + word);
    words.push_back(b.CreateShuffleVector(halves[0], halves[1], places));
  }
  return words;
}

}  // namespace

llvm::Value* gather(FunctionEmitter& e, const Words& words, llvm::Value* index, int lanes) {
  llvm::Type* type = e.module().type(words.scalar, 1);
  if (gathers_natively(e, lanes)) {
    const auto intrinsic = words.scalar == Scalar::f32
                               ? llvm::Intrinsic::x86_avx512_mask_gather_dps_512
                               : llvm::Intrinsic::x86_avx512_mask_gather_dpi_512;
    const Gathered from = by_signed_index(e, words, index);
    return gather_natively(e, intrinsic, type, from.array, from.index);
  }
  return each_lane(e, words.scalar, lanes, [&](int k) {
    return e.load_invariant(type,
                            e.builder().CreateInBoundsGEP(type, words.first, offset(e, index, k)));
  });
}

std::vector<llvm::Value*> gather_run(FunctionEmitter& e, const Words& words, llvm::Value* first,
                                     int lanes, std::size_t count) {
  Builder& b = e.builder();
  if (gathers_natively(e, lanes)) {
    const Gathered from = by_signed_index(e, words, first);
    std::vector<Value*> found = gather_twos(e, words.scalar, from);
    if (count == 2) return found;
    Value* third = b.CreateAdd(from.index, e.i32(2, lanes));
    std::ranges::copy(gather_twos(e, words.scalar, {from.array, third}), std::back_inserter(found));
    return found;
  }
  llvm::Type* type = e.module().type(words.scalar, 1);
  llvm::Type* run = llvm::FixedVectorType::get(type, static_cast<unsigned>(count));
  std::vector<Value*> runs;
  for (int k = 0; k < lanes; ++k) {
    runs.push_back(
        e.load_invariant(run, b.CreateInBoundsGEP(type, words.first, offset(e, first, k))));
  }
  return count == 2 ? transpose_twos(b, runs) : transpose_fours(b, runs);
}

}  // namespace nacre::codegen
