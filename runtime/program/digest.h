#pragma once

#include <span>
#include <string>

#include "runtime/digest.h"
#include "runtime/program/program.h"

namespace nacre {

/// Of everything that decides what a kernel computes; names of the program and of
/// parameters, and parameter values, do not count.
Digest digest(const Program& program);

/// The same, and which values are varying: of everything that decides its code.
Digest code_digest(const Program& program);

/// Of the bits of numbers.
Digest digest(std::span<const float> values);

/// The kinds of arrays that a kernel is bound to, in order: "fi/f/fb/2" for the inputs, the
/// outputs and the parameters, a letter each, and the number of textures.
std::string interface_text(const Program& program);

}  // namespace nacre
