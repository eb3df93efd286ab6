#include "tests/support/random_program.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <iterator>

#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "tests/support/random.h"

namespace nacre {

namespace {

constexpr std::array scalars{Scalar::f32, Scalar::i32, Scalar::b1};

Scalar letter_type(char letter) {
  return letter == 'f' ? Scalar::f32 : letter == 'i' ? Scalar::i32 : Scalar::b1;
}

/// Operations without memory or structure.
std::vector<Op> plain_operations() {
  std::vector<Op> list;
  for (int number = 0; number < op_count; ++number) {
    const Op op = static_cast<Op>(number);
    const std::string_view operands = info(op).operands;
    if (operands.empty() || operands == "*" || is_structural(op) || is_transcendental(op) ||
        op == Op::table || op == Op::fitted || op == Op::texel || op == Op::texture_call ||
        op == Op::keep || op == Op::ddx || op == Op::stand_in) {
      continue;
    }
    list.push_back(op);
  }
  return list;
}

class Generator {
 public:
  Generator(std::uint64_t seed, const RandomProgramOptions& options)
      : random_(seed), options_(options) {}

  Program run() {
    for (int k = 0; k < 3; ++k) recorder_.texture("texture." + std::to_string(k));
    const int functions =
        static_cast<int>(random_.below(static_cast<std::uint32_t>(options_.functions) + 1));
    for (int k = 0; k < functions; ++k) outlined(k);
    in_entry_ = true;
    scopes_.emplace_back();
    for (int k = 0; k < 2; ++k) input();
    operations(options_.operations);
    const Program whole = finish();
    return whole;
  }

 private:
  using Pool = std::vector<Ref>;

  // -- Values in scope --

  void add(Ref value) { scopes_.back().push_back(value); }

  /// A value of that type, recent ones first; or a leaf.
  Ref any(Scalar type) {
    if (random_.chance(0.12)) return literal(type);
    const bool wants_uniform = random_.chance(0.25);
    for (int attempt = 0; attempt < 24; ++attempt) {
      const Pool& pool =
          scopes_[scopes_.size() - 1 - std::min<std::size_t>(random_.below(3), scopes_.size() - 1)];
      if (pool.empty()) continue;
      const auto size = static_cast<std::uint32_t>(pool.size());
      const Ref value = pool[random_.chance(0.5) ? size - 1 - random_.below(std::min(size, 8u))
                                                 : random_.below(size)];
      if (value.type != type) continue;
      if (wants_uniform && attempt < 12 && recorder_.is_varying(value)) continue;
      return value;
    }
    return wants_uniform || !in_entry_ ? parameter(type) : input(type);
  }

  Ref literal(Scalar type) {
    if (type == Scalar::b1) return Ref::literal(random_.chance(0.5));
    return {nullptr, hostile_bits(random_.word()), type};
  }
  Ref parameter(Scalar type) {
    const std::string name =
        "p." + std::string(scalar_name(type)) + std::to_string(random_.below(3));
    return recorder_.parameter(name, type, 0);
  }
  Ref input(Scalar type) {
    return recorder_.input(
        "in." + std::string(scalar_name(type)) + std::to_string(random_.below(3)), type);
  }
  void input() {
    for (const Scalar type : scalars) add(input(type));
  }

  // -- Instructions --

  void operations(int count) {
    for (int k = 0; k < count; ++k) operation(count);
  }

  void operation(int count) {
    const std::uint32_t choice = random_.below(100);
    if (options_.memory && choice < 3) return table();
    if (options_.memory && choice < 6) return texel();
    if (options_.memory && choice < 7 && depth_ == 0) return texture_call();
    if (choice < 10 && !functions_.empty()) return call();
    if (options_.regions && choice < 15 && depth_ < 3) return branch(count / 4);
    if (options_.regions && choice < 18 && depth_ < 2) return repeat(count / 4);
    plain();
  }

