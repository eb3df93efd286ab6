#include "runtime/interpreter/lanes_impl.h"

namespace nacre {

const LaneOps& lane_ops_sse42() {
  static const LaneOps table = make_lane_ops<xsimd::sse4_2>();
  return table;
}

}  // namespace nacre
