#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "jit/glsl/record.h"

namespace nacre::glsl {

/// Where the values go that a branch gives beside what it assigns; zero outside its lanes.
struct BranchValues {
  Value* then = nullptr;
  Value* otherwise = nullptr;
};

/// The walk over a syntax tree that records it; the implementation of record.h.
/// Variables live on one stack, so that a branch can note what it changed.
class Recording {
 public:
  explicit Recording(const RecordContext& context);

  CallResult call(const Function& function, std::vector<Value> arguments, Place place);
  Value evaluate(const Expression& expression);
  void bind(std::string_view name, Value value);
  /// Only these lanes need what is recorded.
  void restrict_to(Bool lanes) { mask_ = lanes; }

 private:
  struct Variable {
    std::string_view name;
    Value value;
    bool constant = false;
    std::size_t parts_before = 0;  ///< Scalars of the variables that stand before it.
  };
  using Slot = std::size_t;

  /// Where an assignment goes: scalars of a variable, in the lanes where
  /// `where` holds (several targets for an index that is not literal).
  struct Target {
    struct Parts {
      Bool where;
      std::vector<std::size_t> parts;
    };
    Slot slot = 0;
    Type type;
    std::vector<Parts> alternatives;
  };

  struct Activation {
    const Function* function = nullptr;
    Slot first = 0;     ///< Its variables start here.
    Slot returned = 0;  ///< Flag; the slot after it holds what is returned.
    Slot broke = 0;     ///< Flags of the innermost loop; 0: in none.
    Slot continued = 0;
    int depth = 0;
  };

  /// Counts a level of recursion for as long as it lives: the bytes of its frame, about.
  class Level {
   public:
    Level(Recording& recording, Place place, int bytes) : recording_(recording), bytes_(bytes) {
      recording.enter(place, bytes);
    }
    ~Level() { recording_.stack_ -= bytes_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Recording& recording_;
    int bytes_;
  };

  // Expressions (record_expression.cpp). Those that get `left` go on from the value of
  // operands[0].
  Value leaf(const Expression& expression);
  Value apply(const Expression& expression, Value left);
  Value name(const Expression& expression);
  static Value uniform_sampler(const Statement::Variable& global);
  Value member(const Expression& expression, const Value& whole) const;
  Value index(const Expression& expression, const Value& whole);
  Value element(const Value& whole, const Value& index, Place place);
  Value construct(const Expression& expression);
  Value construct_plain(const Expression& expression, const std::vector<Value>& arguments);
  Value construct_matrix(const Type& type, const Value& argument) const;
  Value unary_value(const Expression& expression, const Value& operand) const;
  Value binary_value(const Expression& expression, const Value& left);
  Value look_ahead(const Expression& expression, const Value& left);
  Value assign(const Expression& expression);
  Value step(const Expression& expression, bool value_before);
  Value conditional(const Expression& expression, const Value& condition);
  Value call_named(const Expression& expression);
  Value call_texture(const Expression& expression, const std::vector<Value>& arguments);
  Value initial_value(const Expression& expression, const Type& type);
  const Function* select_overload(const Expression& expression,
                                  const std::vector<Value>& arguments);
  Target target(const Expression& expression);
  Target target_variable(const Expression& expression);
  Target target_member(const Expression& expression, Target whole) const;
  Target target_index(const Expression& expression, const Target& whole);
  Value read(const Target& target) const;
  void write(const Target& target, const Value& value);
  Value expect(const Value& value, const Type& type, Place place);

  // Statements (record_statement.cpp).
  void execute(const Statement& statement);
  void execute_list(const Statement& block, std::size_t from);
  void declare(const Statement& statement);
  void if_statement(const Statement& statement);
  void loop_statement(const Statement& statement);
  void do_loop(const Statement& statement);
  void return_statement(const Statement& statement);
  std::optional<int> literal_trips(const Statement& statement);
  void unroll(const Statement& statement, int trips);
  /// `rounds`: how many there are, if that is known.
  void iterate(const Statement& loop, const Statement& body, std::optional<int> rounds = {});
  void run_body(const Statement& body);
  Bool loop_condition(const Expression* condition);
  Bool running();

  // Control flow (recording.cpp).
  template <class Then, class Otherwise>
  void branch(Bool condition, Place place, Then&& then, Otherwise&& otherwise,
              BranchValues values = {});
  using Parts = std::vector<std::vector<Ref>>;  ///< Of all variables.
  template <class Body>
  void region(Bool where, const Parts& before, const Parts& outside, Body&& body, Value* result);
  template <class Body>
  void scoped(Body&& body);
  Parts snapshot(Place place);
  void restore(const Parts& parts);
  static bool is_same(Ref a, Ref b) { return a.recorder == b.recorder && a.id == b.id; }

  // Calls (recording.cpp).
  CallResult call_inline(const Function& function, std::vector<Value> arguments);
  CallResult call_outlined(const Function& function, const std::vector<Value>& arguments);

  Slot push(std::string_view name, Value value, bool constant = false);
  Variable* find(std::string_view name);
  Activation& activation() { return activations_.back(); }
  [[noreturn, gnu::noinline]] void error(Place place, std::string code, std::string message,
                                         std::string expected = {}, std::string found = {}) const;
  void count_steps(std::size_t steps, Place place);
  void enter(Place place, int bytes);

  const RecordContext& context_;
  std::vector<Variable> variables_;
  std::vector<Activation> activations_;
  std::vector<const Function*> calling_;
  std::vector<std::string_view> reading_globals_;
  std::size_t steps_ = 0;
  std::size_t next_look_ = 0;  ///< Steps at which the deadline is looked at.
  int stack_ = 0;              ///< Bytes: see RecordLimits::stack_bytes.
  Slot base_ = 0;              ///< Variables below are of the function around an outlined one.
  Bool mask_ = true;           ///< Lanes for which the current branch is taken.
};

/// Runs `body` and drops the variables that it declared.
template <class Body>
void Recording::scoped(Body&& body) {
  const Slot size = variables_.size();
  body();
  variables_.resize(size);
}

/// Records both sides as regions, each seeing the variables as they are now, and gives
/// every variable the value of the side that a lane takes.
template <class Then, class Otherwise>
void Recording::branch(Bool condition, Place place, Then&& then, Otherwise&& otherwise,
                       BranchValues values) {
  if (condition.is_constant(true)) return scoped(then);
  if (condition.is_constant(false)) return scoped(otherwise);
  const Bool mask = mask_;
  const auto before = snapshot(place);
  mask_ = mask & condition;
  region(condition, before, before, then, values.then);
  const auto after = snapshot(place);
  restore(before);
  mask_ = mask & !condition;
  region(!condition, before, after, otherwise, values.otherwise);
  mask_ = mask;
}

template <class Body>
void Recording::region(Bool where, const Parts& before, const Parts& outside, Body&& body,
                       Value* result) {
  Recorder& recorder = context_.recorder;
  recorder.begin_if(where.ref());
  scoped(body);
  for (std::size_t i = 0; i < before.size(); ++i) {
    std::vector<Ref>& parts = variables_[base_ + i].value.parts;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const bool changed = !is_same(parts[k], before[i][k]);
      parts[k] = changed ? recorder.merge(parts[k], outside[i][k]) : outside[i][k];
    }
  }
  if (result != nullptr) {
    for (Ref& part : result->parts) {
      if (!part.is_constant()) part = recorder.merge(part, {nullptr, 0, part.type});
    }
  }
  recorder.end_if();
}

}  // namespace nacre::glsl
