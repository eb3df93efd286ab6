#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "runtime/program/program.h"
#include "runtime/program/value_table.h"
#include "runtime/value/ref.h"

namespace nacre {

/// Builds a Program. Operations on recorded values (runtime/value) end here:
/// each is simplified, shared with an equal one in scope, or appended. One
/// Recorder serves one thread.
class Recorder {
 public:
  Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Takes over the channel, slot, table and texture lists of a Program, in
  /// their order; before anything is recorded.
  void adopt_interface(const Program& program);
  /// From now on x + 0 is no x, for it is 0 where x is -0: for passes that are to change no bit.
  void keep_sign_of_zero() { keeps_sign_ = true; }
  /// An input or parameter instruction of that Program again.
  Ref adopted(const Instruction& instruction);

  /// What is recorded from now on is for `name`; what another has recorded before and shares
  /// stays the other's. Returns what it was for.
  std::uint32_t begin_origin(std::string_view name);
  /// What is recorded now is for: a number of Program::origins.
  std::uint32_t origin() const { return origin_; }
  /// Back to what origin() or begin_origin() returned.
  void set_origin(std::uint32_t origin) { origin_ = origin; }

  // -- Leaves. The same name always gives the same value. --

  /// An input channel of the batch.
  Ref input(std::string_view name, Scalar type);
  /// A slot of the parameter block, `bits` its value in the document.
  Ref parameter(std::string_view name, Scalar type, std::uint32_t bits);
  /// Slots for which `varies` is true are input channels of the same name from now on.
  void vary_parameters(std::function<bool(std::string_view slot)> varies) {
    varies_ = std::move(varies);
  }
  /// Whether an input or a slot of that name was recorded: who records first what a host sets
  /// besides, says so to the bodies that come.
  bool has_leaf(std::string_view name) const;
  /// The slot number (an i32 literal) of the texture that the host knows by `key`.
  Ref texture(std::string_view key);
  /// The index of a constant table, for Op::table. The same name with other numbers is
  /// another table.
  std::uint32_t table(std::string_view name, std::span<const float> values);

  /// Records one operation; see `record` in runtime/value/ref.h.
  Ref emit(Op op, std::span<const Ref> operands, std::uint32_t imm = 0);

  /// x, marked as a place where a material's scatter state may be cut.
  /// Constants and uniform values pass unmarked.
  Ref keep(Ref x);
  /// Whether what is recorded now stands outside all regions and functions, so
  /// that everything after it may use it: where keep() may be called.
  bool at_top_level() const { return open_.size() == 1 && open_.back().regions.size() == 1; }
  /// Number of keeps so far; keep k has imm k.
  std::uint32_t keep_count() const { return keep_count_; }
  /// A number for the function that values are recorded into now; 0 the entry.
  std::uint32_t current_function() const { return open_.back().number; }
  /// True where x, a value of the current function, may be used now: no region
  /// that it was recorded in has ended.
  bool visible(Ref x) const { return in_scope(x.id); }
  /// Of a value of the current function.
  Scalar type_of(Ref x) const { return x.is_constant() ? x.type : current_code()[x.id].type; }
  /// The id of what the current function records next; values of it that were there before
  /// have smaller ones.
  ValueId next_value() const { return static_cast<ValueId>(open_.back().home.size()); }
  /// True for what differs from lane to lane: depends on an input.
  bool is_varying(Ref x) const;
  /// Instructions recorded so far, of all functions, those under construction included.
  std::size_t size() const { return size_; }
  /// The lanes that need what is recorded now, as far as the if_any regions tell that are
  /// open in the current function.
  Ref needed_lanes();

  // -- Regions; use if_any() and loop() of runtime/value/control.h. --

