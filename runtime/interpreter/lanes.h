#pragma once

#include <array>
#include <cstdint>

#include "runtime/program/op.h"

namespace nacre {

/// Lanes in one register of the interpreter. Enough to hide the dispatch, few
/// enough that a kernel's registers stay in the L2 cache.
inline constexpr int block_lanes = 64;

/// One register: the bits of each lane; b1 as 0 or ~0.
using Register = std::array<std::uint32_t, block_lanes>;

/// d = op(a, b, c) over all lanes. Unused operands may be null.
using LaneOp = void (*)(std::uint32_t* d, const std::uint32_t* a, const std::uint32_t* b,
                        const std::uint32_t* c);

/// One function an operation, null where the interpreter itself does the work. Op::table, which
/// has another operand in the Program, takes the index, the table's words and the last index.
using LaneOps = std::array<LaneOp, op_count>;

/// The functions for the widest vectors that this machine has.
const LaneOps& lane_ops();

// One a translation unit, compiled for that instruction set.
const LaneOps& lane_ops_sse42();
const LaneOps& lane_ops_avx2();
const LaneOps& lane_ops_avx512();

}  // namespace nacre
