#pragma once

#include <array>

namespace nacre::coefficients {

// Written by coefficients.py, which says how. Lowest power first; L is log2(e) for log2, 1 for
// log. After the meaning: the largest error of the polynomial in exact arithmetic.

/// exp(r) = 1 + r p(r); relative 3.8e-08.
inline constexpr std::array exp_standard{0x1.fffffc0000000p-1f, 0x1.00004c0000000p-1f,
                                         0x1.5558180000000p-3f, 0x1.54f3ec0000000p-5f,
                                         0x1.109c580000000p-7f, 0x1.ab6d3c0000000p-10f};
/// exp(r) = 1 + r log(base) + r^2 p(r); relative 1.6e-09.
inline constexpr std::array exp_precise{0x1.fffffc0000000p-2f,  0x1.5555820000000p-3f,
                                        0x1.5558bc0000000p-5f,  0x1.10d9520000000p-7f,
                                        0x1.6a7c720000000p-10f, 0x1.ea19be0000000p-13f};
/// exp2(r) = 1 + r p(r); relative 4.1e-08.
inline constexpr std::array exp2_standard{0x1.62e42e0000000p-1f,  0x1.ebfc820000000p-3f,
                                          0x1.c6b33c0000000p-5f,  0x1.3acd260000000p-7f,
                                          0x1.5d70400000000p-10f, 0x1.78e6800000000p-13f};
/// exp2(r) = 1 + r log(base) + r^2 p(r); relative 1.7e-09.
inline constexpr std::array exp2_precise{0x1.ebfbdc0000000p-3f,  0x1.c6b0ca0000000p-5f,
                                         0x1.3b2df80000000p-7f,  0x1.5d3f640000000p-10f,
                                         0x1.4187d80000000p-13f, 0x1.2e307e0000000p-16f};
/// exp2(f) = 1 + f p(f), 1 and 2 at the ends; relative 1.0e-04.
inline constexpr std::array exp2_fast{0x1.640eac0000000p-1f, 0x1.cf7a500000000p-3f,
                                      0x1.4096080000000p-4f};
/// exp2(f) = 1 + f p(f), 1 and 2 at the ends; relative 3.3e-06.
inline constexpr std::array exp2_of_pow_fast{0x1.62d51c0000000p-1f, 0x1.ee58880000000p-3f,
                                             0x1.aa3fb20000000p-5f, 0x1.bc32060000000p-7f};
/// log(1 + f) = f L - f^2 L / 2 + f^3 p(f); relative 3.7e-08.
inline constexpr std::array log_standard{
    0x1.5555280000000p-2f, -0x1.000b1e0000000p-2f, 0x1.99c3380000000p-3f, -0x1.5159f00000000p-3f,
    0x1.1f943e0000000p-3f, -0x1.35b6b80000000p-3f, 0x1.1b13420000000p-3f};
/// log(1 + f) = f L - f^2 L / 2 + f^3 p(f); relative 1.2e-09.
inline constexpr std::array log_precise{
    0x1.5555560000000p-2f,  -0x1.ffff020000000p-3f, 0x1.99985e0000000p-3f,
    -0x1.559bb00000000p-3f, 0x1.24d7b20000000p-3f,  -0x1.f336fc0000000p-4f,
    0x1.bb59040000000p-4f,  -0x1.07d3880000000p-3f, 0x1.dfbd840000000p-4f};
/// log(1 + f) = f p(f); relative 4.9e-05.
inline constexpr std::array log_fast{0x1.0000640000000p+0f, -0x1.ff41980000000p-2f,
                                     0x1.54416c0000000p-2f, -0x1.19fbea0000000p-2f,
                                     0x1.ce223c0000000p-3f};
/// log2(1 + f) = f L - f^2 L / 2 + f^3 p(f); relative 3.8e-08.
inline constexpr std::array log2_standard{
    0x1.ec705c0000000p-2f, -0x1.7164820000000p-2f, 0x1.2794e80000000p-2f, -0x1.e6b1700000000p-3f,
    0x1.9edebe0000000p-3f, -0x1.bed7a60000000p-3f, 0x1.98843a0000000p-3f};
/// log2(1 + f) = f L - f^2 L / 2 + f^3 p(f); relative 1.0e-09.
inline constexpr std::array log2_precise{
    0x1.ec70a00000000p-2f,  -0x1.7153c80000000p-2f, 0x1.27754c0000000p-2f,
    -0x1.ecd2780000000p-3f, 0x1.a6a1b60000000p-3f,  -0x1.68548c0000000p-3f,
    0x1.3df46a0000000p-3f,  -0x1.7b957e0000000p-3f, 0x1.61b8cc0000000p-3f};
/// log2(1 + f) = f p(f); relative 4.9e-05.
inline constexpr std::array log2_fast{0x1.7155080000000p+0f, -0x1.70cb2e0000000p-1f,
                                      0x1.eae02e0000000p-2f, -0x1.96cec00000000p-2f,
                                      0x1.4d78660000000p-2f};
/// log2((1 + s) / (1 - s)) = 2 L (s + s^3 p(s^2)); relative 2.5e-11.
inline constexpr std::array atanh_of_pow{0x1.5555540000000p-2f, 0x1.999c260000000p-3f,
                                         0x1.23d3ee0000000p-3f, 0x1.f135cc0000000p-4f};
/// sin(r) = r + r^3 p(r^2), |r| to pi / 4; relative 4.2e-09.
inline constexpr std::array sin_quarter{-0x1.5555440000000p-3f, 0x1.1106c60000000p-7f,
                                        -0x1.991c280000000p-13f};
/// cos(r) = 1 - r^2 / 2 + r^4 p(r^2), |r| to pi / 4; absolute 7.0e-08.
inline constexpr std::array cos_standard{0x1.5549c40000000p-5f, -0x1.65d1520000000p-10f};
/// as cos_standard 1.1e-10.
inline constexpr std::array cos_precise{0x1.55554a0000000p-5f, -0x1.6c0c1a0000000p-10f,
                                        0x1.99e0ee0000000p-16f};
/// sin(r) = r p(r^2), |r| to pi / 2, at most 1; absolute 8.1e-05.
inline constexpr std::array sin_fast{0x1.ffd1cc0000000p-1f, -0x1.5315d20000000p-3f,
                                     0x1.e9c3020000000p-8f};
/// cos(r) = 1 + r^2 p(r^2), |r| to pi / 2; absolute 7.9e-06.
inline constexpr std::array cos_fast{-0x1.ffef060000000p-2f, 0x1.5405480000000p-5f,
                                     -0x1.4e5f300000000p-10f};
/// tan(r) = r + r^3 p(r^2), |r| to pi / 4; relative 5.3e-05.
inline constexpr std::array tan_fast{0x1.5713120000000p-2f, 0x1.e1a61c0000000p-4f,
                                     0x1.7c30da0000000p-4f};
/// tan(r) = r + r^3 p(r^2), |r| to pi / 4; relative 2.0e-08.
inline constexpr std::array tan_standard{0x1.5554d40000000p-2f, 0x1.112ff80000000p-3f,
                                         0x1.b540200000000p-5f, 0x1.9265520000000p-6f,
                                         0x1.7d3a5c0000000p-9f, 0x1.37b01c0000000p-7f};
/// tan(r) = r + r^3 p(r^2), |r| to pi / 4; relative 1.5e-09.
inline constexpr std::array tan_precise{
    0x1.5555620000000p-2f, 0x1.110d1a0000000p-3f,   0x1.baf0ba0000000p-5f, 0x1.5bd4d40000000p-6f,
    0x1.6794700000000p-7f, -0x1.7083320000000p-14f, 0x1.24a0d80000000p-8f};
/// asin(w) = w + w^3 p(w^2), |w| to 1/2; relative 8.9e-08.
inline constexpr std::array asin_standard{0x1.554fa00000000p-3f, 0x1.34dcd80000000p-4f,
                                          0x1.47ed240000000p-5f, 0x1.994fb80000000p-5f};
/// asin(w) = w + w^3 p(w^2), |w| to 1/2; relative 4.9e-09.
inline constexpr std::array asin_precise{0x1.5555c80000000p-3f, 0x1.3301fc0000000p-4f,
                                         0x1.747d060000000p-5f, 0x1.8c2d840000000p-6f,
                                         0x1.596d600000000p-5f};
/// acos(a) = sqrt(1 - a) p(a), a in [0, 1]; absolute 4.5e-05.
inline constexpr std::array acos_fast{0x1.921fb60000000p+0f, -0x1.b4d79a0000000p-3f,
                                      0x1.3f6ad40000000p-4f, -0x1.6296900000000p-6f};
/// atan(t) = t + t^3 p(t^2), t in [0, 1]; relative 3.5e-05.
inline constexpr std::array atan_fast{-0x1.541a140000000p-2f, 0x1.7e98760000000p-3f,
                                      -0x1.816cf20000000p-4f, 0x1.96fbe80000000p-6f};
/// atan(t) = t + t^3 p(t^2), t in [0, 1]; relative 1.1e-07.
inline constexpr std::array atan_standard{
    -0x1.5552de0000000p-2f, 0x1.99127c0000000p-3f, -0x1.1f916a0000000p-3f, 0x1.9851340000000p-4f,
    -0x1.ed35120000000p-5f, 0x1.9546500000000p-6f, -0x1.3c15800000000p-8f};
/// atan(t) = t + t^3 p(t^2), |t| to tan(pi / 8); relative 7.0e-10.
inline constexpr std::array atan_precise{-0x1.55554a0000000p-2f, 0x1.9991e00000000p-3f,
                                         -0x1.23b9660000000p-3f, 0x1.b21ff80000000p-4f,
                                         -0x1.f2cbf80000000p-5f};

}  // namespace nacre::coefficients
