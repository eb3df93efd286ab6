#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/program/op.h"

namespace nacre {

/// A value is named by the index of the instruction that defines it, within
/// its function.
using ValueId = std::uint32_t;
/// In place of an operand that there is not.
inline constexpr ValueId no_value = ~ValueId{0};

/// One operation. `call` keeps its operands in the function's pool.
struct Instruction {
  Op op = Op::constant;        ///< What it computes.
  Scalar type = Scalar::none;  ///< Of its value.
  bool varying = false;        ///< Differs from lane to lane; see mark_varying().
  std::uint8_t count = 0;      ///< Operands in `operands`; 0 for call.
  std::uint32_t imm = 0;       ///< As the operation says: an index, bits or a number.
  /// Earlier values of its function; `count` of them.
  std::array<ValueId, 3> operands{no_value, no_value, no_value};
  /// What it was recorded for: an index into Program::origins. Says nothing of what it
  /// computes, so equal instructions may differ in it, and no digest or text has it.
  std::uint32_t origin = 0;

  /// All but `origin`.
  bool operator==(const Instruction& other) const {
    return op == other.op && type == other.type && varying == other.varying &&
           count == other.count && imm == other.imm && operands == other.operands;
  }
};

/// Without operands.
constexpr Instruction bare_instruction(Op op, Scalar type, std::uint32_t imm) {
  return {.op = op, .type = type, .imm = imm, .operands = {no_value, no_value, no_value}};
}

/// Straight code with nested regions, in order of execution. Function 0 of a
/// Program is the entry; the others are outlined bodies with `argument` and
/// `give` in place of inputs and stores.
struct Function {
  std::string name;               ///< Of an outlined body, as outline() was given it.
  std::vector<Scalar> arguments;  ///< None of the entry.
  std::vector<Scalar> results;    ///< None of the entry.
  std::vector<Instruction> code;  ///< A ValueId is an index in it.
  /// Operands of calls, and of texture_call: Instruction::operands[0] is the
  /// first of them in the pool, operands[1] how many.
  std::vector<ValueId> pool;

  /// Those of an instruction of this function, wherever they are.
  std::span<const ValueId> operands(const Instruction& instruction) const;
};

/// An input or output of a kernel, one array of a batch, by name: "P.x", "wi.y", "state.7".
struct Channel {
  std::string name;           ///< Unique among the inputs, or the outputs.
  Scalar type = Scalar::f32;  ///< Of its elements, four bytes each.
  bool operator==(const Channel&) const = default;
};

/// A four-byte slot of the parameter block.
struct ParameterSlot {
  std::string name;           ///< "SR_gold/base_color.x", "frame", ...
  Scalar type = Scalar::f32;  ///< Of a b1 every slot but 0 is true.
  std::uint32_t value = 0;    ///< The bits it has in the document.
  bool operator==(const ParameterSlot&) const = default;
};

/// A constant table of floats, for `table`.
struct Table {
  std::string name;           ///< Unique in a Program.
  std::vector<float> values;  ///< At least one.
  bool operator==(const Table&) const = default;
};

/// A texture (or tile set) that the Program reads; the host binds it by key.
struct TextureSlot {
  std::string key;  ///< What the texture store knows it by.
  bool operator==(const TextureSlot&) const = default;
};

struct Program;

/// Functions of one number and of parameters, as polynomials in cells of that number's range: equal
/// ones of the root of what it is above `low`.
/// Their coefficients are worked out when the parameters are known, before the kernel runs, and
/// Op::fitted reads them: rows of 16 numbers, one a cell. The first rows have a number for each fit
/// of a Program: 1 where all its functions are as close as they should be, else 0.
struct Fit {
  static constexpr std::uint32_t cells = 16;
  static constexpr std::uint32_t coefficients = 4;
  static constexpr std::uint32_t first_rows = 4;
  static constexpr std::uint32_t most = first_rows * cells;  ///< Fits of a Program.

  /// Has one input, the number, and an output each function.
  std::shared_ptr<const Program> maker;
  std::vector<std::uint32_t> slots{};  ///< Of each parameter of it, that of the Program.
  /// The first of its rows: four a function, the coefficients of degree 0 to 3 in each cell.
  std::uint32_t row = 0;
  float low = 0, high = 1;  ///< The range of the number.
  float error = 0;          ///< What of a function is close; see fit_cells().
};

/// How exact the transcendental functions and the closure approximations are.
enum class Accuracy : std::uint8_t { precise, standard, fast };
/// "precise", "standard" or "fast".
std::string_view accuracy_name(Accuracy accuracy);

/// What a kernel computes for every point of a batch.
struct Program {
  std::string name;                       ///< For people: "sample", "outputs".
  std::vector<Function> functions{1};     ///< The entry, then callees before their callers.
  std::vector<Channel> inputs;            ///< Their order is that of KernelArguments::inputs.
  std::vector<Channel> outputs;           ///< Their order is that of KernelArguments::outputs.
  std::vector<ParameterSlot> parameters;  ///< Their order is that of the block.
  std::vector<Table> tables;              ///< Part of the kernel; nothing to bind.
  std::vector<TextureSlot> textures;      ///< Their order is that of KernelArguments::textures.
  std::vector<Fit> fits;                  ///< What Op::fitted reads, and
  std::uint32_t fitted_rows = 0;          ///< how many rows KernelArguments::fitted has.
  /// Nodes by path and lobes by name, for people who ask what costs what; 0: nobody's.
  std::vector<std::string> origins{""};

  /// Function 0.
  Function& entry() { return functions.front(); }
  /// Function 0.
  const Function& entry() const { return functions.front(); }
};

/// Instructions of all functions.
std::size_t instruction_count(const Program& program);

/// The canonical text of a Program: values numbered from 0 in order of
/// definition, one instruction a line, regions indented. Golden tests and
/// `nacre inspect` show it; runtime/program/parse.h reads it back.
std::string to_string(const Program& program);

/// Checks all that the engines rely on: operand types and counts, definition
/// before use and in scope, regions closed in order, indices in range, callees
/// before their callers. Returns the first fault, or an empty string.
std::string verify(const Program& program);

/// Sets Instruction::varying everywhere: inputs and what depends on them. An argument is
/// varying if that of any call is, or by `all_arguments`. With `all`, every value is (a debug
/// mode that must change nothing).
void mark_varying(Program& program, bool all = false, bool all_arguments = false);

/// Of a marked Program's function, by index: the arguments that it reads and that no call
/// gives a varying value.
std::vector<bool> uniform_arguments(const Function& function);

}  // namespace nacre
