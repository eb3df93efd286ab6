#include "jit/glsl/recording.h"

#include <fmt/format.h>

#include <algorithm>

namespace nacre::glsl {

namespace {

/// Functions above this cost are recorded once and called.
constexpr int large_function = 400;

Scalar scalar_of(Base base) {
  if (base == Base::number) return Scalar::f32;
  return base == Base::boolean ? Scalar::b1 : Scalar::i32;
}

}  // namespace

Recording::Recording(const RecordContext& context) : context_(context) {
  activations_.emplace_back();  // Of an expression that stands in no function.
}

void Recording::bind(std::string_view name, Value value) { push(name, std::move(value), true); }

Recording::Parts Recording::snapshot(Place place) {
  if (!variables_.empty()) {
    count_steps((variables_.back().parts_before + variables_.size()) / 16, place);
  }
  Parts result;
  result.reserve(variables_.size() - base_);
  for (Slot i = base_; i < variables_.size(); ++i) result.push_back(variables_[i].value.parts);
  return result;
}

void Recording::restore(const Parts& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) variables_[base_ + i].value.parts = parts[i];
}

Recording::Slot Recording::push(std::string_view name, Value value, bool constant) {
  std::size_t before = 0;
  if (!variables_.empty()) {
    before = variables_.back().parts_before + variables_.back().value.parts.size();
  }
  variables_.push_back({name, std::move(value), constant, before});
  return variables_.size() - 1;
}

Recording::Variable* Recording::find(std::string_view name) {
  for (Slot i = variables_.size(); i > activation().first; --i) {
    if (variables_[i - 1].name == name) return &variables_[i - 1];
  }
  return nullptr;
}

void Recording::error(Place place, std::string code, std::string message, std::string expected,
                      std::string found) const {
  fail(context_.sources, context_.diagnostics, place, std::move(code), std::move(message),
       std::move(expected), std::move(found));
}

void Recording::count_steps(std::size_t steps, Place place) {
  const RecordLimits& limits = context_.limits;
  steps_ += steps;
  if (steps_ > limits.steps) {
    error(place, "too-many-operations", "the text takes too long to record",
          fmt::format("at most {} steps", limits.steps));
  }
  if (context_.recorder.size() > limits.operations) {
    error(place, "too-many-operations", "the text records too many operations",
          fmt::format("at most {}", limits.operations));
  }
  if (!variables_.empty() && variables_.back().parts_before > limits.live_parts) {
    error(place, "glsl-too-large", "the variables in use are too large together",
          fmt::format("at most {} numbers", limits.live_parts));
  }
  if (steps_ < next_look_) return;
  next_look_ = steps_ + 1024;
  check_stop(limits.stop, context_.sources, context_.diagnostics, place);
}

void Recording::enter(Place place, int bytes) {
  if (stack_ + bytes > context_.limits.stack_bytes) {
    error(place, "glsl-too-deep", "the text is nested too deeply, with all calls up to here");
  }
  stack_ += bytes;
}

CallResult Recording::call(const Function& function, std::vector<Value> arguments, Place place) {
  if (function.body == nullptr) {
    error(place, "glsl-undefined",
          fmt::format("function '{}' is declared but not defined", function.name));
  }
  if (std::find(calling_.begin(), calling_.end(), &function) != calling_.end()) {
    error(place, "glsl-recursion", fmt::format("function '{}' calls itself", function.name));
  }
  if (static_cast<int>(calling_.size()) >= context_.limits.call_depth) {
    error(place, "glsl-too-deep", "calls are nested too deeply",
          fmt::format("at most {}", context_.limits.call_depth));
  }
  std::size_t parts = static_cast<std::size_t>(part_count(function.type));
  for (const Function::Parameter& parameter : function.parameters) {
    parts += static_cast<std::size_t>(part_count(parameter.type));
  }
  if (parts > context_.limits.live_parts) {
    error(place, "glsl-too-large",
          fmt::format("what function '{}' takes and returns is too large", function.name));
  }
  const Level level(*this, place, 1100);
  calling_.push_back(&function);
  const bool has_texts = std::any_of(arguments.begin(), arguments.end(), [](const Value& value) {
    return value.type.base == Base::sampler;
  });
  const bool outlines = function.cost >= large_function && !function.stays_inline && !has_texts;
  CallResult result =
      outlines ? call_outlined(function, arguments) : call_inline(function, std::move(arguments));
  calling_.pop_back();
  return result;
}

