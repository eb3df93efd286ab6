#pragma once

// Included by one translation unit an instruction set, each compiled with its
// own flags. Everything is in an unnamed namespace, so that the linker can't
// give one unit's code to another.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "runtime/interpreter/lanes.h"

namespace nacre {
namespace {

template <class Arch>
struct Lanes {
  using F = xsimd::batch<float, Arch>;
  using I = xsimd::batch<std::int32_t, Arch>;
  using U = xsimd::batch<std::uint32_t, Arch>;
  static constexpr std::size_t width = F::size;
  static constexpr bool has_fma = !std::is_same_v<Arch, xsimd::sse4_2>;

  template <class V>
  static V load(const std::uint32_t* p) {
    return V::load_unaligned(reinterpret_cast<const typename V::value_type*>(p));
  }
  template <class V>
  static void put(std::uint32_t* p, V value) {
    value.store_unaligned(reinterpret_cast<typename V::value_type*>(p));
  }
  using FloatMask = xsimd::batch_bool<float, Arch>;
  static I words(FloatMask mask) {
    return xsimd::bitwise_cast<I>(xsimd::select(mask, xsimd::bitwise_cast<F>(I(-1)), F(0.0f)));
  }
  static auto integer_mask(FloatMask mask) { return words(mask) != I(0); }

  // Truth values in memory are whole words.
  static void put(std::uint32_t* p, FloatMask value) { put(p, words(value)); }
  static void put(std::uint32_t* p, xsimd::batch_bool<std::int32_t, Arch> value) {
    put(p, xsimd::select(value, I(-1), I(0)));
  }

  template <class V, class F1>
  static void unary(std::uint32_t* d, const std::uint32_t* a, F1 f) {
    for (std::size_t i = 0; i < block_lanes; i += width) put(d + i, f(load<V>(a + i)));
  }
  template <class V, class F2>
  static void binary(std::uint32_t* d, const std::uint32_t* a, const std::uint32_t* b, F2 f) {
    for (std::size_t i = 0; i < block_lanes; i += width) {
      put(d + i, f(load<V>(a + i), load<V>(b + i)));
    }
  }

  static F fused(F a, F b, F c) {
    if constexpr (width == 16) {
      // xsimd 8.1 knows no fma of AVX-512; what it does instead rounds twice.
      return F(_mm512_fmadd_ps(a, b, c));
    } else if constexpr (has_fma) {
      return xsimd::fma(a, b, c);
    } else {
      alignas(64) float x[width], y[width], z[width];
      a.store_aligned(x), b.store_aligned(y), c.store_aligned(z);
      for (std::size_t i = 0; i < width; ++i) z[i] = std::fma(x[i], y[i], z[i]);
      return F::load_aligned(z);
    }
  }

  static I truncate_saturated(F x) {
    const I converted = xsimd::to_int(x);
    const auto too_large = integer_mask(x >= F(2147483648.0f));
    const auto is_nan = integer_mask(!(x == x));
    // Below the range x86 gives the smallest integer by itself.
    return xsimd::select(is_nan, I(0), xsimd::select(too_large, I(INT32_MAX), converted));
  }

  static void look_up(std::uint32_t* d, const std::uint32_t* index, const std::uint32_t* table,
                      std::int32_t last) {
    const auto clamped = [&](std::size_t i) {
      return xsimd::min(xsimd::max(load<I>(index + i), I(0)), I(last));
    };
    if constexpr (width == 16) {
      if (last < 16) {
        alignas(64) std::uint32_t entries[16] = {};
        for (std::int32_t k = 0; k <= last; ++k) entries[k] = table[k];
        const I all = load<I>(entries);
        for (std::size_t i = 0; i < block_lanes; i += width) {
          put(d + i, I(_mm512_permutexvar_epi32(clamped(i), all)));
        }
        return;
      }
    }
    alignas(64) std::uint32_t at[block_lanes];
    for (std::size_t i = 0; i < block_lanes; i += width) put(at + i, clamped(i));
    for (std::size_t i = 0; i < block_lanes; ++i) d[i] = table[at[i]];
  }

  static F from_unsigned(I x) {
    // Halves convert exactly, so the sum is the only rounding.
    const F high = xsimd::to_float((x >> 16) & I(0xffff));
    const F low = xsimd::to_float(x & I(0xffff));
    return fused(high, F(65536.0f), low);
  }

  static I flush_denormal(I bits) {
    const auto denormal = (bits & I(0x7f800000)) == I(0);
    return xsimd::select(denormal, bits & I(INT32_MIN), bits);
  }

  static I canonical_bits(F x) {
    return xsimd::select(integer_mask(!(x == x)), I(0x7fc00000), xsimd::bitwise_cast<I>(x));
  }

