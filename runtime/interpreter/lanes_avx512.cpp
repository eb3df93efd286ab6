#include "runtime/interpreter/lanes_impl.h"

namespace nacre {

const LaneOps& lane_ops_avx512() {
  static const LaneOps table = make_lane_ops<xsimd::avx512bw>();
  return table;
}

}  // namespace nacre
