#include <fmt/format.h>

#include <bit>
#include <iterator>

#include "runtime/program/program.h"

namespace nacre {

namespace {

using Buffer = fmt::memory_buffer;

template <class... A>
void put(Buffer& text, fmt::format_string<A...> format, A&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<A>(values)...);
}

void put_constant(Buffer& text, const Instruction& instruction) {
  switch (instruction.type) {
    case Scalar::f32: put(text, "{}", std::bit_cast<float>(instruction.imm)); break;
    case Scalar::i32: put(text, "{}", static_cast<std::int32_t>(instruction.imm)); break;
    default: put(text, "{}", instruction.imm != 0); break;
  }
}

void put_imm(Buffer& text, const Program& program, const Instruction& instruction) {
  switch (instruction.op) {
    case Op::constant:
      text.push_back(' ');
      put_constant(text, instruction);
      break;
    case Op::parameter: put(text, " {}", program.parameters[instruction.imm].name); break;
    case Op::input: put(text, " {}", program.inputs[instruction.imm].name); break;
    case Op::store: put(text, " {}", program.outputs[instruction.imm].name); break;
    case Op::table: put(text, " {}", program.tables[instruction.imm].name); break;
    case Op::call:
      put(text, " @{}.{}", program.functions[instruction.imm].name, instruction.imm);
      break;
    case Op::argument:
    case Op::give:
    case Op::result:
    case Op::loop:
    case Op::keep:
    case Op::ddx:
    case Op::texture_call: put(text, " {}", instruction.imm); break;
    default: break;
  }
}

bool has_value(const Instruction& instruction) {
  return instruction.type != Scalar::none || instruction.op == Op::call ||
         instruction.op == Op::texture_call;
}

void put_function(Buffer& text, const Program& program, const Function& function) {
  int depth = 1;
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    const Instruction& instruction = function.code[i];
    if (closes_region(instruction.op)) --depth;
    put(text, "{:{}}", "", 2 * depth);
    if (has_value(instruction)) {
      put(text, "%{} = ", i);
      if (instruction.type != Scalar::none) put(text, "{} ", scalar_name(instruction.type));
    }
    put(text, "{}", info(instruction.op).name);
    put_imm(text, program, instruction);
    for (const ValueId operand : function.operands(instruction)) put(text, " %{}", operand);
    text.push_back('\n');
    if (opens_region(instruction.op)) ++depth;
  }
}

}  // namespace

std::string_view accuracy_name(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::precise: return "precise";
    case Accuracy::standard: return "standard";
    case Accuracy::fast: return "fast";
  }
  return "";
}

std::string to_string(const Program& program) {
  Buffer text;
  put(text, "program {}\n", program.name);
  for (const TextureSlot& slot : program.textures) put(text, "texture \"{}\"\n", slot.key);
  for (const Table& table : program.tables) {
    put(text, "table {} of {}\n", table.name, table.values.size());
  }
  for (std::size_t i = 1; i < program.functions.size(); ++i) {
    const Function& function = program.functions[i];
    put(text, "function @{}.{}(", function.name, i);
    for (std::size_t k = 0; k < function.arguments.size(); ++k) {
      put(text, "{}{}", k == 0 ? "" : ", ", scalar_name(function.arguments[k]));
    }
    put(text, ")\n");
    put_function(text, program, function);
  }
  put(text, "entry\n");
  put_function(text, program, program.entry());
  return fmt::to_string(text);
}

}  // namespace nacre
