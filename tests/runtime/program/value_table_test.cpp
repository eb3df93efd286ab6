#include "runtime/program/value_table.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>
#include <vector>

#include "tests/support/random.h"

namespace nacre {
namespace {

Instruction add(ValueId a, ValueId b) {
  return {.op = Op::add, .type = Scalar::f32, .count = 2, .operands = {a, b, no_value}};
}

/// Against maps, one a scope, over many random additions, scopes and questions.
TEST(ValueTable, FindsWhatIsInScope) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    ValueTable table;
    Function function;
    std::vector<std::map<std::pair<ValueId, ValueId>, ValueId>> scopes(1);
    const auto expected = [&](std::pair<ValueId, ValueId> key) {
      for (const auto& scope : scopes) {
        if (const auto found = scope.find(key); found != scope.end()) return found->second;
      }
      return no_value;
    };
    for (int step = 0; step < 3000; ++step) {
      const std::pair<ValueId, ValueId> key{random.below(40), random.below(40)};
      const Instruction instruction = add(key.first, key.second);
      ASSERT_EQ(table.find(function, instruction), expected(key)) << "seed " << seed;
      switch (random.below(16)) {
        case 0:
          table.open_scope();
          scopes.emplace_back();
          break;
        case 1:
          if (scopes.size() == 1) break;
          table.close_scope();
          scopes.pop_back();
          break;
        default:
          if (expected(key) != no_value) break;
          const auto id = static_cast<ValueId>(function.code.size());
          function.code.push_back(instruction);
          table.add(function, id);
          scopes.back()[key] = id;
          break;
      }
    }
  }
}

/// What an instruction was recorded for makes it no other.
TEST(ValueTable, OriginsDoNotCount) {
  ValueTable table;
  Function function;
  function.code.push_back(add(1, 2));
  table.add(function, 0);
  Instruction other = add(1, 2);
  other.origin = 7;
  EXPECT_EQ(table.find(function, other), 0u);
}

}  // namespace
}  // namespace nacre
