#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "jit/glsl/prelude.h"
#include "jit/glsl/record.h"

namespace nacre::glsl {

/// A text of the GLSL subset that was read once and can be recorded often:
/// functions with in and out parameters, locals, vectors, matrices, swizzles,
/// structures, arrays, `if`, loops, macros and includes. It is data: it can
/// only compute values from its arguments, in bounded time. Never changed once
/// made; may be shared between threads.
///
/// Before the text stand the names that MaterialX's GLSL takes for granted
/// (M_PI, mx_sin, mx_matrix_mul, ...): a Prelude, which a text shares with others.
class Module {
 public:
  /// The name of the text is what diagnostics call it, and where its includes
  /// are looked for. Null, with a diagnostic, for what is not well-formed.
  static std::shared_ptr<const Module> read(const std::shared_ptr<const Prelude>& prelude,
                                            Sources::File text, const PreprocessOptions& options,
                                            Diagnostics& diagnostics);
  /// A lone expression, "a * sin(b)".
  static std::shared_ptr<const Module> read_expression(
      const std::shared_ptr<const Prelude>& prelude, Sources::File text, Diagnostics& diagnostics,
      const Stop& stop = {});

  /// The last function defined under that name, or null.
  const Function* function(std::string_view name) const;

  /// Where one of its functions is defined.
  SourceLocation where(const Function& function) const;

  /// Both as in record.h, but a fault is a diagnostic and gives nothing.
  std::optional<CallResult> record(const Function& function, std::vector<Value> arguments,
                                   Recorder& recorder, Diagnostics& diagnostics,
                                   const TextureLookup& texture = {},
                                   const RecordLimits& limits = {}) const;
  std::optional<Value> record_expression(
      const std::vector<std::pair<std::string_view, Value>>& names, Recorder& recorder,
      Diagnostics& diagnostics, const RecordLimits& limits = {}) const;

 private:
  explicit Module(const std::shared_ptr<const Prelude>& prelude);

  Sources sources_;
  Syntax syntax_;
  ExpressionPtr expression_;
};

}  // namespace nacre::glsl
