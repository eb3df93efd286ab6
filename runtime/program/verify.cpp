#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

namespace {

Scalar letter_type(char letter) {
  switch (letter) {
    case 'f': return Scalar::f32;
    case 'i': return Scalar::i32;
    case 'b': return Scalar::b1;
    default: return Scalar::none;
  }
}

class Verifier {
 public:
  Verifier(const Program& program, std::size_t index)
      : program_(program),
        index_(index),
        function_(program.functions[index]),
        home_(function_.code.size(), 0),
        given_(function_.results.size(), false) {}

  std::string run() {
    for (std::size_t i = 0; i < function_.code.size(); ++i) {
      std::string fault = check(static_cast<ValueId>(i));
      if (!fault.empty()) {
        return fmt::format("{} %{} {}: {}", function_.name, i, info(function_.code[i].op).name,
                           fault);
      }
    }
    if (regions_.size() != 1) return function_.name + ": a region is not closed";
    for (const bool given : given_) {
      if (!given) return function_.name + ": a result is not given";
    }
    return {};
  }

 private:
  struct Region {
    std::uint32_t number;
    Op op;
    ValueId opening;
  };

  bool is_entry() const { return index_ == 0; }

  bool visible(ValueId id) const {
    for (const Region& region : regions_) {
      if (region.number == home_[id]) return true;
    }
    return false;
  }

  std::string check_operands(ValueId id) const {
    const Instruction& instruction = function_.code[id];
    const std::string_view letters = info(instruction.op).operands;
    const auto operands = function_.operands(instruction);
    const std::size_t least = std::min(letters.find('?'), letters.size());
    const bool has_rest = operands.size() + 1 == letters.size() && least != letters.size();
    if (letters != "*" && operands.size() != least && !has_rest) return "wrong number of operands";
    Scalar any = Scalar::none;
    for (std::size_t k = 0; k < operands.size(); ++k) {
      if (operands[k] >= id) return fmt::format("operand {} is not defined before", k);
      if (!visible(operands[k])) return fmt::format("operand {} is out of scope", k);
      const Scalar type = function_.code[operands[k]].type;
      if (letters == "*") continue;
      const Scalar wanted = letter_type(letters[k < least ? k : k + 1]);
      if (wanted != Scalar::none && type != wanted) {
        return fmt::format("operand {} is {}, not {}", k, scalar_name(type), scalar_name(wanted));
      }
      if (wanted != Scalar::none) continue;
      if (any != Scalar::none && type != any) return "operand types differ";
      any = type;
    }
    if (any != Scalar::none && info(instruction.op).any_result && instruction.type != any) {
      return "result type is not that of the operands";
    }
    if (!info(instruction.op).any_result && instruction.type != info(instruction.op).result) {
      return "wrong result type";
    }
    return {};
  }

  template <class T>
  static std::string index_fault(std::uint32_t index, const std::vector<T>& list) {
    return index < list.size() ? std::string() : std::string("index out of range");
  }

  /// Of an instruction that names a channel, slot, argument or result.
  template <class T>
  static std::string listed_fault(const std::vector<T>& list, std::uint32_t index, Scalar type) {
    if (index >= list.size()) return "index out of range";
    Scalar declared;
    if constexpr (std::is_same_v<T, Scalar>) {
      declared = list[index];
    } else {
      declared = list[index].type;
    }
    return type == declared ? std::string() : std::string("not of the declared type");
  }

  std::string check_call(const Instruction& instruction) const {
    const std::uint32_t callee = instruction.imm;
    if (callee == 0) return "calls the entry";
    if (callee >= program_.functions.size()) return "index out of range";
    // So a call can't come back, and passes may go through the list in order.
    if (!is_entry() && callee >= index_) return "calls a function that does not stand before";
    const std::vector<Scalar>& arguments = program_.functions[callee].arguments;
    const auto operands = function_.operands(instruction);
    if (operands.size() != arguments.size()) return "wrong number of arguments";
    for (std::size_t k = 0; k < operands.size(); ++k) {
      if (function_.code[operands[k]].type != arguments[k]) return "argument types differ";
    }
    return {};
  }

  std::string check_result(const Instruction& instruction) const {
    if (instruction.count != 1 || instruction.operands[0] != last_call_) {
      return "not of the last call";
    }
    const Instruction& call = function_.code[last_call_];
    if (call.op == Op::call) {
      return listed_fault(program_.functions[call.imm].results, instruction.imm, instruction.type);
    }
    return listed_fault(std::vector<Scalar>(4, Scalar::f32), instruction.imm, instruction.type);
  }

