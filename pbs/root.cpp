#include "pbs/root.h"

namespace nacre {

Float invert_linear(Float first, Float last, Float q) {
  const Float share = saturate(q);
  const Float sum = first + last;
  const Float root = sqrt(lerp(first * first, last * last, share));
  return select(sum > 0.0f, saturate(share * sum / (first + root)), share);
}

}  // namespace nacre
