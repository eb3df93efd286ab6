#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <iterator>

#include "runtime/program/fold.h"
#include "runtime/program/program.h"

namespace nacre {

namespace {

using Buffer = fmt::memory_buffer;

template <class... A>
void put(Buffer& text, fmt::format_string<A...> format, A&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<A>(values)...);
}

/// Shortest decimal that reads back as the same bits; a NaN other than the
/// canonical one by its bits, "nan:ffc00001".
void put_float(Buffer& text, std::uint32_t bits) {
  const auto value = std::bit_cast<float>(bits);
  if (!std::isnan(value)) {
    put(text, "{}", value);
  } else if (bits == canonical_nan) {
    put(text, "nan");
  } else {
    put(text, "nan:{:08x}", bits);
  }
}

void put_bits(Buffer& text, Scalar type, std::uint32_t bits) {
  switch (type) {
    case Scalar::f32: put_float(text, bits); break;
    case Scalar::i32: put(text, "{}", static_cast<std::int32_t>(bits)); break;
    default: put(text, "{}", bits != 0); break;
  }
}

void put_imm(Buffer& text, const Program& program, const Instruction& instruction) {
  switch (instruction.op) {
    case Op::constant:
      text.push_back(' ');
      put_bits(text, instruction.type, instruction.imm);
      break;
    case Op::parameter: put(text, " {}", program.parameters[instruction.imm].name); break;
    case Op::input: put(text, " {}", program.inputs[instruction.imm].name); break;
    case Op::store: put(text, " {}", program.outputs[instruction.imm].name); break;
    case Op::table: put(text, " {}", program.tables[instruction.imm].name); break;
    case Op::call:
      put(text, " @{}.{}", program.functions[instruction.imm].name, instruction.imm);
      break;
    case Op::loop:
      put(text, " {}{}", loop_bound(instruction.imm),
          (instruction.imm & loop_must_end) != 0 ? "!" : "");
      break;
    case Op::argument:
    case Op::give:
    case Op::result:
    case Op::keep:
    case Op::ddx:
    case Op::fitted:
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

namespace {

/// What instructions name but do not say: texture keys, the parameters with
/// their values in the document, the contents of tables.
void put_lists(Buffer& text, const Program& program) {
  for (const TextureSlot& slot : program.textures) put(text, "texture \"{}\"\n", slot.key);
  for (const ParameterSlot& slot : program.parameters) {
    put(text, "parameter {} {} = ", scalar_name(slot.type), slot.name);
    put_bits(text, slot.type, slot.value);
    text.push_back('\n');
  }
  if (program.fitted_rows != 0) put(text, "fitted {}\n", program.fitted_rows);
  for (const Table& table : program.tables) {
    put(text, "table {} =", table.name);
    for (const float value : table.values) {
      text.push_back(' ');
      put_float(text, std::bit_cast<std::uint32_t>(value));
    }
    text.push_back('\n');
  }
}

}  // namespace

std::string to_string(const Program& program) {
  Buffer text;
  put(text, "program {}\n", program.name);
  put_lists(text, program);
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
