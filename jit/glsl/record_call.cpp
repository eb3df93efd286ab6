// Calls of functions that the text has, of GLSL's own, and of textures.
#include <fmt/format.h>

#include "jit/glsl/builtins.h"
#include "jit/glsl/recording.h"

namespace nacre::glsl {

Value Recording::call_named(const Expression& expression) {
  const Level level(*this, expression.place, 550);
  std::vector<Value> arguments;
  arguments.reserve(expression.operands.size());
  for (const ExpressionPtr& operand : expression.operands) arguments.push_back(evaluate(*operand));
  const Function* function = select_overload(expression, arguments);
  if (function == nullptr) {
    if (expression.text.starts_with("texture")) return call_texture(expression, arguments);
    const BuiltinResult result = call_builtin(expression.text, arguments);
    if (result.value) return *result.value;
    error(expression.place, "glsl-call",
          fmt::format("there is no function {}{}", expression.text, type_list(arguments)));
  }
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (function->parameters[i].in)
      arguments[i] = convert(arguments[i], function->parameters[i].type);
  }
  const CallResult result = call(*function, std::move(arguments), expression.place);
  for (std::size_t i = 0; i < function->parameters.size(); ++i) {
    const Function::Parameter& parameter = function->parameters[i];
    if (!parameter.out) continue;
    const Target to = target(*expression.operands[i]);
    write(to, expect(result.outputs[i], to.type, expression.operands[i]->place));
  }
  return result.value;
}

/// The overload with these types, or the only one that they convert to.
const Function* Recording::select_overload(const Expression& expression,
                                           const std::vector<Value>& arguments) {
  const auto found = context_.syntax.by_name.find(expression.text);
  if (found == context_.syntax.by_name.end()) return nullptr;
  const Function* best = nullptr;
  int best_conversions = 0;
  bool ambiguous = false;
  for (const Function* candidate : found->second) {
    if (candidate->parameters.size() != arguments.size()) continue;
    int conversions = 0;
    bool fits = true;
    for (std::size_t i = 0; i < arguments.size() && fits; ++i) {
      const Function::Parameter& parameter = candidate->parameters[i];
      fits = (!parameter.in || converts(arguments[i].type, parameter.type)) &&
             (!parameter.out || converts(parameter.type, arguments[i].type));
      if (arguments[i].type != parameter.type) ++conversions;
    }
    if (!fits) continue;
    ambiguous = best != nullptr && conversions == best_conversions;
    if (best == nullptr || conversions < best_conversions) {
      best = candidate;
      best_conversions = conversions;
    }
  }
  if (ambiguous) {
    error(expression.place, "glsl-call",
          fmt::format("several functions fit {}{}", expression.text, type_list(arguments)));
  }
  if (best == nullptr && !is_builtin(expression.text)) {
    error(expression.place, "glsl-call",
          fmt::format("no function '{}' takes {}", expression.text, type_list(arguments)));
  }
  return best;
}

Value Recording::call_texture(const Expression& expression, const std::vector<Value>& arguments) {
  const bool with_gradient = expression.text == "textureGrad";
  const std::size_t count = with_gradient ? 4 : 2;
  bool fits = (expression.text == "texture" || with_gradient) && arguments.size() == count &&
              arguments[0].type.base == Base::sampler && !arguments[0].type.is_array();
  for (std::size_t i = 1; i < count && fits; ++i) {
    fits = arguments[i].type == float_type.with_rows(arguments[0].type.rows);
  }
  if (!fits) {
    error(expression.place, "glsl-call",
          fmt::format("there is no function {}{}", expression.text, type_list(arguments)),
          "texture(sampler2D, vec2), textureGrad(sampler2D, vec2, vec2, vec2), or of other axes");
  }
  std::optional<Value> result;
  if (context_.texture) {
    result = context_.texture(arguments[0], arguments[1], with_gradient ? &arguments[2] : nullptr,
                              with_gradient ? &arguments[3] : nullptr);
  }
  if (!result && arguments[0].is_uniform) {
    error(expression.place, "glsl-texture",
          fmt::format("nothing is bound to the sampler '{}'", arguments[0].text));
  }
  if (!result) error(expression.place, "glsl-texture", "images cannot be read here");
  return *result;
}

}  // namespace nacre::glsl