  std::string check_imm(const Instruction& instruction) const {
    const auto operand_type = [&] { return function_.code[instruction.operands[0]].type; };
    const std::uint32_t imm = instruction.imm;
    switch (instruction.op) {
      case Op::parameter: return listed_fault(program_.parameters, imm, instruction.type);
      case Op::input:
        if (!is_entry()) return "input in a function";
        return listed_fault(program_.inputs, imm, instruction.type);
      case Op::argument: return listed_fault(function_.arguments, imm, instruction.type);
      case Op::store:
        if (!is_entry()) return "store in a function";
        return listed_fault(program_.outputs, imm, operand_type());
      case Op::give: return listed_fault(function_.results, imm, operand_type());
      case Op::table:
        if (std::string fault = index_fault(imm, program_.tables); !fault.empty()) return fault;
        return program_.tables[imm].values.empty() ? "empty table" : "";
      case Op::fitted: return imm < program_.fitted_rows ? "" : "index out of range";
      case Op::loop: return loop_bound(imm) != 0 ? "" : "may run no round";
      case Op::ddx: return imm < 2 ? "" : "no axis of the footprint";
      case Op::call: return check_call(instruction);
      case Op::result: return check_result(instruction);
      default: return {};
    }
  }

  /// Skipping the region needs this operand: it must be there before it opens.
  /// Literals stand where they were recorded and are exempt.
  std::string check_from_outside(const Instruction& instruction, std::size_t k) const {
    const ValueId operand = instruction.operands[k];
    const bool outside =
        operand < regions_.back().opening || function_.code[operand].op == Op::constant;
    return outside ? std::string() : fmt::format("operand {} is not from outside the region", k);
  }

  std::string check_region(ValueId id) {
    const Instruction& instruction = function_.code[id];
    const Region& region = regions_.back();
    const auto leave = [&] {
      home_[id] = regions_.size() < 2 ? 0 : regions_[regions_.size() - 2].number;
    };
    switch (instruction.op) {
      case Op::if_any:
      case Op::loop:
        regions_.push_back({.number = next_region_++, .op = instruction.op, .opening = id});
        return {};
      case Op::merge:
        leave();
        if (region.op != Op::if_any) return "outside an if_any region";
        return check_from_outside(instruction, 1);
      case Op::carry:
        if (region.op != Op::loop) return "outside a loop region";
        return check_from_outside(instruction, 0);
      case Op::next: {
        leave();
        if (region.op != Op::loop) return "outside a loop region";
        const ValueId carry = instruction.operands[0];
        if (function_.code[carry].op != Op::carry) return "not of a carry";
        return home_[carry] == region.number ? "" : "not of a carry of this loop";
      }
      case Op::again: {
        if (region.op != Op::loop) return "outside a loop region";
        const bool last =
            id + 1 < function_.code.size() && function_.code[id + 1].op == Op::end_loop;
        return last ? "" : "not last in its loop";
      }
      case Op::end_if:
        if (region.op != Op::if_any) return "closes no if_any";
        regions_.pop_back();
        return {};
      case Op::end_loop:
        if (region.op != Op::loop || function_.code[id - 1].op != Op::again) {
          return "closes no loop with an again";
        }
        regions_.pop_back();
        return {};
      case Op::give: given_[instruction.imm] = true; [[fallthrough]];
      case Op::store: return regions_.size() == 1 ? "" : "inside a region";
      case Op::call:
      case Op::texture_call: last_call_ = id; return {};
      default: return {};
    }
  }

  std::string check(ValueId id) {
    home_[id] = regions_.back().number;
    std::string fault = check_operands(id);
    if (fault.empty()) fault = check_imm(function_.code[id]);
    if (fault.empty()) fault = check_region(id);
    return fault;
  }

  const Program& program_;
  std::size_t index_;
  const Function& function_;
  std::vector<std::uint32_t> home_;  ///< By value: the region it is visible in.
  std::vector<bool> given_;          ///< By result.
  std::vector<Region> regions_{{.number = 0, .op = Op::constant, .opening = 0}};
  ValueId last_call_ = no_value;
  std::uint32_t next_region_ = 1;
};

}  // namespace

std::string verify(const Program& program) {
  for (std::size_t i = 0; i < program.functions.size(); ++i) {
    std::string fault = Verifier(program, i).run();
    if (!fault.empty()) return fault;
  }
  return {};
}

}  // namespace nacre
