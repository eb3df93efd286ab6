#include "runtime/program/slice.h"

#include <cassert>
#include <utility>

#include "runtime/channel/channel_name.h"

namespace nacre {

namespace {

/// Marks live values of one function, from the last to the first; and once more where what
/// was passed may be needed after all: a carry needs its `next`, a loop what `again` reads.
class Liveness {
 public:
  explicit Liveness(const Function& function)
      : function_(function), live_(function.code.size(), false) {}

  std::vector<bool> run() {
    do {
      again_ = false;
      regions_.clear();
      for (at_ = static_cast<ValueId>(function_.code.size()); at_-- > 0;) visit(at_);
    } while (again_);
    return std::move(live_);
  }

 private:
  struct Region {
    std::vector<ValueId> frame;  ///< The closing instruction, and `again`.
    bool live = false;
  };

  void mark(ValueId id) {
    if (live_[id]) return;
    live_[id] = true;
    const Op op = function_.code[id].op;
    again_ = again_ || op == Op::carry || (id > at_ && op != Op::end_if);
  }

  void mark_with_operands(ValueId id) {
    mark(id);
    for (const ValueId operand : function_.operands(function_.code[id])) mark(operand);
  }

  void visit(ValueId id) {
    const Instruction& instruction = function_.code[id];
    switch (instruction.op) {
      case Op::store:
      case Op::give: mark_with_operands(id); break;
      case Op::end_if:
      case Op::end_loop: regions_.push_back({.frame = {id}}); break;
      case Op::again: regions_.back().frame.push_back(id); break;
      case Op::merge:
        if (!live_[id]) break;
        mark_with_operands(id);
        regions_.back().live = true;
        break;
      case Op::next:
        if (!live_[id] && !live_[instruction.operands[0]]) break;
        mark_with_operands(id);
        regions_.back().live = true;
        break;
      case Op::if_any:
      case Op::loop: {
        const Region region = std::move(regions_.back());
        regions_.pop_back();
        if (!region.live) break;
        mark_with_operands(id);
        for (const ValueId part : region.frame) mark_with_operands(part);
        break;
      }
      default:
        if (live_[id]) mark_with_operands(id);
        break;
    }
  }

