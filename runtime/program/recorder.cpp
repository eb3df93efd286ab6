#include "runtime/program/recorder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <optional>
#include <utility>

#include "runtime/program/fold.h"
#include "runtime/program/simplify.h"

namespace nacre {

namespace {

/// The index of the element called `name`, appending `element` if there is none.
template <class T>
std::uint32_t find_or_add(std::vector<T>& list, std::string_view name, T element) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].name == name) return static_cast<std::uint32_t>(i);
  }
  list.push_back(std::move(element));
  return static_cast<std::uint32_t>(list.size() - 1);
}

Scalar result_type(Op op, std::span<const Ref> operands) {
  const OpInfo& row = info(op);
  return row.any_result && !operands.empty() ? operands.back().type : row.result;
}

/// The literal that `op` of literals gives, where it depends on nothing else.
std::optional<Ref> fold_literals(Op op, std::span<const Ref> operands, std::uint32_t imm) {
  std::array<std::uint32_t, 3> bits{};
  for (std::size_t i = 0; i < operands.size(); ++i) {
    if (!operands[i].is_constant()) return std::nullopt;
    bits[i] = operands[i].id;
  }
  const auto folded = fold(op, std::span(bits).first(operands.size()), imm);
  if (!folded) return std::nullopt;
  return Ref{nullptr, *folded, result_type(op, operands)};
}

Instruction leaf(Op op, Scalar type, std::uint32_t imm) {
  return {.op = op, .type = type, .imm = imm, .operands = {no_value, no_value, no_value}};
}

/// Whether max(x, limit) is `limit`, a literal that is not negative, for what x is: a product
/// with a literal 0 is a zero, or NaN where the other factor is not finite. So a colour
/// that is clamped from below is black where its weight is off, whatever the colour is.
bool is_limit(const std::vector<Instruction>& code, Ref x, Ref limit) {
  if (x.is_constant() || !limit.is_constant() || 0.0f > std::bit_cast<float>(limit.id)) {
    return false;
  }
  const Instruction& product = code[x.id];
  if (product.op != Op::mul) return false;
  const auto is_zero = [&](ValueId factor) {
    return code[factor].op == Op::constant && (code[factor].imm & 0x7fffffffu) == 0;
  };
  return is_zero(product.operands[0]) || is_zero(product.operands[1]);
}

/// The operands of a select without what its condition makes pointless: a negation, which
/// swaps the sides, and on each side a choice by the same condition.
std::array<Ref, 3> simple_choice(const std::vector<Instruction>& code,
                                 std::span<const Ref> operands) {
  std::array<Ref, 3> choice{operands[0], operands[1], operands[2]};
  const auto definition = [&](Ref x) { return x.is_constant() ? nullptr : &code[x.id]; };
  const auto become = [&](Ref& x, ValueId id) {
    const bool is_literal = code[id].op == Op::constant;
    x = is_literal ? Ref{nullptr, code[id].imm, x.type} : Ref{x.recorder, id, x.type};
  };
  while (const Instruction* negation = definition(choice[0])) {
    if (negation->op != Op::bnot) break;
    become(choice[0], negation->operands[0]);
    std::swap(choice[1], choice[2]);
  }
  if (choice[0].is_constant()) return choice;
  for (const std::size_t side : {1u, 2u}) {
    while (const Instruction* inner = definition(choice[side])) {
      if (inner->op != Op::select || inner->operands[0] != choice[0].id) break;
      become(choice[side], inner->operands[side]);
    }
  }
  return choice;
}

}  // namespace

std::size_t Recorder::KeyHash::operator()(const Instruction& key) const {
  std::uint64_t h = static_cast<std::uint64_t>(key.op) | static_cast<std::uint64_t>(key.type) << 8 |
                    static_cast<std::uint64_t>(key.imm) << 16;
  for (const ValueId operand : key.operands) {
    h = (h ^ operand) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 29;
  }
  return static_cast<std::size_t>(h);
}

Recorder::Recorder() {
  program_.entry().name = "entry";
  open_.push_back({.number = 0,
                   .function = {},
                   .key = {},
                   .scopes = {{}},
                   .varying = {},
                   .home = {},
                   .regions = {0}});
}

void Recorder::adopt_interface(const Program& program) {
  assert(program_.entry().code.empty());
  program_.name = program.name;
  program_.inputs = program.inputs;
  program_.outputs = program.outputs;
  program_.parameters = program.parameters;
  program_.tables = program.tables;
  program_.textures = program.textures;
  program_.origins = program.origins;
}

std::uint32_t Recorder::begin_origin(std::string_view name) {
  const auto next = static_cast<std::uint32_t>(program_.origins.size());
  const auto [place, is_new] = origin_numbers_.try_emplace(std::string(name), next);
  if (is_new) program_.origins.emplace_back(name);
  return std::exchange(origin_, place->second);
}

