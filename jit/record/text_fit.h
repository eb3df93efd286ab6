#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "jit/glsl/module.h"
#include "jit/record/text_ports.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// Says that a text does not fit the node that it implements. Always false.
bool misfit(const SourceLocation& where, Diagnostics& diagnostics, std::string message,
            std::string expected, std::string found);

/// A port of the node and the parameter of a text's function that stands for it.
struct FittedParameter {
  std::string_view function;
  const glsl::Function::Parameter& parameter;
  std::size_t number;  ///< From 1.
  const TextPorts::Port& port;
  bool is_input;
};

/// The port's value as the parameter's type, zero for an output; nothing, with a diagnostic,
/// where it does not fit.
std::optional<glsl::Value> fitted(const FittedParameter& fit, const SourceLocation& where,
                                  Diagnostics& diagnostics);

/// Hands on what was found about a text: with `path`, that of the implementation that it is of,
/// where none is given, and not what was said before, of another node of that kind.
void say_once(const std::string& path, const Diagnostics& found, Diagnostics& diagnostics);

}  // namespace nacre