  const Function& function_;
  std::vector<bool> live_;
  std::vector<Region> regions_;
  ValueId at_ = 0;
  bool again_ = false;
};

void compact(Function& function) {
  const std::vector<bool> live = Liveness(function).run();
  std::vector<ValueId> renamed(function.code.size(), no_value);
  std::vector<ValueId> pool;
  std::size_t count = 0;  // Of those that stay, which close up.
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    if (!live[i]) continue;
    Instruction& instruction = function.code[i];
    if (instruction.op == Op::call || instruction.op == Op::texture_call) {
      const auto first = static_cast<ValueId>(pool.size());
      for (const ValueId operand : function.operands(instruction)) pool.push_back(renamed[operand]);
      instruction.operands[0] = first;
    } else {
      for (std::size_t k = 0; k < instruction.count; ++k) {
        instruction.operands[k] = renamed[instruction.operands[k]];
      }
    }
    renamed[i] = static_cast<ValueId>(count);
    if (count != i) function.code[count] = instruction;
    ++count;
  }
  function.code.resize(count);
  function.pool = std::move(pool);
}

/// Keeps the elements of a list that `op` refers to, and renumbers its imm.
template <class T>
void compact_list(Program& program, std::vector<T>& list, Op op) {
  if (list.empty()) return;
  std::vector<std::uint32_t> renamed(list.size(), no_value);
  std::vector<T> kept;
  for (Function& function : program.functions) {
    for (Instruction& instruction : function.code) {
      if (instruction.op != op) continue;
      std::uint32_t& index = renamed[instruction.imm];
      if (index == no_value) {
        index = static_cast<std::uint32_t>(kept.size());
        kept.push_back(std::move(list[instruction.imm]));
      }
      instruction.imm = index;
    }
  }
  list = std::move(kept);
}

void compact_functions(Program& program) {
  std::vector<std::uint32_t> renamed(program.functions.size(), no_value);
  // Callees come before callers, but for the entry, which is first.
  std::vector<bool> used(program.functions.size(), false);
  used[0] = true;
  const auto mark_callees = [&](const Function& function) {
    for (const Instruction& instruction : function.code) {
      if (instruction.op == Op::call) used[instruction.imm] = true;
    }
  };
  mark_callees(program.entry());
  for (std::size_t i = program.functions.size(); i-- > 1;) {
    if (used[i]) mark_callees(program.functions[i]);
  }
  std::vector<Function> kept;
  for (std::size_t i = 0; i < program.functions.size(); ++i) {
    if (!used[i]) continue;
    renamed[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(std::move(program.functions[i]));
  }
  for (Function& function : kept) {
    for (Instruction& instruction : function.code) {
      if (instruction.op == Op::call) instruction.imm = renamed[instruction.imm];
    }
  }
  program.functions = std::move(kept);
}

/// Replaces the uses of every keep: by its operand, or by an input channel.
void resolve_keeps(Program& program, Keeps keeps) {
  Function& entry = program.entry();
  std::vector<ValueId> meaning(entry.code.size());
  for (std::size_t i = 0; i < entry.code.size(); ++i) {
    Instruction& instruction = entry.code[i];
    meaning[i] = static_cast<ValueId>(i);
    for (std::size_t k = 0; k < instruction.count; ++k) {
      instruction.operands[k] = meaning[instruction.operands[k]];
    }
    if (instruction.op != Op::keep) continue;
    if (keeps == Keeps::pass) {
      meaning[i] = instruction.operands[0];
      continue;
    }
    program.inputs.push_back(
        {channel_text("state", static_cast<int>(instruction.imm)), instruction.type});
    instruction = {.op = Op::input,
                   .type = instruction.type,
                   .imm = static_cast<std::uint32_t>(program.inputs.size() - 1),
                   .origin = instruction.origin};
  }
  for (ValueId& operand : entry.pool) operand = meaning[operand];
}

}  // namespace

void remove_dead(Program& program, bool keeps_interface) {
  for (Function& function : program.functions) compact(function);
  compact_functions(program);
  if (!keeps_interface) {
    compact_list(program, program.inputs, Op::input);
    compact_list(program, program.parameters, Op::parameter);
  }
  compact_list(program, program.tables, Op::table);
}

Program slice(const Program& recorded, std::string name, std::span<const SliceOutput> outputs,
              Keeps keeps) {
  Program program = recorded;
  program.name = std::move(name);
  program.outputs.clear();
  Function& entry = program.entry();
  for (const SliceOutput& output : outputs) {
    const auto index = static_cast<std::uint32_t>(program.outputs.size());
    program.outputs.push_back({output.name, output.value.type});
    ValueId value = output.value.id;
    if (output.value.is_constant()) {
      value = static_cast<ValueId>(entry.code.size());
      entry.code.push_back({.op = Op::constant, .type = output.value.type, .imm = output.value.id});
    }
    entry.code.push_back(
        {.op = Op::store, .count = 1, .imm = index, .operands = {value, no_value, no_value}});
  }
  resolve_keeps(program, keeps);
  remove_dead(program);
  mark_varying(program);
  assert(verify(program).empty());
  return program;
}

std::vector<SliceOutput> state_outputs(Recorder& recorder, std::span<const std::uint32_t> keeps) {
  std::vector<SliceOutput> outputs(keeps.size());
  const auto& code = recorder.program().entry().code;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i].op != Op::keep) continue;
    for (std::size_t k = 0; k < keeps.size(); ++k) {
      if (code[i].imm != keeps[k]) continue;
      outputs[k] = {channel_text("state", static_cast<int>(keeps[k])),
                    {&recorder, static_cast<ValueId>(i), code[i].type}};
    }
  }
  return outputs;
}

std::vector<std::uint32_t> state_channels(const Program& program) {
  std::vector<std::uint32_t> numbers;
  for (const Channel& input : program.inputs) {
    if (const auto number = state_number(input.name)) numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace nacre