  void plain() {
    static const std::vector<Op> list = plain_operations();
    const Op op = random_.pick(list);
    std::vector<Ref> operands;
    const Scalar free = scalars[random_.below(3)];
    for (const char letter : info(op).operands) {
      operands.push_back(any(letter == 'x' ? free : letter_type(letter)));
    }
    keep(recorder_.emit(op, operands));
  }

  void keep(Ref value) {
    if (!value.is_constant()) add(value);
  }

  void table() {
    const std::uint32_t size = 1 + random_.below(random_.chance(0.7) ? 33 : 80);
    std::vector<float> values;
    for (std::uint32_t k = 0; k < size; ++k) {
      const float value = std::bit_cast<float>(hostile_bits(random_.word()));
      values.push_back(value == value ? value : 1.0f);  // A NaN is equal to no table's entry.
    }
    const std::uint32_t index = recorder_.table("table." + std::to_string(tables_++), values);
    const std::array operands{random_.chance(0.7) ? masked(any(Scalar::i32), 63)
                                                  : any(Scalar::i32)};
    keep(recorder_.emit(Op::table, operands, index));
  }

  Ref masked(Ref value, std::int32_t mask) {
    const std::array operands{value, Ref::literal(mask)};
    return recorder_.emit(Op::iand, operands);
  }

  /// Often neighbouring words, as texture look-ups read them.
  void texel() {
    const Ref slot = random_.chance(0.7) ? Ref::literal(static_cast<std::int32_t>(random_.below(4)))
                                         : masked(any(Scalar::i32), 3);
    const Ref word = random_.chance(0.7) ? masked(any(Scalar::i32), 127) : any(Scalar::i32);
    const std::uint32_t words = 1u << random_.below(3);
    for (std::uint32_t k = 0; k < words; ++k) {
      const std::array offset{word, Ref::literal(static_cast<std::int32_t>(k))};
      const std::array operands{slot, recorder_.emit(Op::iadd, offset)};
      keep(recorder_.emit(Op::texel, operands));
    }
  }

  void texture_call() {
    std::vector<Ref> operands{Ref::literal(static_cast<std::int32_t>(random_.below(3)))};
    for (int k = 0; k < 6; ++k) operands.push_back(any(Scalar::f32));
    for (const Ref value : recorder_.texture_call(operands, random_.below(64))) add(value);
  }

  void call() {
    const Outlined& function = random_.pick(functions_);
    std::vector<Ref> arguments;
    for (const Scalar type : function.arguments) arguments.push_back(any(type));
    for (const Ref value : recorder_.call(function.index, arguments)) add(value);
  }

  void branch(int count) {
    const Ref mask = any(Scalar::b1);
    std::vector<Ref> outer;
    const std::uint32_t merges = 1 + random_.below(3);
    for (std::uint32_t k = 0; k < merges; ++k) outer.push_back(any(scalars[random_.below(3)]));
    recorder_.begin_if(mask);
    enter();
    operations(1 + count);
    std::vector<Ref> merged;
    for (const Ref value : outer) merged.push_back(recorder_.merge(any(value.type), value));
    leave();
    recorder_.end_if();
    for (const Ref value : merged) add(value);
  }

  void repeat(int count) {
    const Ref mask = random_.chance(0.3) ? Ref::literal(true) : any(Scalar::b1);
    std::vector<Ref> initial;
    const std::uint32_t carried = 1 + random_.below(3);
    for (std::uint32_t k = 0; k < carried; ++k) initial.push_back(any(scalars[random_.below(3)]));
    recorder_.begin_loop(mask, 1 + random_.below(6));
    enter();
    std::vector<Ref> carries;
    for (const Ref value : initial) carries.push_back(recorder_.carry(value));
    for (const Ref value : carries) add(value);
    operations(1 + count);
    std::vector<Ref> finals;
    for (const Ref value : carries) {
      if (!random_.chance(0.1)) finals.push_back(recorder_.next(value, any(value.type)));
    }
    recorder_.again(random_.chance(0.2) ? Ref::literal(true) : any(Scalar::b1));
    leave();
    recorder_.end_loop();
    for (const Ref value : finals) add(value);
  }

