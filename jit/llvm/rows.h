#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "runtime/program/program.h"

namespace nacre::codegen {

/// What an entry computes of values that are there once a call and of one index that differs from
/// lane to lane, as look-ups in tables are along axes on which all lanes have one place: a number
/// for each index. A call of many points computes the row once and reads it, with the same bits.
struct Row {
  ValueId value = no_value;    ///< Which has these numbers,
  ValueId index = no_value;    ///< of this, an i32.
  std::uint32_t count = 0;     ///< For the indices 0 to count - 1.
  std::vector<ValueId> steps;  ///< What computes it, in order: all that differs by the index.
};

/// Values of one index that are read together, where the first of them stands.
struct RowGroup {
  struct Read {
    ValueId value;
    std::uint32_t row;    ///< Of Rows::rows.
    std::uint32_t shift;  ///< It is the row's number of so much more than the index.
  };
  ValueId index = no_value;
  std::vector<Read> reads;     ///< By value.
  std::vector<ValueId> steps;  ///< What computes them all without a row.
};

struct Rows {
  std::vector<Row> rows;
  std::map<ValueId, RowGroup> groups;  ///< By the first value.
  /// By instruction: only groups need it, and emit it themselves.
  std::vector<bool> is_in_group;
  std::vector<bool> once;          ///< once_per_call, and what rows need out of regions.
  std::uint64_t least_points = 0;  ///< From so many on rows take less time than they save.
};

/// Of an entry that is emitted for so many lanes.
Rows find_rows(const Function& entry, int lanes);

}  // namespace nacre::codegen