  /// Opens a region for the lanes of `mask`, a b1.
  void begin_if(Ref mask);
  /// In the open if_any region: `inner` in its lanes, `outer` elsewhere, to be used behind it.
  /// After everything else in the region.
  Ref merge(Ref inner, Ref outer);
  /// Another `outer` for a merge that nothing uses yet: a value recorded before its region.
  void set_outer(Ref merge, Ref outer);
  /// Whether x may be used behind the innermost open region, without a merge.
  bool outlives_region(Ref x) const;
  /// Closes the region that begin_if opened last.
  void end_if();
  /// `imm` as of Op::loop: a bound, or one with loop_must_end.
  void begin_loop(Ref mask, std::uint32_t imm);
  /// At the beginning of the open loop: a value that a lane takes from round to round.
  Ref carry(Ref initial);
  /// At the end of the open loop: what a carry becomes; its last value, to be used behind it.
  Ref next(Ref carry, Ref value);
  /// Last in the open loop: lanes where `condition`, a b1, is false go no further.
  void again(Ref condition);
  /// Closes the region that begin_loop opened last.
  void end_loop();

  // -- Outlined functions; use outline() of runtime/value/control.h. --

  /// The function recorded under this key, or nothing.
  std::uint32_t find_function(std::string_view key) const;  ///< 0: none.
  /// Starts a function; its arguments follow by argument(). Values of the
  /// function around it can't be used until end_function().
  void begin_function(std::string key, std::string name, std::span<const Scalar> arguments);
  /// Argument `index` of the function that begin_function started last.
  Ref argument(std::uint32_t index);
  /// Ends it and returns its index in the Program.
  std::uint32_t end_function(std::span<const Ref> results);
  /// Calls it; one value a result.
  std::vector<Ref> call(std::uint32_t function, std::span<const Ref> arguments);

  /// A texture look-up that the host answers: r, g, b, a.
  std::vector<Ref> texture_call(std::span<const Ref> operands, std::uint32_t imm);

  /// Appends a store to output channel `name` at top level of the entry.
  void store(std::string_view name, Ref value);

  /// What was recorded, whole: nothing removed, varying not yet marked. Valid
  /// as a Program only if stores were recorded; see slice.h for entry points.
  const Program& program() const { return program_; }
  /// The same, moved out; the Recorder is of no use afterwards.
  Program take();

  /// The operand as a value id of the current function; literals are recorded.
  ValueId materialize(Ref x);

 private:
  /// The same value by another operation, or by none.
  std::optional<Ref> rephrase(Op op, std::span<const Ref> operands, std::uint32_t imm);

  /// A function under construction and the regions open in it.
  struct Open {
    std::uint32_t number = 0;
    Function function;  ///< Joins the Program when it ends, after what it calls; not the entry.
    std::string key;
    ValueTable values;
    std::vector<bool> varying;           ///< By value id.
    std::vector<std::uint32_t> home;     ///< By value id: the region it stands in.
    std::vector<std::uint32_t> regions;  ///< Regions open, outermost first.
    std::vector<Ref> masks{};            ///< Of those but the first.
    std::uint32_t next_region = 1;
  };

  const std::vector<Instruction>& current_code() const {
    return open_.size() == 1 ? program_.entry().code : open_.back().function.code;
  }
  Function& code() { return open_.size() == 1 ? program_.entry() : open_.back().function; }
  Ref append(Instruction instruction, bool varying);
  Ref append_shared(Instruction instruction, bool varying);
  Ref append_list(Op op, Scalar type, std::span<const Ref> operands, std::uint32_t imm);
  void open_region(Op op, Ref mask, std::uint32_t imm);
  void close_region(Op op);
  bool in_scope(ValueId id) const;

  bool keeps_sign_ = false;
  std::uint32_t origin_ = 0;
  std::unordered_map<std::string, std::uint32_t> origin_numbers_;
  Program program_;
  std::function<bool(std::string_view slot)> varies_;
  std::vector<Open> open_;
  std::uint32_t next_number_ = 1;
  std::unordered_map<std::string, std::uint32_t> function_keys_;
  std::unordered_map<std::string, ValueId> list_keys_;
  std::unordered_map<ValueId, ValueId> keeps_;  ///< By the value kept.
  std::uint32_t keep_count_ = 0;
  std::size_t size_ = 0;
};

}  // namespace nacre