CallResult Recording::call_inline(const Function& function, std::vector<Value> arguments) {
  const Slot first = variables_.size();
  Activation made;
  made.function = &function;
  made.first = first;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Function::Parameter& parameter = function.parameters[i];
    push(parameter.name, parameter.in ? std::move(arguments[i]) : zero(parameter.type));
  }
  made.returned = push("", make(Bool(false)));
  push("", zero(function.type));
  activations_.push_back(made);
  execute(*function.body);
  CallResult result;
  result.value = variables_[made.returned + 1].value;
  for (std::size_t i = 0; i < function.parameters.size(); ++i) {
    const bool out = function.parameters[i].out;
    result.outputs.push_back(out ? variables_[first + i].value : Value{});
  }
  activations_.pop_back();
  variables_.resize(first);
  return result;
}

CallResult Recording::call_outlined(const Function& function, const std::vector<Value>& arguments) {
  Recorder& recorder = context_.recorder;
  // Literal arguments are part of the function, the others are passed.
  std::string key = fmt::format("glsl {} {}", static_cast<const void*>(&context_.syntax),
                                static_cast<const void*>(&function));
  std::vector<Ref> passed;
  std::vector<Scalar> types;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!function.parameters[i].in) continue;
    for (std::size_t k = 0; k < arguments[i].parts.size(); ++k) {
      const Ref part = arguments[i].parts[k];
      key += part.is_constant() ? fmt::format(" {}", part.id) : " ?";
      if (part.is_constant()) continue;
      passed.push_back(part);
      types.push_back(scalar_of(part_base(arguments[i].type, static_cast<int>(k))));
    }
  }
  if (passed.empty()) return call_inline(function, arguments);
  // A loop must know which lanes it is for: the others may never end it.
  const bool is_masked = function.has_loop && !mask_.is_constant();
  if (is_masked) {
    key += " masked";
    passed.push_back(mask_.ref());
    types.push_back(Scalar::b1);
  }

  // What comes back: the value, then the outputs in order.
  CallResult shape{zero(function.type), {}};
  for (const Function::Parameter& parameter : function.parameters) {
    shape.outputs.push_back(parameter.out ? zero(parameter.type) : Value{});
  }
  std::uint32_t number = recorder.find_function(key);
  if (number == 0) {
    recorder.begin_function(key, std::string(function.name), types);
    std::vector<Value> formal = arguments;
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < formal.size(); ++i) {
      if (!function.parameters[i].in) continue;
      for (Ref& part : formal[i].parts) {
        if (!part.is_constant()) part = recorder.argument(next++);
      }
    }
    const Slot base = base_;
    const Bool mask = mask_;
    base_ = variables_.size();
    mask_ = is_masked ? Bool(recorder.argument(next)) : Bool(true);
    const CallResult inside = call_inline(function, std::move(formal));
    base_ = base;
    mask_ = mask;
    std::vector<Ref> results = inside.value.parts;
    for (const Value& output : inside.outputs) {
      results.insert(results.end(), output.parts.begin(), output.parts.end());
    }
    number = recorder.end_function(results);
  }
  const std::vector<Ref> results = recorder.call(number, passed);
  std::size_t at = 0;
  for (Ref& part : shape.value.parts) part = results[at++];
  for (Value& output : shape.outputs) {
    for (Ref& part : output.parts) part = results[at++];
  }
  return shape;
}

CallResult record_call(const RecordContext& context, const Function& function,
                       std::vector<Value> arguments) {
  Recording recording(context);
  if (function.has_loop) recording.restrict_to(Bool(context.recorder.needed_lanes()));
  return recording.call(function, std::move(arguments), function.place);
}

Value record_expression(const RecordContext& context, const Expression& expression,
                        const std::vector<std::pair<std::string_view, Value>>& names) {
  Recording recording(context);
  if (expression.has_loop) recording.restrict_to(Bool(context.recorder.needed_lanes()));
  for (const auto& [name, value] : names) recording.bind(name, value);
  return recording.evaluate(expression);
}

}  // namespace nacre::glsl
