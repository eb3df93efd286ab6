#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jit/glsl/syntax.h"
#include "jit/glsl/value.h"
#include "runtime/program/recorder.h"
#include "runtime/stop.h"

namespace nacre::glsl {

struct RecordLimits {
  /// Rounds after which a loop must have ended by itself: else the run of the kernel ends,
  /// RunStatus::too_many_steps.
  int loop_iterations = 1024;
  std::size_t operations = 2'000'000;
  /// Expressions walked, what folds away included, and variables copied at branches.
  std::size_t steps = 4'000'000;
  int call_depth = 64;
  /// What statements, operands and calls within one another may take of the stack together,
  /// each counted with what it takes in optimized code: the same texts pass in every build.
  int stack_bytes = 192 * 1024;
  std::size_t live_parts = std::size_t{1} << 20;  ///< Scalars of all variables in scope.
  Stop stop = {};
};

/// Reads what a sampler stands for: four floats. The place has as many components
/// as the sampler axes; its derivatives are null where the text leaves them to the
/// footprint. Nothing: cannot be read.
using TextureLookup = std::function<std::optional<Value>(const Value& sampler, const Value& place,
                                                         const Value* ddx, const Value* ddy)>;

struct RecordContext {
  const Sources& sources;
  const Syntax& syntax;
  Recorder& recorder;
  Diagnostics& diagnostics;
  RecordLimits limits = {};
  TextureLookup texture = {};  ///< Null: reading images is an error.
};

struct CallResult {
  Value value;
  std::vector<Value> outputs;  ///< By parameter; empty values for those that are not out.
};

/// Records a call of a function, one argument a parameter (those that are only
/// out are ignored). What branches do not change is shared; each branch is a region,
/// which flatten_regions() keeps where that pays; loops of few
/// literal iterations are unrolled; large functions are outlined. Throws Failure.
CallResult record_call(const RecordContext& context, const Function& function,
                       std::vector<Value> arguments);

/// Records an expression in which `names` stand for values. Throws Failure.
Value record_expression(const RecordContext& context, const Expression& expression,
                        const std::vector<std::pair<std::string_view, Value>>& names);

}  // namespace nacre::glsl