  void enter() {
    scopes_.emplace_back();
    ++depth_;
  }
  void leave() {
    scopes_.pop_back();
    --depth_;
  }

  // -- Functions --

  struct Outlined {
    std::uint32_t index;
    std::vector<Scalar> arguments;
  };

  void outlined(int number) {
    Outlined function{};
    const std::uint32_t count = 1 + random_.below(6);
    for (std::uint32_t k = 0; k < count; ++k)
      function.arguments.push_back(scalars[random_.below(3)]);
    const std::string name = "f" + std::to_string(number);
    recorder_.begin_function(name, name, function.arguments);
    scopes_.emplace_back();
    for (std::uint32_t k = 0; k < count; ++k) add(recorder_.argument(k));
    operations(4 + options_.operations / 4);
    std::vector<Ref> results;
    const std::uint32_t wanted = 1 + random_.below(6);
    for (std::uint32_t k = 0; k < wanted; ++k) results.push_back(any(scalars[random_.below(3)]));
    function.index = recorder_.end_function(results);
    scopes_.pop_back();
    functions_.push_back(function);
  }

  Program finish() {
    std::vector<SliceOutput> outputs;
    const Pool& pool = scopes_.back();
    for (std::size_t k = pool.size(); k-- > 0 && outputs.size() < 12;) {
      if (random_.chance(0.6)) outputs.push_back({"out." + std::to_string(k), pool[k]});
    }
    if (outputs.empty()) outputs.push_back({"out", pool.back()});
    return slice(recorder_.program(), "random", outputs);
  }

