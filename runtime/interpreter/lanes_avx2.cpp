#include "runtime/interpreter/lanes_impl.h"

namespace nacre {

const LaneOps& lane_ops_avx2() {
  static const LaneOps table = make_lane_ops<xsimd::fma3<xsimd::avx2>>();
  return table;
}

}  // namespace nacre
