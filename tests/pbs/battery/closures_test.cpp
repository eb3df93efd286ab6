// T-FUZ: every closure and shader of the libraries with hostile inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "runtime/program/cost.h"
#include "tests/pbs/battery/closure_trial.h"

namespace nacre {
namespace {

/// Of all forms of a row together.
std::size_t count_of_points(const ClosureCase& row, const ClosureWay& way) {
  const std::size_t part = std::getenv("NACRE_TEST_FULL") != nullptr ? 1 : 2;
  const std::size_t count = (row.large ? 20'000 : 100'000) / part;
  return way.asks_all ? count / 4 : count;
}

bool is_closure_or_shader(Type type) {
  return is_closure(type) || (type >= Type::surfaceshader && type <= Type::lightshader);
}

using Names = std::set<std::string, std::less<>>;

Names without(const Names& all, const Names& taken) {
  Names rest;
  std::ranges::set_difference(all, taken, std::inserter(rest, rest.end()));
  return rest;
}

TEST(ClosureCases, HaveEveryClosureOfTheLibraries) {
  Names declared, rows;
  for (const NodeDef* def : closure_system().library().definitions().all()) {
    if (is_closure_or_shader(def->outputs.front().type)) declared.emplace(def->name);
  }
  for (const ClosureCase& row : closure_cases()) {
    EXPECT_TRUE(rows.emplace(row.nodedef).second) << row.nodedef << " twice";
  }
  EXPECT_EQ(without(declared, rows), Names()) << "have no row";
  EXPECT_EQ(without(rows, declared), Names()) << "are not declared";
}

class Closures : public testing::TestWithParam<std::tuple<ClosureCase, ClosureWay>> {};

TEST_P(Closures, AreSaneForAnyBits) {
  const auto& [row, way] = GetParam();
  try_closure(row, way, count_of_points(row, way), 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, Closures,
    testing::Combine(testing::ValuesIn(closure_cases().begin(), closure_cases().end()),
                     testing::Values(ClosureWay{.accuracy = Accuracy::standard},
                                     ClosureWay{.accuracy = Accuracy::fast, .asks_all = true})),
    [](const auto& instance) {
      return short_name(std::get<0>(instance.param)) + "_" + to_string(std::get<1>(instance.param));
    });

/// Of a pass through the dearest kernel of a form. What a closure costs is in `begin`, or in those
/// that go without it.
double most_steps(const ClosureKernels& kernels) {
  double most = 0;
  const auto count = [&](const BoundKernel& kernel) {
    most = std::max(most, function_costs(kernel.program()).front().most);
  };
  if (kernels.values) count(kernels.values->kernel);
  if (kernels.material) {
    const MaterialKernels& m = *kernels.material;
    for (const auto* kernel : {&m.begin, &m.sample, &m.evaluate, &m.albedo, &m.shadow}) {
      if (*kernel) count(**kernel);
    }
  }
  return most;
}

class ClosureSteps : public testing::TestWithParam<ClosureCase> {};

// Else a kernel that has nothing but what the libraries have ends in the middle of a batch.
TEST_P(ClosureSteps, AreAsManyAsAPassMayTake) {
  const ClosureWay way{
      .accuracy = Accuracy::precise, .backend = Backend::interpreter, .asks_all = true};
  for (const std::vector<Setting>& form : GetParam().forms) {
    const ClosureKernels kernels = compile_closure(GetParam(), form, way);
    ASSERT_TRUE(kernels.material || kernels.values) << kernels.diagnostics.to_string();
    EXPECT_LT(most_steps(kernels), static_cast<double>(default_max_steps)) << to_string(form);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ClosureSteps,
                         testing::ValuesIn(closure_cases().begin(), closure_cases().end()),
                         [](const auto& instance) { return short_name(instance.param); });

}  // namespace
}  // namespace nacre
