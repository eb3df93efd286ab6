// Regions, functions and calls: the part of Recorder that knows of scopes.

#include <array>
#include <cassert>
#include <optional>
#include <string>
#include <utility>

#include "runtime/program/recorder.h"
#include "runtime/program/simplify.h"

namespace nacre {

// -- Regions ----------------------------------------------------------------

void Recorder::open_region(Op op, Ref mask, std::uint32_t imm) {
  Instruction instruction = bare_instruction(op, Scalar::none, imm);
  instruction.count = 1;
  instruction.operands[0] = materialize(mask);
  append(instruction, is_varying(mask));
  Open& open = open_.back();
  open.regions.push_back(open.next_region++);
  open.masks.push_back(op == Op::if_any ? mask : Ref::literal(true));
  open.values.open_scope();
}

void Recorder::close_region(Op op) {
  Open& open = open_.back();
  assert(open.regions.size() > 1);
  open.regions.pop_back();
  open.masks.pop_back();
  open.values.close_scope();
  append(bare_instruction(op, Scalar::none, 0), false);
}

void Recorder::begin_if(Ref mask) { open_region(Op::if_any, mask, 0); }

Ref Recorder::merge(Ref inner, Ref outer) {
  assert(inner.type == outer.type);
  const Ref both[]{inner, outer};
  if (const std::optional<Ref> equal = simplify(Op::merge, both)) return *equal;
  Instruction instruction = bare_instruction(Op::merge, inner.type, 0);
  instruction.count = 2;
  instruction.operands = {materialize(inner), materialize(outer), no_value};
  const Ref result = append(instruction, true);
  Open& open = open_.back();
  open.home.back() = open.regions[open.regions.size() - 2];
  return result;
}

void Recorder::set_outer(Ref merge, Ref outer) {
  Instruction& instruction = code().code[merge.id];
  assert(instruction.op == Op::merge && outer.id < instruction.operands[0]);
  instruction.operands[1] = outer.id;
}

bool Recorder::outlives_region(Ref x) const {
  const Open& open = open_.back();
  return x.is_constant() || open.home[x.id] != open.regions.back();
}

void Recorder::end_if() { close_region(Op::end_if); }

Ref Recorder::needed_lanes() {
  Ref lanes = Ref::literal(true);
  for (const Ref mask : open_.back().masks) lanes = emit(Op::band, std::array{lanes, mask});
  return lanes;
}

void Recorder::begin_loop(Ref mask, std::uint32_t imm) { open_region(Op::loop, mask, imm); }

Ref Recorder::carry(Ref initial) {
  Instruction instruction = bare_instruction(Op::carry, initial.type, 0);
  instruction.count = 1;
  instruction.operands[0] = materialize(initial);
  // Conservative: what the loop makes of it is not known yet.
  return append(instruction, true);
}

Ref Recorder::next(Ref carry, Ref value) {
  assert(carry.type == value.type);
  Instruction instruction = bare_instruction(Op::next, value.type, 0);
  instruction.count = 2;
  instruction.operands = {carry.id, materialize(value), no_value};
  const Ref result = append(instruction, true);
  Open& open = open_.back();
  open.home.back() = open.regions[open.regions.size() - 2];
  return result;
}

void Recorder::again(Ref condition) {
  Instruction instruction = bare_instruction(Op::again, Scalar::none, 0);
  instruction.count = 1;
  instruction.operands[0] = materialize(condition);
  append(instruction, true);
}

void Recorder::end_loop() { close_region(Op::end_loop); }

// -- Functions --------------------------------------------------------------

std::uint32_t Recorder::find_function(std::string_view key) const {
  const auto found = function_keys_.find(std::string(key));
  return found == function_keys_.end() ? 0 : found->second;
}

void Recorder::begin_function(std::string key, std::string name,
                              std::span<const Scalar> arguments) {
  Function function;
  function.name = std::move(name);
  function.arguments.assign(arguments.begin(), arguments.end());
  open_.push_back({.number = next_number_++,
                   .function = std::move(function),
                   .key = std::move(key),
                   .values = {},
                   .varying = {},
                   .home = {},
                   .regions = {0}});
}

Ref Recorder::argument(std::uint32_t index) {
  return append_shared(bare_instruction(Op::argument, code().arguments[index], index), true);
}

std::uint32_t Recorder::end_function(std::span<const Ref> results) {
  assert(open_.size() > 1 && open_.back().regions.size() == 1);
  for (std::size_t i = 0; i < results.size(); ++i) {
    Instruction instruction =
        bare_instruction(Op::give, Scalar::none, static_cast<std::uint32_t>(i));
    instruction.count = 1;
    instruction.operands[0] = materialize(results[i]);
    append(instruction, true);
    code().results.push_back(results[i].type);
  }
  const auto index = static_cast<std::uint32_t>(program_.functions.size());
  program_.functions.push_back(std::move(open_.back().function));
  function_keys_.emplace(open_.back().key, index);
  open_.pop_back();
  return index;
}

Ref Recorder::append_list(Op op, Scalar type, std::span<const Ref> operands, std::uint32_t imm) {
  std::vector<ValueId> ids;
  bool varying = false;
  // The key holds ids of this function; calls are shared at its top level only.
  const bool shareable = open_.back().regions.size() == 1;
  std::string key = std::to_string(open_.back().number) + '/' +
                    std::to_string(static_cast<int>(op)) + '/' + std::to_string(imm);
  for (const Ref operand : operands) {
    ids.push_back(materialize(operand));
    varying = varying || is_varying(operand);
    key += ',' + std::to_string(ids.back());
  }
  if (shareable) {
    if (const auto found = list_keys_.find(key); found != list_keys_.end()) {
      return {this, found->second, type};
    }
  }
  Function& function = code();
  Instruction instruction = bare_instruction(op, type, imm);
  instruction.operands = {static_cast<ValueId>(function.pool.size()),
                          static_cast<ValueId>(ids.size()), no_value};
  function.pool.insert(function.pool.end(), ids.begin(), ids.end());
  const Ref result = append(instruction, varying);
  if (shareable) list_keys_.emplace(std::move(key), result.id);
  return result;
}

std::vector<Ref> Recorder::call(std::uint32_t function, std::span<const Ref> arguments) {
  const Ref site = append_list(Op::call, Scalar::none, arguments, function);
  std::vector<Ref> results;
  const std::vector<Scalar> types = program_.functions[function].results;
  for (std::size_t i = 0; i < types.size(); ++i) {
    Instruction instruction = bare_instruction(Op::result, types[i], static_cast<std::uint32_t>(i));
    instruction.count = 1;
    instruction.operands[0] = site.id;
    results.push_back(append_shared(instruction, is_varying(site)));
  }
  return results;
}

std::vector<Ref> Recorder::texture_call(std::span<const Ref> operands, std::uint32_t imm) {
  const Ref site = append_list(Op::texture_call, Scalar::none, operands, imm);
  std::vector<Ref> results;
  for (std::uint32_t i = 0; i < 4; ++i) {
    Instruction instruction = bare_instruction(Op::result, Scalar::f32, i);
    instruction.count = 1;
    instruction.operands[0] = site.id;
    results.push_back(append_shared(instruction, is_varying(site)));
  }
  return results;
}

}  // namespace nacre
