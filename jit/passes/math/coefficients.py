#!/usr/bin/env python3
"""usage: coefficients.py > coefficients.h

Computes the polynomials of this folder: minimax by Remez's exchange algorithm (E. W. Cheney,
Introduction to Approximation Theory, 1966, ch. 3) in 40 digits, each coefficient in turn rounded
to binary32 and the others fitted again, lowest power first, so that rounding is compensated
(N. Brisebarre, J.-M. Muller, A. Tisserand, Computing machine-efficient polynomial
approximations, ACM TOMS 32, 2006, sec. 1). Needs mpmath (Debian: python3-mpmath).
"""

import struct
from dataclasses import dataclass, field
from typing import Callable

from mpmath import mp, mpf

mp.dps = 40


@dataclass
class Fit:
    """sum_k c_k x^k, k < count, near f(x) on [low, high]; the error is weighed by `weight`."""

    name: str
    meaning: str
    f: Callable
    low: mpf
    high: mpf
    count: int
    weight: Callable
    fixed: dict = field(default_factory=dict)  # Coefficients given in advance, by power.
    expand: Callable = lambda c: c  # From what is fitted to what is used.


def to_float(x) -> mpf:
    """x rounded to binary32."""
    return mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def remez(f, low, high, powers, weight):
    """Coefficients of the given powers that make the largest weighted error least."""
    grid = [low + (high - low) * (1 - mp.cos(mp.pi * i / 500)) / 2 for i in range(501)]
    grid = [x if x != 0 else (high - low) * mpf("1e-6") for x in grid]
    samples = [(x, f(x), abs(weight(x))) for x in grid]
    # A weight that is zero within the interval makes some first guesses singular.
    attempts = [exchange(samples, powers, shift) for shift in (0.5, 0.3, 0.7, 0.15, 0.85)]
    return min(attempts, key=lambda attempt: attempt[1])[0]


def exchange(samples, powers, shift):
    """Remez's iteration from one first guess: coefficients and largest weighted error."""
    n = len(powers)
    points = [int(500 * (shift + i) / (n + 1)) for i in range(n + 1)]
    best = (None, mp.inf)
    for _ in range(25):
        rows = mp.matrix(n + 1, n + 1)
        right = mp.matrix(n + 1, 1)
        for i, point in enumerate(points):
            x, value, w = samples[point]
            for k, power in enumerate(powers):
                rows[i, k] = w * x**power
            rows[i, n] = (-1) ** i
            right[i] = w * value
        solution = mp.lu_solve(rows, right)
        c = [solution[k] for k in range(n)]
        errors = [w * (v - sum(a * x**p for a, p in zip(c, powers))) for x, v, w in samples]
        largest = max(abs(e) for e in errors)
        if largest < best[1]:
            best = (c, largest)
        chosen = alternating(errors, n + 1)
        if chosen is None or chosen == points:
            break
        points = chosen
    return best


def alternating(errors, count):
    """The largest error of each run of one sign; `count` of them in a row, the largest."""
    runs = []
    for i, e in enumerate(errors):
        if runs and (errors[runs[-1]] > 0) == (e > 0):
            if abs(e) > abs(errors[runs[-1]]):
                runs[-1] = i
        else:
            runs.append(i)
    while len(runs) > count:
        runs.pop(0 if abs(errors[runs[0]]) < abs(errors[runs[-1]]) else -1)
    return runs if len(runs) == count else None


def solve(fit: Fit):
    """Coefficients, each a binary32, and the largest weighted error of their polynomial."""
    found = dict(fit.fixed)
    rest = [k for k in range(fit.count) if k not in found]
    while rest:
        known = dict(found)
        target = lambda x: fit.f(x) - sum(c * x**k for k, c in known.items())
        c = remez(target, fit.low, fit.high, rest, fit.weight)
        found[rest[0]] = to_float(c[0])
        rest = rest[1:]
    grid = [fit.low + (fit.high - fit.low) * mpf(2 * i + 1) / 4000 for i in range(2000)]
    error = max(abs(fit.weight(x) * (fit.f(x) - sum(c * x**k for k, c in found.items())))
                for x in grid)
    return [found[k] for k in range(fit.count)], error


LN2 = mp.log(2)
LOG2E = 1 / LN2
QUARTER = (mp.pi / 4 * mpf("1.006")) ** 2
HALF = (mp.pi / 2 * mpf("1.001")) ** 2
TINY = mpf("1e-8")
THIRD = mpf(1) / 3 + mpf("1e-6")
EXP_LOW, EXP_HIGH = -LN2 / 2 * mpf("1.0001"), LN2 * mpf("1.00001")


def odd(g):
    """(g(r) / r - 1) / r^2 as a function of s = r^2, for g(r) = r + r^3 p(s)."""
    return lambda s: (g(mp.sqrt(s)) / mp.sqrt(s) - 1) / s


def odd_weight(g):
    """Makes the error of `odd` relative to g."""
    return lambda s: s * mp.sqrt(s) / g(mp.sqrt(s))


def log_fits(name, scale, word):
    """log of 1 + f over scale, f in [-1/3, 1/3]."""
    relative = lambda f: f / mp.log(1 + f)
    long = [Fit(f"{name}_{mode}", f"{word}(1 + f) = f L - f^2 L / 2 + f^3 p(f); relative",
                lambda f: (mp.log(1 + f) - f + f * f / 2) / f**3 / scale, -THIRD, THIRD, count,
                lambda f: f * f * relative(f) * scale)
            for mode, count in (("standard", 7), ("precise", 9))]
    return long + [Fit(f"{name}_fast", f"{word}(1 + f) = f p(f); relative",
                       lambda f: mp.log(1 + f) / f / scale, -THIRD, THIRD, 5,
                       lambda f: relative(f) * scale)]