  Random random_;
  RandomProgramOptions options_;
  Recorder recorder_;
  std::vector<Pool> scopes_;
  std::vector<Outlined> functions_;
  int depth_ = 0;
  int tables_ = 0;
  bool in_entry_ = false;
};

std::uint64_t name_seed(std::uint64_t seed, std::string_view name) {
  for (const char c : name) seed = seed * 0x100000001b3ull + static_cast<unsigned char>(c);
  return seed;
}

/// Answers texture calls with something that depends on every operand.
void answer(void*, const TextureCall* call) {
  for (std::uint32_t k = 0; k < call->lanes; ++k) {
    const float sum = call->u[k] + 2 * call->v[k] + 3 * call->dudx[k];
    call->rgba[k] = sum;
    call->rgba[call->lanes + k] = call->dvdx[k] - call->dudy[k];
    call->rgba[2 * call->lanes + k] = call->dvdy[k];
    call->rgba[3 * call->lanes + k] = static_cast<float>(call->slot * 100 + call->modes);
  }
}

}  // namespace

std::uint32_t hostile_bits(std::uint64_t seed) {
  static const std::vector<std::uint32_t> edges{
      0x00000000u, 0x80000000u, 0x00000001u, 0x80000001u, 0x007fffffu, 0x807fffffu, 0x00800000u,
      0x80800000u, 0x3f800000u, 0xbf800000u, 0x3f7fffffu, 0x3f800001u, 0x3f000000u, 0xbf000000u,
      0x40200000u, 0x4effffffu, 0x4f000000u, 0xcf000000u, 0xcf000001u, 0x4f7fffffu, 0x4b000001u,
      0x4b7fffffu, 0x33800000u, 0x0da24260u, 0x5e800000u, 0x7f7fffffu, 0xff7fffffu, 0x7f800000u,
      0xff800000u, 0x7fc00000u, 0xffc00001u, 0x7f800001u, 0x7fffffffu, 0xffffffffu, 0x0000001fu,
      0x00000020u, 0x00007c00u, 0x00000001u, 0x0000fbffu};
  Random random(seed);
  switch (random.below(4)) {
    case 0: return random.pick(edges);
    case 1: return static_cast<std::uint32_t>(random.word());
    case 2: return random.below(64) - 16;
    default: {
      const float everyday = static_cast<float>(random.below(1u << 20)) * 0x1p-18f - 2.0f;
      return std::bit_cast<std::uint32_t>(everyday);
    }
  }
}

Program random_program(std::uint64_t seed, const RandomProgramOptions& options) {
  return Generator(seed, options).run();
}

std::vector<ValueId> top_level_values(const Program& program) {
  std::vector<ValueId> values;
  int depth = 0;
  const std::vector<Instruction>& code = program.entry().code;
  for (std::size_t i = 0; i < code.size() && code[i].op != Op::store; ++i) {
    if (closes_region(code[i].op)) --depth;
    const bool visible =
        depth == 0 || (depth == 1 && (code[i].op == Op::merge || code[i].op == Op::next));
    if (visible && code[i].type != Scalar::none) values.push_back(static_cast<ValueId>(i));
    if (opens_region(code[i].op)) ++depth;
  }
  return values;
}

Program program_of_value(const Program& program, ValueId value) {
  Recorder some;  // A Ref of a value names a recorder; slice() does not ask which.
  Program without_stores = program;
  std::erase_if(without_stores.entry().code,
                [](const Instruction& instruction) { return instruction.op == Op::store; });
  const std::array outputs{SliceOutput{"value", {&some, value, program.entry().code[value].type}}};
  return slice(without_stores, program.name, outputs);
}

RandomBatch::RandomBatch(const Program& program, std::uint64_t seed,
                         const std::vector<std::uint32_t>& order) {
  for (const Channel& channel : program.inputs) {
    const std::uint64_t base = name_seed(seed, channel.name);
    std::vector<std::uint32_t>& data = inputs_.emplace_back();
    for (const std::uint32_t point : order) {
      const std::uint32_t bits = hostile_bits(base + point * 0x9e3779b97f4a7c15ull);
      data.push_back(channel.type == Scalar::b1 ? (bits >> 7 & 1u) * bits : bits);
    }
  }
  for (const ParameterSlot& slot : program.parameters) {
    parameters_.push_back(hostile_bits(name_seed(seed, slot.name)));
  }
  for (const TextureSlot& slot : program.textures) {
    Random random(name_seed(seed, slot.key));
    std::vector<std::uint32_t>& words = words_.emplace_back();
    const std::uint32_t count = 1 + random.below(130);
    for (std::uint32_t k = 0; k < count; ++k)
      words.push_back(static_cast<std::uint32_t>(random.word()));
  }
  for (const auto& words : words_) textures_.push_back({words.data(), words.size()});
}

std::vector<std::vector<std::uint32_t>> RandomBatch::run(const Kernel& kernel, std::size_t start,
                                                         std::size_t count) const {
  constexpr std::uint32_t untouched = 0xdeadbeefu;
  constexpr std::size_t margin = 20;
  std::vector<const void*> inputs;
  for (const auto& channel : inputs_) inputs.push_back(channel.data() + start);
  std::vector<std::vector<std::uint32_t>> outputs(
      kernel.program().outputs.size(), std::vector<std::uint32_t>(count + margin, untouched));
  std::vector<void*> pointers;
  for (auto& channel : outputs) pointers.push_back(channel.data());
  kernel.run({.inputs = inputs.data(),
              .outputs = pointers.data(),
              .parameters = parameters_.data(),
              .textures = textures_.data(),
              .texture_callback = &answer,
              .count = count});
  for (auto& channel : outputs) {
    const auto beyond = channel.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::any_of(beyond, channel.end(), [](std::uint32_t word) { return word != untouched; })) {
      return {};
    }
    channel.resize(count);
  }
  return outputs;
}

}  // namespace nacre
