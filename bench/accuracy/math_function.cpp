#include "bench/accuracy/math_function.h"

#include <array>
#include <cmath>
#include <vector>

#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"

namespace nacre {

namespace {

constexpr float near_angle = 1e5f;

constexpr std::array functions{
    // keep-sorted start
    MathFunction{"acos", Op::acos, 1, [](double x, double) { return std::acos(x); }},
    MathFunction{"asin", Op::asin, 1, [](double x, double) { return std::asin(x); }},
    MathFunction{"atan2", Op::atan2, 2, [](double x, double y) { return std::atan2(x, y); }},
    MathFunction{"cos", Op::cos, 1, [](double x, double) { return std::cos(x); }, near_angle},
    MathFunction{"exp", Op::exp, 1, [](double x, double) { return std::exp(x); }},
    MathFunction{"exp2", Op::exp2, 1, [](double x, double) { return std::exp2(x); }},
    MathFunction{"log", Op::log, 1, [](double x, double) { return std::log(x); }},
    MathFunction{"log2", Op::log2, 1, [](double x, double) { return std::log2(x); }},
    MathFunction{"pow", Op::pow, 2, [](double x, double y) { return std::pow(x, y); }},
    MathFunction{"sin", Op::sin, 1, [](double x, double) { return std::sin(x); }, near_angle},
    MathFunction{"tan", Op::tan, 1, [](double x, double) { return std::tan(x); }, near_angle},
    // keep-sorted end
};

bool is_free(Op op) {
  switch (op) {
    case Op::constant:
    case Op::input:
    case Op::parameter:
    case Op::argument:
    case Op::result:
    case Op::give:
    case Op::store:
    case Op::end_if: return true;
    default: return false;
  }
}

OperationCount count_function(const Program& program, const Function& function) {
  OperationCount count;
  int depth = 0;
  for (const Instruction& instruction : function.code) {
    if (closes_region(instruction.op)) --depth;
    int& place = depth > 0 ? count.rare : count.always;
    if (!is_free(instruction.op)) ++place;
    if (instruction.op == Op::call) {
      const OperationCount inner = count_function(program, program.functions[instruction.imm]);
      place += inner.always;
      count.rare += inner.rare;
    }
    if (opens_region(instruction.op)) ++depth;
  }
  return count;
}

}  // namespace

std::span<const MathFunction> math_functions() { return functions; }

Program program_of(const MathFunction& function) {
  Recorder recorder;
  std::vector<Ref> inputs{recorder.input("x", Scalar::f32)};
  if (function.arguments == 2) inputs.push_back(recorder.input("y", Scalar::f32));
  const std::vector<SliceOutput> outputs{{"out", recorder.emit(function.op, inputs)}};
  return slice(recorder.program(), function.name, outputs);
}

OperationCount count_operations(const Program& program) {
  return count_function(program, program.entry());
}

}  // namespace nacre