  /// The binary16 in the low half: exponent and mantissa moved into place and
  /// rescaled by 2^112; exact because a half's denormal is a float's normal.
  static F from_half(I bits) {
    const I sign = (bits & I(0x8000)) << 16;
    const I magnitude = bits & I(0x7fff);
    // Integer route for denormals: mantissa * 2^-24.
    const F small = xsimd::to_float(magnitude) * F(0x1p-24f);
    const I normal = (magnitude << 13) + I(112 << 23);
    const I special = (magnitude << 13) + I(224 << 23);
    I result = xsimd::select(magnitude < I(0x0400), xsimd::bitwise_cast<I>(small), normal);
    result = xsimd::select(magnitude >= I(0x7c00), special, result);
    return xsimd::bitwise_cast<F>(result | sign);
  }
};

template <class Arch>
LaneOps make_lane_ops() {
  using L = Lanes<Arch>;
  using F = typename L::F;
  using I = typename L::I;
  using W = std::uint32_t;
  LaneOps ops{};
  const auto at = [&](Op op) -> LaneOp& { return ops.of[static_cast<std::size_t>(op)]; };

#define NACRE_UNARY(op, V, ...)                                  \
  at(op) = [](W* d, const W* a, const W*, const W*) {            \
    L::template unary<V>(d, a, [](V x) { return __VA_ARGS__; }); \
  }
#define NACRE_BINARY(op, V, ...)                                          \
  at(op) = [](W* d, const W* a, const W* b, const W*) {                   \
    L::template binary<V>(d, a, b, [](V x, V y) { return __VA_ARGS__; }); \
  }
  NACRE_BINARY(Op::add, F, x + y);
  NACRE_BINARY(Op::sub, F, x - y);
  NACRE_BINARY(Op::mul, F, x * y);
  NACRE_BINARY(Op::div, F, x / y);
  NACRE_BINARY(Op::min, F, xsimd::select(x < y, x, y));
  NACRE_BINARY(Op::max, F, xsimd::select(x > y, x, y));
  NACRE_UNARY(Op::sqrt, F, xsimd::sqrt(x));
  NACRE_UNARY(Op::neg, I, x ^ I(INT32_MIN));
  NACRE_UNARY(Op::abs, I, x & I(INT32_MAX));
  NACRE_UNARY(Op::floor, F, xsimd::floor(x));
  NACRE_UNARY(Op::ceil, F, xsimd::ceil(x));
  NACRE_UNARY(Op::trunc, F, xsimd::trunc(x));
  NACRE_UNARY(Op::round, F, xsimd::nearbyint(x));
  NACRE_BINARY(Op::eq, F, x == y);
  NACRE_BINARY(Op::ne, F, !(x == y));  // xsimd's != is ordered on AVX-512.
  NACRE_BINARY(Op::lt, F, x < y);
  NACRE_BINARY(Op::le, F, x <= y);
  NACRE_BINARY(Op::iadd, I, x + y);
  NACRE_BINARY(Op::isub, I, x - y);
  NACRE_BINARY(Op::imul, I, x * y);
  NACRE_BINARY(Op::iand, I, x & y);
  NACRE_BINARY(Op::ior, I, x | y);
  NACRE_BINARY(Op::ixor, I, x ^ y);
  NACRE_BINARY(Op::ieq, I, x == y);
  NACRE_BINARY(Op::ilt, I, x < y);
  NACRE_BINARY(Op::ult, I, (x ^ I(INT32_MIN)) < (y ^ I(INT32_MIN)));
  NACRE_BINARY(Op::band, I, x & y);
  NACRE_BINARY(Op::bor, I, x | y);
  NACRE_BINARY(Op::bxor, I, x ^ y);
  NACRE_UNARY(Op::bnot, I, ~x);
  NACRE_UNARY(Op::f_to_i, F, L::truncate_saturated(x));
  NACRE_UNARY(Op::i_to_f, I, xsimd::to_float(x));
  NACRE_UNARY(Op::u_to_f, I, L::from_unsigned(x));
  NACRE_UNARY(Op::bits, F, L::canonical_bits(x));
  NACRE_UNARY(Op::from_bits, I, L::flush_denormal(x));
  NACRE_UNARY(Op::b_to_i, I, x & I(1));
  NACRE_UNARY(Op::half_to_f, I, L::from_half(x));
#undef NACRE_UNARY
#undef NACRE_BINARY

  at(Op::fma) = [](W* d, const W* a, const W* b, const W* c) {
    for (std::size_t i = 0; i < block_lanes; i += L::width) {
      L::put(d + i, L::fused(L::template load<F>(a + i), L::template load<F>(b + i),
                             L::template load<F>(c + i)));
    }
  };
  at(Op::select) = [](W* d, const W* a, const W* b, const W* c) {
    for (std::size_t i = 0; i < block_lanes; i += L::width) {
      L::put(d + i, xsimd::select(L::template load<I>(a + i) != I(0), L::template load<I>(b + i),
                                  L::template load<I>(c + i)));
    }
  };
  ops.look_up = L::look_up;
  // Variable shifts and the high product: plain loops that the compiler vectorizes.
  at(Op::shl) = [](W* d, const W* a, const W* b, const W*) {
    for (int i = 0; i < block_lanes; ++i) d[i] = a[i] << (b[i] & 31u);
  };
  at(Op::lshr) = [](W* d, const W* a, const W* b, const W*) {
    for (int i = 0; i < block_lanes; ++i) d[i] = a[i] >> (b[i] & 31u);
  };
  at(Op::ashr) = [](W* d, const W* a, const W* b, const W*) {
    for (int i = 0; i < block_lanes; ++i) {
      d[i] = static_cast<W>(static_cast<std::int32_t>(a[i]) >> (b[i] & 31u));
    }
  };
  at(Op::umulhi) = [](W* d, const W* a, const W* b, const W*) {
    for (int i = 0; i < block_lanes; ++i) {
      d[i] = static_cast<W>((static_cast<std::uint64_t>(a[i]) * b[i]) >> 32);
    }
  };
  return ops;
}

}  // namespace
}  // namespace nacre
