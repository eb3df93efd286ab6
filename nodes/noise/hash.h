#pragma once

#include <cstdint>

#include "runtime/value/value.h"

namespace nacre {

/// Bob Jenkins' lookup3 (public domain, 2006) over one to five integers: the hash
/// under every noise of MaterialX and Open Shading Language. Wraps modulo 2^32.

inline Int rotate_left(Int x, int count) {
  return (x << Int(count)) | shift_right_logical(x, Int(32 - count));
}

struct HashState {
  Int a, b, c;
};

/// The state for a key of `length` integers.
inline HashState hash_start(std::uint32_t length) {
  const Int seed(static_cast<std::int32_t>(0xdeadbeefu + (length << 2) + 13u));
  return {seed, seed, seed};
}

/// lookup3's mix(): after every three integers but the last.
inline HashState hash_mix(HashState s) {
  s.a = (s.a - s.c) ^ rotate_left(s.c, 4);
  s.c = s.c + s.b;
  s.b = (s.b - s.a) ^ rotate_left(s.a, 6);
  s.a = s.a + s.c;
  s.c = (s.c - s.b) ^ rotate_left(s.b, 8);
  s.b = s.b + s.a;
  s.a = (s.a - s.c) ^ rotate_left(s.c, 16);
  s.c = s.c + s.b;
  s.b = (s.b - s.a) ^ rotate_left(s.a, 19);
  s.a = s.a + s.c;
  s.c = (s.c - s.b) ^ rotate_left(s.b, 4);
  s.b = s.b + s.a;
  return s;
}

/// lookup3's final(): 32 bits, the low ones as good as the high ones.
inline Int hash_finish(HashState s) {
  s.c = (s.c ^ s.b) - rotate_left(s.b, 14);
  s.a = (s.a ^ s.c) - rotate_left(s.c, 11);
  s.b = (s.b ^ s.a) - rotate_left(s.a, 25);
  s.c = (s.c ^ s.b) - rotate_left(s.b, 16);
  s.a = (s.a ^ s.c) - rotate_left(s.c, 4);
  s.b = (s.b ^ s.a) - rotate_left(s.a, 14);
  s.c = (s.c ^ s.b) - rotate_left(s.b, 24);
  return s.c;
}

inline Int hash(Int x, Int y) {
  const HashState s = hash_start(2);
  return hash_finish({s.a + x, s.b + y, s.c});
}

inline Int hash(Int x, Int y, Int z) {
  const HashState s = hash_start(3);
  return hash_finish({s.a + x, s.b + y, s.c + z});
}

/// The first three of a key of `length` integers, mixed; the rest is added to the
/// state and finished.
inline HashState hash_three_of(std::uint32_t length, Int x, Int y, Int z) {
  const HashState s = hash_start(length);
  return hash_mix({s.a + x, s.b + y, s.c + z});
}

inline Int hash(Int x, Int y, Int z, Int w) {
  const HashState s = hash_three_of(4, x, y, z);
  return hash_finish({s.a + w, s.b, s.c});
}

/// 32 bits as a number in [0, 1], both ends included: to nearest, then 2^-32.
inline Float bits_to_unit(Int bits) { return to_float_unsigned(bits) * 0x1p-32f; }

}  // namespace nacre
