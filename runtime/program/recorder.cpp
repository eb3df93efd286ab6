#include "runtime/program/recorder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <optional>
#include <utility>

#include "runtime/program/choice.h"
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

}  // namespace

Recorder::Recorder() {
  program_.entry().name = "entry";
  // In place: of a temporary GCC 12 warns, at -O3, that it may not be initialized.
  open_.emplace_back().regions = {0};
}

void Recorder::adopt_interface(const Program& program) {
  assert(program_.entry().code.empty());
  program_.name = program.name;
  program_.inputs = program.inputs;
  program_.outputs = program.outputs;
  program_.parameters = program.parameters;
  program_.tables = program.tables;
  program_.textures = program.textures;
  program_.fits = program.fits;
  program_.fitted_rows = program.fitted_rows;
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
  return append_shared(bare_instruction(Op::input, type, index), true);
}

Ref Recorder::adopted(const Instruction& instruction) {
  assert(instruction.op == Op::input || instruction.op == Op::parameter);
  return append_shared(bare_instruction(instruction.op, instruction.type, instruction.imm),
                       instruction.op == Op::input);
}

Ref Recorder::parameter(std::string_view name, Scalar type, std::uint32_t bits) {
  if (varies_ && varies_(name)) return input(name, type);
  const std::uint32_t index =
      find_or_add(program_.parameters, name, ParameterSlot{std::string(name), type, bits});
  assert(program_.parameters[index].type == type);
  return append_shared(bare_instruction(Op::parameter, type, index), false);
}

bool Recorder::has_leaf(std::string_view name) const {
  return std::ranges::find(program_.parameters, name, &ParameterSlot::name) !=
             program_.parameters.end() ||
         std::ranges::find(program_.inputs, name, &Channel::name) != program_.inputs.end();
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
  if (const std::optional<Ref> equal = simplify(op, operands, keeps_sign_)) return *equal;
  if (const std::optional<Ref> other = rephrase(op, operands, imm)) return *other;
  std::array<Ref, 3> choice;
  if (op == Op::select) {
    choice = simple_choice(code().code, operands);
    operands = choice;
    if (const std::optional<Ref> equal = simplify(op, operands, keeps_sign_)) return *equal;
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
  Instruction instruction = bare_instruction(op, result_type(op, operands), imm);
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

std::optional<Ref> Recorder::rephrase(Op op, std::span<const Ref> operands, std::uint32_t imm) {
  const auto is_one = [](Ref x) { return x.is_constant(std::bit_cast<std::uint32_t>(1.0f)); };
  if (op == Op::max && is_limit(code().code, operands[0], operands[1])) return operands[1];
  if (op == Op::fma) {
    if (is_one(operands[0])) return emit(Op::add, operands.subspan(1));
    if (is_one(operands[1])) return emit(Op::add, std::array{operands[0], operands[2]});
  }
  // Engines compute the others as they can, not as they fold.
  if (op == Op::select || is_transcendental(op)) return std::nullopt;
  const std::optional<Sides> sides = literal_sides(code().code, operands);
  if (!sides) return std::nullopt;
  const auto yes = fold_literals(op, std::span(sides->yes).first(operands.size()), imm);
  const auto no = fold_literals(op, std::span(sides->no).first(operands.size()), imm);
  if (!yes || !no) return std::nullopt;
  return emit(Op::select, std::array{Ref{this, sides->condition, Scalar::b1}, *yes, *no});
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
  Instruction instruction = bare_instruction(Op::keep, x.type, keep_count_++);
  instruction.count = 1;
  instruction.operands[0] = x.id;
  const Ref kept = append(instruction, true);
  keeps_.emplace(x.id, kept.id);
  return kept;
}

bool Recorder::is_varying(Ref x) const { return !x.is_constant() && open_.back().varying[x.id]; }

ValueId Recorder::materialize(Ref x) {
  if (x.is_constant()) return append_shared(bare_instruction(Op::constant, x.type, x.id), false).id;
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
  ValueTable& values = open_.back().values;
  const ValueId known = values.find(code(), instruction);
  if (known != no_value) return {this, known, instruction.type};
  const Ref result = append(instruction, varying);
  values.add(code(), result.id);
  return result;
}

void Recorder::store(std::string_view name, Ref value) {
  const std::uint32_t index =
      find_or_add(program_.outputs, name, Channel{std::string(name), value.type});
  Instruction instruction = bare_instruction(Op::store, Scalar::none, index);
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