Ref Recorder::input(std::string_view name, Scalar type) {
  const std::uint32_t index = find_or_add(program_.inputs, name, Channel{std::string(name), type});
  assert(program_.inputs[index].type == type);
  return append_shared(leaf(Op::input, type, index), true);
}

Ref Recorder::parameter(std::string_view name, Scalar type, std::uint32_t bits) {
  const std::uint32_t index =
      find_or_add(program_.parameters, name, ParameterSlot{std::string(name), type, bits});
  assert(program_.parameters[index].type == type);
  return append_shared(leaf(Op::parameter, type, index), false);
}

Ref Recorder::texture(std::string_view key) {
  auto& list = program_.textures;
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const TextureSlot& slot) { return slot.key == key; });
  const auto index = static_cast<std::int32_t>(found - list.begin());
  if (found == list.end()) list.push_back({std::string(key)});
  return Ref::literal(index);
}

std::uint32_t Recorder::table(std::string_view name, std::span<const float> values) {
  const auto is_same = [](float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
  };
  std::string unused(name);
  for (int copy = 2;; ++copy) {
    const std::uint32_t index =
        find_or_add(program_.tables, unused, Table{unused, {values.begin(), values.end()}});
    if (std::ranges::equal(program_.tables[index].values, values, is_same)) return index;
    unused = std::string(name) + '.' + std::to_string(copy);
  }
}

Ref Recorder::emit(Op op, std::span<const Ref> operands, std::uint32_t imm) {
  assert(!is_structural(op) && operands.size() <= 3);
  if (const std::optional<Ref> literal = fold_literals(op, operands, imm)) return *literal;
  if (const std::optional<Ref> equal = simplify(op, operands)) return *equal;
  if (op == Op::max && is_limit(code().code, operands[0], operands[1])) return operands[1];
  std::array<Ref, 3> choice;
  if (op == Op::select) {
    choice = simple_choice(code().code, operands);
    operands = choice;
    if (const std::optional<Ref> equal = simplify(op, operands)) return *equal;
    if (choice[1].type == Scalar::b1) {
      // A side that is the condition itself is what the condition is there.
      const auto is_condition = [&](Ref x) { return !x.is_constant() && x.id == choice[0].id; };
      if (choice[1].is_constant(1u) || is_condition(choice[1])) {
        return emit(Op::bor, std::array{choice[0], choice[2]});
      }
      if (choice[2].is_constant(0u) || is_condition(choice[2])) {
        return emit(Op::band, std::array{choice[0], choice[1]});
      }
    }
  }
  Instruction instruction = leaf(op, result_type(op, operands), imm);
  instruction.count = static_cast<std::uint8_t>(operands.size());
  bool varying = false;
  for (std::size_t i = 0; i < operands.size(); ++i) {
    instruction.operands[i] = materialize(operands[i]);
    varying = varying || is_varying(operands[i]);
  }
  if (info(op).commutes && instruction.operands[1] < instruction.operands[0]) {
    std::swap(instruction.operands[0], instruction.operands[1]);
  }
  return append_shared(instruction, varying);
}

Ref Recorder::keep(Ref x) {
  if (!is_varying(x)) return x;
  assert(open_.size() == 1 && open_.back().regions.size() == 1);
  // A kept value, or an input that every kernel can load by itself.
  const Op op = program_.entry().code[x.id].op;
  if (op == Op::keep || op == Op::input) return x;
  if (const auto found = keeps_.find(x.id); found != keeps_.end()) {
    return {this, found->second, x.type};
  }
  Instruction instruction = leaf(Op::keep, x.type, keep_count_++);
  instruction.count = 1;
  instruction.operands[0] = x.id;
  const Ref kept = append(instruction, true);
  keeps_.emplace(x.id, kept.id);
  return kept;
}

bool Recorder::is_varying(Ref x) const { return !x.is_constant() && open_.back().varying[x.id]; }

ValueId Recorder::materialize(Ref x) {
  if (x.is_constant()) return append_shared(leaf(Op::constant, x.type, x.id), false).id;
  assert(x.recorder == this && in_scope(x.id));
  return x.id;
}

bool Recorder::in_scope(ValueId id) const {
  const Open& open = open_.back();
  return id < open.home.size() &&
         std::find(open.regions.begin(), open.regions.end(), open.home[id]) != open.regions.end();
}

Ref Recorder::append(Instruction instruction, bool varying) {
  auto& list = code().code;
  const auto id = static_cast<ValueId>(list.size());
  instruction.origin = origin_;
  list.push_back(instruction);
  ++size_;
  Open& open = open_.back();
  open.varying.push_back(varying);
  open.home.push_back(open.regions.back());
  return {this, id, instruction.type};
}

