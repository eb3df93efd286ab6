#include "runtime/interpreter/lanes.h"

namespace nacre {

namespace {

const LaneOps& choose() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq")) {
    return lane_ops_avx512();
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return lane_ops_avx2();
  return lane_ops_sse42();
}

}  // namespace

const LaneOps& lane_ops() {
  static const LaneOps& chosen = choose();
  return chosen;
}

}  // namespace nacre
