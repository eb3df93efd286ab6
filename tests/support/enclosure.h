#pragma once

#include <cstdint>
#include <vector>

#include "runtime/program/program.h"
#include "tests/support/interval.h"

namespace nacre::testing {

/// The outputs of a Program at one point, by output channel; of an integer or a truth
/// value the bits as a number. By interval arithmetic
/// (Moore, Kearfott and Cloud, "Introduction to Interval Analysis", 2009) on the Program
/// that the reference engine runs. Every operation widens by half an ulp of a float, a
/// transcendental function by the 4 ulp that `standard` promises; contraction to fma,
/// which only leaves roundings out, stays inside. Where a comparison can fall either way
/// both results count, and a loop that may end now or later leaves every number open.
std::vector<Enclosure> enclose(const Program& program, const std::vector<std::uint32_t>& inputs,
                               const std::vector<std::uint32_t>& parameters, FloatRange range = {});

}  // namespace nacre::testing
