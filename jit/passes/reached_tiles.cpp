#include "jit/passes/reached_tiles.h"

#include <algorithm>
#include <string_view>

#include "runtime/texture/tile_set.h"

namespace nacre {

namespace {

bool has_tiles(const Table& table) { return table.name.starts_with(tile_table_prefix); }

/// Of what the index of a look-up may be those entries that are slots.
void add_slots(const Table& table, const Range& index, std::vector<bool>& slots) {
  const auto last = static_cast<double>(table.values.size() - 1);
  const bool is_known = index.is_bounded();
  const double from = is_known ? std::clamp(index.low, 0.0, last) : 0.0;
  const double to = is_known ? std::clamp(index.high, 0.0, last) : last;
  for (auto i = static_cast<std::size_t>(from); i <= static_cast<std::size_t>(to); ++i) {
    const float slot = table.values[i];
    if (slot >= 0.0f) slots[static_cast<std::size_t>(slot)] = true;
  }
}

}  // namespace

std::vector<bool> reached_textures(const Program& program, std::span<const Range> inputs) {
  std::vector<bool> of_tiles(program.textures.size());
  for (const Table& table : program.tables) {
    if (has_tiles(table)) add_slots(table, {}, of_tiles);
  }
  std::vector<bool> reached = of_tiles;
  reached.flip();
  const std::vector<Range> ranges = ranges_of(program, inputs);
  for (std::size_t f = 0; f < program.functions.size(); ++f) {
    const auto& code = program.functions[f].code;
    for (const Instruction& instruction : code) {
      if (instruction.op != Op::table || !has_tiles(program.tables[instruction.imm])) continue;
      // Of arguments of functions nothing is known.
      const Range index = f == 0 ? ranges[instruction.operands[0]] : Range{};
      add_slots(program.tables[instruction.imm], index, reached);
    }
  }
  return reached;
}

}  // namespace nacre
