// What a Program is taken to cost.
#include "jit/tune/estimate.h"

#include <gtest/gtest.h>

#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"

namespace nacre {
namespace {

/// Of a function of x, at some values of x.
template <class Body>
double cost_of(std::vector<float> x, Body&& body) {
  Recorder recorder;
  const Float in(recorder.input("x", Scalar::f32));
  const std::vector<SliceOutput> outputs{{"out", body(recorder, in).ref()}};
  const CountingKernel kernel(slice(recorder.program(), "k", outputs));
  std::vector<float> out(x.size());
  const void* const inputs[]{x.data()};
  void* const results[]{out.data()};
  KernelArguments arguments;
  arguments.inputs = inputs;
  arguments.outputs = results;
  arguments.count = x.size();
  EXPECT_EQ(kernel.run(arguments), RunStatus::done);
  return kernel.cost();
}

TEST(TuneEstimate, IsMoreOfWhatTakesLonger) {
  const double none = cost_of({1}, [](Recorder&, Float x) { return x; });
  const double sum = cost_of({1}, [](Recorder&, Float x) { return x + x; });
  const double quotient = cost_of({1}, [](Recorder&, Float x) { return 1.0f / x; });
  EXPECT_EQ(sum, none + 1);
  EXPECT_GT(quotient, sum);
}

TEST(TuneEstimate, CountsRoundsAsOftenAsTheyAreDone) {
  const auto cost = [](int rounds) {
    return cost_of({1}, [&](Recorder& recorder, Float x) {
      return loop(recorder, Bool(true), 100, x, [&](Int i, Float& sum) {
        sum = sum * x + 1.0f;
        return i + Int(1) < Int(rounds);
      });
    });
  };
  EXPECT_EQ(cost(30) - cost(20), cost(20) - cost(10));
  EXPECT_GT(cost(20), cost(10));
}

TEST(TuneEstimate, CountsARegionWhereAPointEntersIt) {
  const auto body = [](Recorder&, Float x) {
    return if_any(x < 0.5f, x, [&] { return x * x * x * x * x; });
  };
  EXPECT_GT(cost_of({0}, body), cost_of({1}, body));
  EXPECT_EQ(cost_of({0, 1}, body), 0.5 * (cost_of({0}, body) + cost_of({1}, body)));
}

}  // namespace
}  // namespace nacre
