#pragma once

#include <array>
#include <cstdint>

#include "runtime/program/op.h"

namespace nacre {

/// Lanes in one register of the interpreter. Enough to hide the dispatch, few
/// enough that a kernel's registers stay in the L2 cache.
inline constexpr int block_lanes = 64;

/// One register: the bits of each lane; b1 as 0 or ~0. In whole lines of the cache: vectors that
/// lie across two take twice as long to load.
struct alignas(64) Register : std::array<std::uint32_t, block_lanes> {};

/// d = op(a, b, c) over all lanes. Unused operands may be null.
using LaneOp = void (*)(std::uint32_t* d, const std::uint32_t* a, const std::uint32_t* b,
                        const std::uint32_t* c);

/// d = table[index], the index clamped to [0, last], over all lanes.
using LookUp = void (*)(std::uint32_t* d, const std::uint32_t* index, const std::uint32_t* table,
                        std::int32_t last);

struct LaneOps {
  /// By operation; null where the interpreter itself does the work.
  std::array<LaneOp, op_count> of{};
  LookUp look_up = nullptr;
};

/// The functions for the widest vectors that this machine has.
const LaneOps& lane_ops();

// One a translation unit, compiled for that instruction set.
const LaneOps& lane_ops_sse42();
const LaneOps& lane_ops_avx2();
const LaneOps& lane_ops_avx512();

}  // namespace nacre
