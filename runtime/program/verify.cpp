#include <fmt/format.h>

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
  Verifier(const Program& program, const Function& function, bool is_entry)
      : program_(program), function_(function), is_entry_(is_entry),
        home_(function.code.size(), 0) {}

  std::string run() {
    for (std::size_t i = 0; i < function_.code.size(); ++i) {
      std::string fault = check(static_cast<ValueId>(i));
      if (!fault.empty()) {
        return fmt::format("{} %{} {}: {}", function_.name, i, info(function_.code[i].op).name,
                           fault);
      }
    }
    return regions_.size() == 1 ? std::string() : function_.name + ": a region is not closed";
  }

 private:
  struct Region {
    std::uint32_t number;
    Op op;
    bool ended = false;  ///< A loop's `again` was seen.
  };

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
    if (letters != "*" && operands.size() != letters.size()) return "wrong number of operands";
    Scalar any = Scalar::none;
    for (std::size_t k = 0; k < operands.size(); ++k) {
      if (operands[k] >= id) return fmt::format("operand {} is not defined before", k);
      if (!visible(operands[k])) return fmt::format("operand {} is out of scope", k);
      const Scalar type = function_.code[operands[k]].type;
      if (letters == "*") continue;
      const Scalar wanted = letter_type(letters[k]);
      if (wanted != Scalar::none && type != wanted) {
        return fmt::format("operand {} is {}, not {}", k, scalar_name(type), scalar_name(wanted));
      }
      if (letters[k] != 'x') continue;
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

  std::string check_imm(const Instruction& instruction) const {
    const auto below = [&](std::size_t size) {
      return instruction.imm < size ? std::string() : std::string("index out of range");
    };
    switch (instruction.op) {
      case Op::parameter: return below(program_.parameters.size());
      case Op::input: return is_entry_ ? below(program_.inputs.size()) : "input in a function";
      case Op::argument: return below(function_.arguments.size());
      case Op::table: return below(program_.tables.size());
      case Op::store: return is_entry_ ? below(program_.outputs.size()) : "store in a function";
      case Op::give: return below(function_.results.size());
      case Op::call:
        if (function_.operands(instruction).size() !=
            program_.functions[instruction.imm].arguments.size()) {
          return "wrong number of arguments";
        }
        return instruction.imm == 0 ? "calls the entry" : below(program_.functions.size());
      default: return {};
    }
  }

  std::string check_region(ValueId id) {
    const Instruction& instruction = function_.code[id];
    Region& region = regions_.back();
    switch (instruction.op) {
      case Op::if_any:
      case Op::loop:
        regions_.push_back({.number = next_region_++, .op = instruction.op});
        return {};
      case Op::merge:
        home_[id] = regions_.size() < 2 ? 0 : regions_[regions_.size() - 2].number;
        return region.op == Op::if_any ? "" : "outside an if_any region";
      case Op::carry: return region.op == Op::loop ? "" : "outside a loop region";
      case Op::next:
        home_[id] = regions_.size() < 2 ? 0 : regions_[regions_.size() - 2].number;
        if (function_.code[instruction.operands[0]].op != Op::carry) return "not of a carry";
        return region.op == Op::loop ? "" : "outside a loop region";
      case Op::again:
        region.ended = true;
        return region.op == Op::loop ? "" : "outside a loop region";
      case Op::end_if:
        if (region.op != Op::if_any || regions_.size() == 1) return "closes no if_any";
        regions_.pop_back();
        return {};
      case Op::end_loop:
        if (region.op != Op::loop || !region.ended) return "closes no loop with an again";
        regions_.pop_back();
        return {};
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
  const Function& function_;
  bool is_entry_;
  std::vector<std::uint32_t> home_;
  std::vector<Region> regions_{{.number = 0, .op = Op::constant}};
  std::uint32_t next_region_ = 1;
};

}  // namespace

std::string verify(const Program& program) {
  for (std::size_t i = 0; i < program.functions.size(); ++i) {
    std::string fault = Verifier(program, program.functions[i], i == 0).run();
    if (!fault.empty()) return fault;
  }
  return {};
}

}  // namespace nacre
