#include "jit/api/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

#include "jit/api/channels.h"
#include "runtime/value/ref.h"

namespace nacre::api {

namespace {

/// A pointer to what is on this thread's stack, for functions of the C interface that are given
/// values and nothing else.
thread_local Recording* innermost = nullptr;

/// By nacre_operation.
constexpr std::array operations{
    Op::add,       Op::sub,    Op::mul,   Op::div,    Op::fma,    Op::min,    Op::max,    Op::sqrt,
    Op::neg,       Op::abs,    Op::floor, Op::ceil,   Op::trunc,  Op::round,  Op::eq,     Op::ne,
    Op::lt,        Op::le,     Op::iadd,  Op::isub,   Op::imul,   Op::umulhi, Op::iand,   Op::ior,
    Op::ixor,      Op::shl,    Op::lshr,  Op::ashr,   Op::ieq,    Op::ilt,    Op::ult,    Op::band,
    Op::bor,       Op::bxor,   Op::bnot,  Op::select, Op::f_to_i, Op::i_to_f, Op::u_to_f, Op::bits,
    Op::from_bits, Op::b_to_i, Op::sin,   Op::cos,    Op::tan,    Op::asin,   Op::acos,   Op::atan2,
    Op::exp,       Op::exp2,   Op::log,   Op::log2,   Op::pow,    Op::table,  Op::ddx};
static_assert(operations.size() == NACRE_DERIVATIVE + 1);
static_assert(operations[NACRE_SELECT] == Op::select && operations[NACRE_POW] == Op::pow &&
              operations[NACRE_ASHR] == Op::ashr && operations[NACRE_B_TO_I] == Op::b_to_i);

/// Of the letter in OpInfo::operands; `any` for x.
Scalar operand_type(char letter, Scalar any) {
  switch (letter) {
    case 'f': return Scalar::f32;
    case 'i': return Scalar::i32;
    case 'b': return Scalar::b1;
    default: return any;
  }
}

Ref zero(Scalar type) { return {nullptr, 0, type}; }

}  // namespace

Scalar scalar_of_number(int type) {
  if (type == NACRE_INT) return Scalar::i32;
  return type == NACRE_BOOL ? Scalar::b1 : Scalar::f32;
}

Recording::Recording(Recorder& recorder, Diagnostics& diagnostics, const SourceLocation& where)
    : recorder_(recorder), diagnostics_(diagnostics), where_(where), outer_(innermost) {
  innermost = this;
}

Recording::~Recording() {
  if (!regions_.empty()) fail("a region was left open", "as many ends as beginnings");
  while (!regions_.empty()) close_region();
  innermost = outer_;
}

Recording* Recording::current() { return innermost; }

void Recording::fail(const std::string& message, const std::string& expected) {
  // One is enough: what follows may be its consequence.
  if (!failed_) diagnostics_.error("host-body", where_, "the host's body: " + message, expected);
  failed_ = true;
}

Ref Recording::take(nacre_value value, Scalar type, const char* what) {
  const Scalar found = scalar_of_number(value.type);
  if (found != type) {
    fail(fmt::format("{} has another type", what), std::string(scalar_name(type)));
    return zero(type);
  }
  if (value.recorder == nullptr) {
    return {nullptr, type == Scalar::b1 ? value.bits != 0 : value.bits, type};
  }
  const Ref ref{&recorder_, value.bits, type};
  const bool is_here = value.recorder == handle() && value.bits < recorder_.next_value();
  if (!is_here || !recorder_.visible(ref) || recorder_.type_of(ref) != type) {
    fail(fmt::format("{} is of another recording, or of a region that has ended", what));
    return zero(type);
  }
  return ref;
}

nacre_value Recording::give(Ref ref) {
  return {ref.is_constant() ? nullptr : handle(), ref.id, number_type(ref.type)};
}

bool Recording::may_record(const char* what) {
  const bool may = regions_.empty() || !regions_.back().has_ended;
  if (!may) fail(fmt::format("{} follows what ends its region", what));
  return may;
}

nacre_value Recording::record(nacre_operation operation, const nacre_value* operands,
                              std::size_t count, std::uint32_t immediate) {
  const auto number = static_cast<std::size_t>(operation);
  if (number >= operations.size()) {
    fail("there is no such operation");
    return give(zero(Scalar::f32));
  }
  const OpInfo& about = info(operations[number]);
  Scalar any = Scalar::f32;
  if (about.any_result && count != 0) any = scalar_of_number(operands[count - 1].type);
  const Scalar result = about.any_result ? any : about.result;
  const bool reads_table = operations[number] == Op::table;
  const bool fits = count == about.operands.size() &&
                    (!reads_table || immediate < recorder_.program().tables.size()) &&
                    (operations[number] != Op::ddx || immediate < 2);
  if (!fits) {
    fail(fmt::format("{} has wrong operands", about.name),
         fmt::format("{}", about.operands.size()));
    return give(zero(result));
  }
  if (!may_record("an operation")) return give(zero(result));
  std::array<Ref, 3> taken;
  for (std::size_t i = 0; i < count; ++i) {
    taken[i] = take(operands[i], operand_type(about.operands[i], any), "an operand");
  }
  if (reads_table && taken[0].is_constant()) {
    // A literal index needs a recorder to find the table by.
    taken[0] = {&recorder_, recorder_.materialize(taken[0]), Scalar::i32};
  }
  const std::uint32_t imm = reads_table || operations[number] == Op::ddx ? immediate : 0;
  switch (count) {
    case 1: return give(nacre::record(operations[number], {taken[0]}, imm));
    case 2: return give(nacre::record(operations[number], {taken[0], taken[1]}, imm));
    default: return give(nacre::record(operations[number], {taken[0], taken[1], taken[2]}, imm));
  }
}

Recording::Region* Recording::open(bool is_loop, const char* what) {
  if (!regions_.empty() && regions_.back().is_loop == is_loop) return &regions_.back();
  fail(fmt::format("{} outside of its region", what));
  return nullptr;
}

void Recording::begin_if(nacre_value mask) {
  if (!may_record("a region")) return;
  const Ref taken = take(mask, Scalar::b1, "a mask");
  recorder_.begin_if({&recorder_, recorder_.materialize(taken), Scalar::b1});
  regions_.push_back({});
}

nacre_value Recording::merge(nacre_value inside, nacre_value outside) {
  const Scalar type = scalar_of_number(inside.type);
  Region* region = open(false, "a merge");
  if (region == nullptr) return give(zero(type));
  const Ref inner = take(inside, type, "a merged value");
  const Ref outer = take(outside, type, "a merged value");
  if (!outer.is_constant() && !recorder_.outlives_region(outer)) {
    fail("what a merge gives outside must be of before the region");
    return give(zero(type));
  }
  region->has_ended = true;
  return give(recorder_.merge(inner, outer));
}

void Recording::end_if() {
  if (open(false, "an end") != nullptr) close_region();
}

void Recording::begin_loop(nacre_value mask, std::uint32_t bound) {
  if (!may_record("a region")) return;
  const Ref taken = take(mask, Scalar::b1, "a mask");
  recorder_.begin_loop({&recorder_, recorder_.materialize(taken), Scalar::b1}, loop_bound(bound));
  regions_.push_back({.is_loop = true});
}

nacre_value Recording::carry(nacre_value initial) {
  const Scalar type = scalar_of_number(initial.type);
  Region* region = open(true, "a carry");
  if (region == nullptr) return give(zero(type));
  const Ref taken = take(initial, type, "an initial value");
  if (!taken.is_constant() && !recorder_.outlives_region(taken)) {
    fail("what a loop begins with must be of before it");
    return give(zero(type));
  }
  const Ref carried = recorder_.carry(taken);
  region->carries.push_back(carried);
  return give(carried);
}

nacre_value Recording::next(nacre_value carried, nacre_value value) {
  const Scalar type = scalar_of_number(carried.type);
  Region* region = open(true, "a next value");
  if (region == nullptr) return give(zero(type));
  const Ref of = take(carried, type, "a carry");
  const Ref taken = take(value, type, "a next value");
  const bool is_in_turn =
      region->nexts < region->carries.size() && region->carries[region->nexts].id == of.id;
  if (!is_in_turn || of.is_constant()) {
    fail("next values come for each carry, in their order");
    return give(zero(type));
  }
  region->has_ended = true;
  ++region->nexts;
  return give(recorder_.next(of, taken));
}

void Recording::again(nacre_value goes_on) {
  Region* region = open(true, "whether a loop goes on");
  if (region == nullptr) return;
  const Ref taken = take(goes_on, Scalar::b1, "whether a loop goes on");
  if (region->has_again) return fail("a loop says once whether it goes on");
  finish_carries(*region);
  recorder_.again(taken);
  region->has_ended = region->has_again = true;
}

void Recording::finish_carries(Region& region) {
  if (region.nexts == region.carries.size()) return;
  fail("a carry has no next value", "one for each");
  for (; region.nexts < region.carries.size(); ++region.nexts) {
    const Ref carried = region.carries[region.nexts];
    recorder_.next(carried, carried);
  }
}

void Recording::close_region() {
  Region& region = regions_.back();
  if (region.is_loop) {
    finish_carries(region);
    if (!region.has_again) {
      fail("a loop does not say whether it goes on", "nacre_again");
      recorder_.again(Ref::literal(false));
    }
    recorder_.end_loop();
  } else {
    recorder_.end_if();
  }
  regions_.pop_back();
}

void Recording::end_loop() {
  if (open(true, "an end") != nullptr) close_region();
}

Ref Recording::read_channel(const std::string& name, Scalar type) {
  const auto& channels = recorder_.program().inputs;
  const auto found = std::ranges::find(channels, name, &Channel::name);
  if (name.empty() || (found != channels.end() && found->type != type)) {
    fail(fmt::format("the channel '{}' has another type", name));
    return zero(type);
  }
  return may_record("a channel") ? recorder_.input(name, type) : zero(type);
}

Ref Recording::read_slot(const std::string& name, nacre_value literal) {
  const Scalar type = scalar_of_number(literal.type);
  const auto& slots = recorder_.program().parameters;
  const auto found = std::ranges::find(slots, name, &ParameterSlot::name);
  const bool fits =
      !name.empty() && literal.recorder == nullptr && (found == slots.end() || found->type == type);
  if (!fits) {
    fail(fmt::format("the slot '{}' has another type, or no literal to begin with", name));
    return zero(type);
  }
  return may_record("a slot") ? recorder_.parameter(name, type, literal.bits) : zero(type);
}

nacre_value Recording::keep(nacre_value value) {
  const Ref taken = take(value, scalar_of_number(value.type), "a kept value");
  if (taken.is_constant()) return give(taken);
  if (!recorder_.at_top_level()) {
    fail("values are kept outside regions only");
    return give(taken);
  }
  return give(recorder_.keep(taken));
}

}  // namespace nacre::api