def exp_fits(name, base, low, high):
    """base^r, r in [low, high]."""
    return [Fit(f"{name}_standard", f"{name}(r) = 1 + r p(r); relative",
                lambda r: (base**r - 1) / r, low, high, 6, lambda r: r * base**-r),
            Fit(f"{name}_precise", f"{name}(r) = 1 + r log(base) + r^2 p(r); relative",
                lambda r: (base**r - 1 - r * mp.log(base)) / r**2, low, high, 6,
                lambda r: r * r * base**-r)]


def pinned_exp2(name, count):
    """2^f on [0, 1], exact at both ends: 1 + f + f (f - 1) q(f)."""
    def expand(q):
        full = [mpf(1)] + [mpf(0)] * count
        for k, c in enumerate(q):
            full[k] -= c
            full[k + 1] += c
        return [to_float(c) for c in full]
    return Fit(name, "exp2(f) = 1 + f p(f), 1 and 2 at the ends; relative",
               lambda f: (2**f - 1 - f) / (f * (f - 1)), TINY, 1 - TINY, count,
               lambda f: f * (1 - f) * 2**-f, expand=expand)


def sine_below_one():
    """sin on [0, pi / 2] that does not pass 1: its value at pi / 2 is given."""
    end = (mp.pi / 2) ** 2
    start = 2 / mp.pi * (1 - mpf("2e-7"))
    def expand(q):
        return [to_float(c) for c in (start - end * q[0], q[0] - end * q[1], q[1])]
    return Fit("sin_fast", "sin(r) = r p(r^2), |r| to pi / 2, at most 1; absolute",
               lambda s: (mp.sin(mp.sqrt(s)) / mp.sqrt(s) - start) / (s - end), TINY, HALF, 2,
               lambda s: mp.sqrt(s) * (s - end), expand=expand)


FITS = [
    *exp_fits("exp", mp.e, EXP_LOW, EXP_HIGH),
    *exp_fits("exp2", mpf(2), EXP_LOW * LOG2E, EXP_HIGH * LOG2E),
    pinned_exp2("exp2_fast", 2),
    pinned_exp2("exp2_of_pow_fast", 3),
    *log_fits("log", 1, "log"),
    *log_fits("log2", LN2, "log2"),
    Fit("atanh_of_pow", "log2((1 + s) / (1 - s)) = 2 L (s + s^3 p(s^2)); relative",
        odd(mp.atanh), TINY, mpf("0.0295"), 4, odd_weight(mp.atanh)),
    Fit("sin_quarter", "sin(r) = r + r^3 p(r^2), |r| to pi / 4; relative",
        odd(mp.sin), TINY, QUARTER, 3, odd_weight(mp.sin)),
    Fit("cos_standard", "cos(r) = 1 - r^2 / 2 + r^4 p(r^2), |r| to pi / 4; absolute",
        lambda s: (mp.cos(mp.sqrt(s)) - 1 + s / 2) / s**2, TINY, QUARTER, 2, lambda s: s * s),
    Fit("cos_precise", "as cos_standard",
        lambda s: (mp.cos(mp.sqrt(s)) - 1 + s / 2) / s**2, TINY, QUARTER, 3, lambda s: s * s),
    sine_below_one(),
    Fit("cos_fast", "cos(r) = 1 + r^2 p(r^2), |r| to pi / 2; absolute",
        lambda s: (mp.cos(mp.sqrt(s)) - 1) / s, TINY, HALF, 3, lambda s: s),
    *[Fit(f"tan_{mode}", "tan(r) = r + r^3 p(r^2), |r| to pi / 4; relative",
          odd(mp.tan), TINY, QUARTER, count, odd_weight(mp.tan))
      for mode, count in (("fast", 3), ("standard", 6), ("precise", 7))],
    *[Fit(f"asin_{mode}", "asin(w) = w + w^3 p(w^2), |w| to 1/2; relative",
          odd(mp.asin), TINY, mpf("0.2501"), count, odd_weight(mp.asin))
      for mode, count in (("standard", 4), ("precise", 5))],
    Fit("acos_fast", "acos(a) = sqrt(1 - a) p(a), a in [0, 1]; absolute",
        lambda a: mp.acos(a) / mp.sqrt(1 - a), mpf(0), 1 - TINY, 4,
        lambda a: mp.sqrt(1 - a), {0: to_float(mp.pi / 2)}),
    *[Fit(f"atan_{mode}", "atan(t) = t + t^3 p(t^2), t in [0, 1]; relative",
          odd(mp.atan), TINY, mpf(1), count, odd_weight(mp.atan))
      for mode, count in (("fast", 4), ("standard", 7))],
    Fit("atan_precise", "atan(t) = t + t^3 p(t^2), |t| to tan(pi / 8); relative",
        odd(mp.atan), TINY, mpf("0.1717"), 5, odd_weight(mp.atan)),
]


def main():
    print("""#pragma once

#include <array>

namespace nacre::coefficients {

// Written by coefficients.py, which says how. Lowest power first; L is log2(e) for log2, 1 for
// log. After the meaning: the largest error of the polynomial in exact arithmetic.
""")
    for fit in FITS:
        c, error = solve(fit)
        print(f"/// {fit.meaning} {float(error):.1e}.")
        text = ", ".join(f"{float(x).hex()}f" for x in fit.expand(c))
        print(f"inline constexpr std::array {fit.name}{{{text}}};")
    print("\n}  // namespace nacre::coefficients")


if __name__ == "__main__":
    main()
