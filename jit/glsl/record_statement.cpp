#include <fmt/format.h>

#include <algorithm>

#include "jit/glsl/recording.h"

namespace nacre::glsl {

namespace {

constexpr int max_unrolled_trips = 64;
constexpr int max_unrolled_cost = 8192;

bool is_worth_unrolling(int trips, const Statement& body) {
  return trips <= max_unrolled_trips && (trips <= 4 || trips * body.cost <= max_unrolled_cost);
}

}  // namespace

/// The lanes that neither returned nor left the loop that is being recorded.
Bool Recording::running() {
  Bool left = variables_[activation().returned].value.truth(0);
  if (activation().broke != 0) left = left | variables_[activation().broke].value.truth(0);
  if (activation().continued != 0) left = left | variables_[activation().continued].value.truth(0);
  return !left;
}

void Recording::execute(const Statement& statement) {
  const Level level(*this, statement.place, 250);
  switch (statement.kind) {
    case Statement::Kind::block: scoped([&] { execute_list(statement, 0); }); break;
    case Statement::Kind::declare: declare(statement); break;
    case Statement::Kind::expression: evaluate(*statement.condition); break;
    case Statement::Kind::if_: if_statement(statement); break;
    case Statement::Kind::loop: scoped([&] { loop_statement(statement); }); break;
    case Statement::Kind::do_loop: do_loop(statement); break;
    case Statement::Kind::return_: return_statement(statement); break;
    case Statement::Kind::break_: variables_[activation().broke].value = make(Bool(true)); break;
    case Statement::Kind::continue_:
      variables_[activation().continued].value = make(Bool(true));
      break;
  }
}

/// After a statement that some lanes may leave by, the rest is a branch.
void Recording::execute_list(const Statement& block, std::size_t from) {
  const Level level(*this, block.place, 500);
  for (std::size_t i = from; i < block.body.size(); ++i) {
    execute(*block.body[i]);
    if (!block.body[i]->may_leave) continue;
    const Bool go_on = running();
    if (go_on.is_constant(true)) continue;
    if (go_on.is_constant(false) || i + 1 == block.body.size()) return;
    branch(go_on, block.body[i + 1]->place, [&] { execute_list(block, i + 1); }, [] {});
    return;
  }
}

void Recording::declare(const Statement& statement) {
  const Level level(*this, statement.place, 350);
  for (const Statement::Variable& variable : statement.variables) {
    if (variable.type.length < 0 && !variable.initial) {
      error(variable.place, "glsl-array-size", "the size of an array must be given");
    }
    count_steps(1, variable.place);
    Value value;
    if (variable.initial) {
      value = initial_value(*variable.initial, variable.type);
    } else {
      value = zero(variable.type);
    }
    push(variable.name, std::move(value), variable.constant);
  }
}

void Recording::if_statement(const Statement& statement) {
  const Level level(*this, statement.place, 600);
  const Value condition = expect(evaluate(*statement.condition), bool_type, statement.place);
  branch(
      condition.truth(0), statement.place, [&] { execute(*statement.body[0]); },
      [&] {
        if (statement.body.size() > 1) execute(*statement.body[1]);
      });
}

void Recording::return_statement(const Statement& statement) {
  const Level level(*this, statement.place, 250);
  const Type type = activation().function != nullptr ? activation().function->type : void_type;
  if (statement.condition) {
    Value value = expect(evaluate(*statement.condition), type, statement.place);
    variables_[activation().returned + 1].value = std::move(value);
  }
  variables_[activation().returned].value = make(Bool(true));
}

Bool Recording::loop_condition(const Expression* condition) {
  if (condition == nullptr) return true;
  return expect(evaluate(*condition), bool_type, condition->place).truth(0);
}

/// One pass through a body, its `continue`s ended at its end.
void Recording::run_body(const Statement& body) {
  variables_[activation().continued].value = make(Bool(false));
  scoped([&] { execute(body); });
  variables_[activation().continued].value = make(Bool(false));
}

void Recording::loop_statement(const Statement& statement) {
  const Level level(*this, statement.place, 400);
  if (statement.body[0]) execute(*statement.body[0]);
  const Slot outer_broke = activation().broke;
  const Slot outer_continued = activation().continued;
  const Slot broke = push("", make(Bool(false)));
  push("", make(Bool(false)));
  activation().broke = broke;
  activation().continued = broke + 1;
  const std::optional<int> trips = literal_trips(statement);
  if (trips && is_worth_unrolling(*trips, *statement.body[1])) {
    unroll(statement, *trips);
  } else {
    iterate(statement, *statement.body[1], trips);
  }
  activation().broke = outer_broke;
  activation().continued = outer_continued;
}

/// How often a loop runs whose condition is literal throughout, if nothing leaves it before;
/// nothing also for more rounds than a loop may have.
std::optional<int> Recording::literal_trips(const Statement& statement) {
  if (!statement.condition || !statement.step) return std::nullopt;
  // What the condition reads must not be changed by the body.
  std::vector<const Expression*> pending{statement.condition.get(), statement.step.get()};
  while (!pending.empty()) {
    const Expression* at = pending.back();
    pending.pop_back();
    if (at->kind == Expression::Kind::name && statement.body[1]->assigned.contains(at->text)) {
      return std::nullopt;
    }
    if (at->kind == Expression::Kind::call) return std::nullopt;
    for (const ExpressionPtr& operand : at->operands) pending.push_back(operand.get());
  }
  const auto before = snapshot(statement.place);
  int trips = 0;
  Bool go_on = loop_condition(statement.condition.get());
  const std::size_t size = context_.recorder.size();
  // A step that leaves operations is not literal, whatever the condition is.
  const auto may_be_literal = [&] {
    return trips <= max_unrolled_trips || context_.recorder.size() == size;
  };
  while (go_on.is_constant(true) && trips < context_.limits.loop_iterations && may_be_literal()) {
    ++trips;
    evaluate(*statement.step);
    go_on = loop_condition(statement.condition.get());
  }
  restore(before);
  return go_on.is_constant(false) ? std::optional(trips) : std::nullopt;
}

void Recording::unroll(const Statement& statement, int trips) {
  const Level level(*this, statement.place, 650);
  const Statement& body = *statement.body[1];
  // A counter that ends with the loop may go on in lanes that left, and so
  // stays literal.
  const bool own_counter = statement.body[0] && statement.body[0]->kind == Statement::Kind::declare;
  for (int i = 0; i < trips; ++i) {
    const Bool go_on = running();
    if (go_on.is_constant(false)) return;
    branch(go_on, body.place, [&] { run_body(body); }, [] {});
    branch(
        own_counter ? Bool(true) : running(), statement.place, [&] { evaluate(*statement.step); },
        [] {});
  }
}

/// Records a loop: every variable that it may assign is carried.
void Recording::iterate(const Statement& loop, const Statement& body, std::optional<int> rounds) {
  const Level level(*this, loop.place, 850);
  Recorder& recorder = context_.recorder;
  const Bool active = mask_ & running() & loop_condition(loop.condition.get());
  if (active.is_constant(false)) return;
  std::vector<Slot> carried;
  for (Slot i = activation().first; i < variables_.size(); ++i) {
    if (loop.assigned.contains(variables_[i].name)) carried.push_back(i);
  }
  carried.push_back(activation().returned);
  carried.push_back(activation().returned + 1);

  const Bool mask = mask_;
  const auto most = static_cast<std::uint32_t>(context_.limits.loop_iterations);
  // Too many rounds of a loop that says how many it has cannot be.
  recorder.begin_loop(active.ref(),
                      rounds ? static_cast<std::uint32_t>(*rounds) : most | loop_must_end);
  std::vector<std::vector<Ref>> carries;
  for (const Slot slot : carried) {
    std::vector<Ref>& made = carries.emplace_back();
    for (Ref& part : variables_[slot].value.parts) {
      part = recorder.carry(part);
      made.push_back(part);
    }
  }
  // Which lanes are still here, for loops inside: in the others they might never end.
  const bool has_inner = body.has_loop || (loop.condition && loop.condition->has_loop) ||
                         (loop.step && loop.step->has_loop);
  const Ref here = has_inner ? recorder.carry(active.ref()) : Ref::literal(true);
  mask_ = Bool(here);
  // Lanes that returned or left are not here.
  variables_[activation().returned].value = make(Bool(false));
  variables_[activation().broke].value = make(Bool(false));
  run_body(body);
  const Bool stays = running();
  Bool go_on = stays;
  if (!stays.is_constant(false)) {
    branch(
        stays, loop.place,
        [&] {
          if (loop.step) evaluate(*loop.step);
        },
        [] {});
    go_on = go_on & loop_condition(loop.condition.get());
  }
  std::vector<std::vector<Ref>> finals;
  for (std::size_t i = 0; i < carried.size(); ++i) {
    std::vector<Ref>& made = finals.emplace_back();
    const std::vector<Ref>& parts = variables_[carried[i]].value.parts;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      made.push_back(recorder.next(carries[i][k], parts[k]));
    }
  }
  if (has_inner) recorder.next(here, go_on.ref());
  recorder.again(go_on.ref());
  recorder.end_loop();
  for (std::size_t i = 0; i < carried.size(); ++i) {
    variables_[carried[i]].value.parts = finals[i];
  }
  variables_[activation().broke].value = make(Bool(false));
  variables_[activation().continued].value = make(Bool(false));
  mask_ = mask;
}

/// do body while (condition): the body once, then a loop of it.
void Recording::do_loop(const Statement& statement) {
  const Level level(*this, statement.place, 450);
  const Slot outer_broke = activation().broke;
  const Slot outer_continued = activation().continued;
  scoped([&] {
    const Slot broke = push("", make(Bool(false)));
    push("", make(Bool(false)));
    activation().broke = broke;
    activation().continued = broke + 1;
    run_body(*statement.body[0]);
    branch(running(), statement.place, [&] { iterate(statement, *statement.body[0]); }, [] {});
  });
  activation().broke = outer_broke;
  activation().continued = outer_continued;
}

}  // namespace nacre::glsl
