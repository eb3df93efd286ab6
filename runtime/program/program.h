#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/program/op.h"

namespace nacre {

/// A value is named by the index of the instruction that defines it, within
/// its function.
using ValueId = std::uint32_t;
inline constexpr ValueId no_value = ~ValueId{0};

/// One operation. `call` keeps its operands in the function's pool.
struct Instruction {
  Op op = Op::constant;
  Scalar type = Scalar::none;
  bool varying = false;    ///< Differs from lane to lane; see mark_varying().
  std::uint8_t count = 0;  ///< Operands in `operands`; 0 for call.
  std::uint32_t imm = 0;
  std::array<ValueId, 3> operands{no_value, no_value, no_value};
  /// What it was recorded for: an index into Program::origins. Says nothing of what it
  /// computes, so equal instructions may differ in it, and no digest or text has it.
  std::uint32_t origin = 0;

  bool operator==(const Instruction& other) const {
    return op == other.op && type == other.type && varying == other.varying &&
           count == other.count && imm == other.imm && operands == other.operands;
  }
};

/// Straight code with nested regions, in order of execution. Function 0 of a
/// Program is the entry; the others are outlined bodies with `argument` and
/// `give` in place of inputs and stores.
struct Function {
  std::string name;
  std::vector<Scalar> arguments;
  std::vector<Scalar> results;
  std::vector<Instruction> code;
  /// Operands of calls, and of texture_call: Instruction::operands[0] is the
  /// first of them in the pool, operands[1] how many.
  std::vector<ValueId> pool;

  std::span<const ValueId> operands(const Instruction& instruction) const;
};

/// Where an input channel comes from, by name: "P.x", "wi.y", "state.7".
struct Channel {
  std::string name;
  Scalar type = Scalar::f32;
  bool operator==(const Channel&) const = default;
};

/// A four-byte slot of the parameter block.
struct ParameterSlot {
  std::string name;  ///< "SR_gold/base_color.x", "frame", ...
  Scalar type = Scalar::f32;
  std::uint32_t value = 0;  ///< The bits it has in the document.
  bool operator==(const ParameterSlot&) const = default;
};

/// A constant table of floats, for `table`.
struct Table {
  std::string name;
  std::vector<float> values;
  bool operator==(const Table&) const = default;
};

/// A texture (or tile set) that the Program reads; the host binds it by key.
struct TextureSlot {
  std::string key;  ///< What the texture store knows it by.
  bool operator==(const TextureSlot&) const = default;
};

/// How exact the transcendental functions and the closure approximations are.
enum class Accuracy : std::uint8_t { precise, standard, fast };
std::string_view accuracy_name(Accuracy accuracy);

/// What a kernel computes for every point of a batch.
struct Program {
  std::string name;
  std::vector<Function> functions{1};
  std::vector<Channel> inputs;
  std::vector<Channel> outputs;
  std::vector<ParameterSlot> parameters;
  std::vector<Table> tables;
  std::vector<TextureSlot> textures;
  /// Nodes by path and lobes by name, for people who ask what costs what; 0: nobody's.
  std::vector<std::string> origins{""};

  Function& entry() { return functions.front(); }
  const Function& entry() const { return functions.front(); }
};

/// The canonical text of a Program: values numbered from 0 in order of
/// definition, one instruction a line, regions indented. Golden tests and
/// `nacre inspect` show it; runtime/program/parse.h reads it back.
std::string to_string(const Program& program);

/// Checks all that the engines rely on: operand types and counts, definition
/// before use and in scope, regions closed in order, indices in range, callees
/// before their callers. Returns the first fault, or an empty string.
std::string verify(const Program& program);

/// Sets Instruction::varying everywhere: inputs and what depends on them.
/// With `all`, every value is varying (a debug mode that must change nothing).
void mark_varying(Program& program, bool all = false);

}  // namespace nacre