Ref Recorder::append_shared(Instruction instruction, bool varying) {
  Open& open = open_.back();
  for (auto scope = open.scopes.rbegin(); scope != open.scopes.rend(); ++scope) {
    if (const auto found = scope->find(instruction); found != scope->end()) {
      return {this, found->second, instruction.type};
    }
  }
  const Ref result = append(instruction, varying);
  open.scopes.back().emplace(instruction, result.id);
  return result;
}

// -- Regions ----------------------------------------------------------------

void Recorder::open_region(Op op, Ref mask, std::uint32_t imm) {
  Instruction instruction = leaf(op, Scalar::none, imm);
  instruction.count = 1;
  instruction.operands[0] = materialize(mask);
  append(instruction, is_varying(mask));
  Open& open = open_.back();
  open.regions.push_back(open.next_region++);
  open.masks.push_back(op == Op::if_any ? mask : Ref::literal(true));
  open.scopes.emplace_back();
}

void Recorder::close_region(Op op) {
  Open& open = open_.back();
  assert(open.regions.size() > 1);
  open.regions.pop_back();
  open.masks.pop_back();
  open.scopes.pop_back();
  append(leaf(op, Scalar::none, 0), false);
}

void Recorder::begin_if(Ref mask) { open_region(Op::if_any, mask, 0); }

Ref Recorder::merge(Ref inner, Ref outer) {
  assert(inner.type == outer.type);
  const Ref both[]{inner, outer};
  if (const std::optional<Ref> equal = simplify(Op::merge, both)) return *equal;
  Instruction instruction = leaf(Op::merge, inner.type, 0);
  instruction.count = 2;
  instruction.operands = {materialize(inner), materialize(outer), no_value};
  const Ref result = append(instruction, true);
  Open& open = open_.back();
  open.home.back() = open.regions[open.regions.size() - 2];
  return result;
}

void Recorder::end_if() { close_region(Op::end_if); }

Ref Recorder::needed_lanes() {
  Ref lanes = Ref::literal(true);
  for (const Ref mask : open_.back().masks) lanes = emit(Op::band, std::array{lanes, mask});
  return lanes;
}

void Recorder::begin_loop(Ref mask, std::uint32_t imm) { open_region(Op::loop, mask, imm); }

Ref Recorder::carry(Ref initial) {
  Instruction instruction = leaf(Op::carry, initial.type, 0);
  instruction.count = 1;
  instruction.operands[0] = materialize(initial);
  // Conservative: what the loop makes of it is not known yet.
  return append(instruction, true);
}

Ref Recorder::next(Ref carry, Ref value) {
  assert(carry.type == value.type);
  Instruction instruction = leaf(Op::next, value.type, 0);
  instruction.count = 2;
  instruction.operands = {carry.id, materialize(value), no_value};
  const Ref result = append(instruction, true);
  Open& open = open_.back();
  open.home.back() = open.regions[open.regions.size() - 2];
  return result;
}

void Recorder::again(Ref condition) {
  Instruction instruction = leaf(Op::again, Scalar::none, 0);
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
                   .scopes = {{}},
                   .varying = {},
                   .home = {},
                   .regions = {0}});
}

Ref Recorder::argument(std::uint32_t index) {
  return append_shared(leaf(Op::argument, code().arguments[index], index), true);
}

std::uint32_t Recorder::end_function(std::span<const Ref> results) {
  assert(open_.size() > 1 && open_.back().regions.size() == 1);
  for (std::size_t i = 0; i < results.size(); ++i) {
    Instruction instruction = leaf(Op::give, Scalar::none, static_cast<std::uint32_t>(i));
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
  Instruction instruction = leaf(op, type, imm);
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
    Instruction instruction = leaf(Op::result, types[i], static_cast<std::uint32_t>(i));
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
    Instruction instruction = leaf(Op::result, Scalar::f32, i);
    instruction.count = 1;
    instruction.operands[0] = site.id;
    results.push_back(append_shared(instruction, is_varying(site)));
  }
  return results;
}

void Recorder::store(std::string_view name, Ref value) {
  const std::uint32_t index =
      find_or_add(program_.outputs, name, Channel{std::string(name), value.type});
  Instruction instruction = leaf(Op::store, Scalar::none, index);
  instruction.count = 1;
  instruction.operands[0] = materialize(value);
  append(instruction, true);
}

Program Recorder::take() { return std::move(program_); }

// -- The free function that values use ---------------------------------------

Ref record(Op op, std::initializer_list<Ref> operands, std::uint32_t imm) {
  Recorder* recorder = nullptr;
  for (const Ref operand : operands) {
    if (operand.recorder != nullptr) recorder = operand.recorder;
  }
  const std::span<const Ref> list(operands.begin(), operands.size());
  if (recorder != nullptr) return recorder->emit(op, list, imm);
  const std::optional<Ref> literal = fold_literals(op, list, imm);
  assert(literal.has_value());
  return *literal;
}

}  // namespace nacre
