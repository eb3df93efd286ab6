#pragma once

#include "runtime/value/value.h"

namespace nacre {

/// high + low, |low| at most about an ulp of high: 48 bits or so.
/// Error-free sums and products: T. J. Dekker, A floating-point technique for
/// extending the available precision, Numer. Math. 18, 1971; with fma the
/// product's error is one operation. Exact unless something under- or overflows.
struct DoubleFloat {
  Float high;
  Float low;
};

/// a + b for |a| >= |b|, or a a multiple of the ulp of b.
inline DoubleFloat fast_two_sum(Float a, Float b) {
  const Float sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b in any order of size (D. E. Knuth, TAOCP 2, theorem 4.2.2B).
inline DoubleFloat two_sum(Float a, Float b) {
  const Float sum = a + b;
  const Float part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

inline DoubleFloat two_product(Float a, Float b) {
  const Float product = a * b;
  return {product, fma(a, b, -product)};
}

}  // namespace nacre
