#pragma once

#include <vector>

#include "jit/glsl/syntax.h"
#include "runtime/stop.h"

namespace nacre::glsl {

/// Reads a whole text: structures, constants, functions. The subset: no
/// uniforms, no interface blocks, no `switch`, no `discard`. A function of one
/// name and parameter types that is defined again replaces the earlier one if
/// that came from another file. Throws Failure.
void parse(const std::vector<Token>& tokens, const Sources& sources, Diagnostics& diagnostics,
           Syntax& into, const Stop& stop = {});

/// Reads one expression, a stray ';' at its end allowed, in which the functions
/// of `context` may be called. Throws Failure.
ExpressionPtr parse_expression(const std::vector<Token>& tokens, const Sources& sources,
                               Diagnostics& diagnostics, const Syntax& context,
                               const Stop& stop = {});

}  // namespace nacre::glsl
