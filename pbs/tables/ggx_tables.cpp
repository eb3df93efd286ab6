#include "pbs/tables/ggx_tables.h"

namespace nacre {

namespace {

#include "pbs/tables/ggx_tables.inc"

}  // namespace

const GgxTable& ggx_reflection_table() {
  static const GgxTable table{24, 20, 1, 3, reflection_values};
  return table;
}

const GgxTable& ggx_stretched_table() {
  static const GgxTable table{24, 16, 10, 2, stretched_values};
  return table;
}

const GgxTable& ggx_entering_table() {
  static const GgxTable table{32, 10, 8, 2, entering_values};
  return table;
}

const GgxTable& ggx_leaving_table() {
  static const GgxTable table{16, 16, 24, 3, leaving_values};
  return table;
}

}  // namespace nacre
