// What a Program is taken to cost.
#include "jit/tune/estimate.h"

#include <gtest/gtest.h>

#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"

namespace nacre {
namespace {

template <class Body>
double cost_of(Body&& body) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const std::vector<SliceOutput> outputs{{"out", body(recorder, x).ref()}};
  return estimated_cost(slice(recorder.program(), "k", outputs));
}

double cost_of_nothing() {
  return cost_of([](Recorder&, Float x) { return x; });
}

TEST(TuneEstimate, IsMoreOfWhatTakesLonger) {
  const double none = cost_of_nothing();
  const double sum = cost_of([](Recorder&, Float x) { return x + x; });
  const double quotient = cost_of([](Recorder&, Float x) { return 1.0f / x; });
  EXPECT_EQ(sum, none + 1);
  EXPECT_GT(quotient, sum);
}

TEST(TuneEstimate, CountsAFunctionAsOftenAsItIsCalled) {
  const auto chain = [](int calls) {
    return cost_of([&](Recorder& recorder, Float x) {
      for (int i = 0; i < calls; ++i) {
        x = outline<Float>(recorder, "f", [](Float a) { return a * a + 1.0f; }, x);
      }
      return x;
    });
  };
  EXPECT_EQ(chain(3) - chain(2), chain(2) - chain(1));
  EXPECT_GT(chain(2), chain(1));
}

TEST(TuneEstimate, TakesARegionAsEntered) {
  const double without = cost_of([](Recorder&, Float x) { return x * x; });
  const double within = cost_of(
      [](Recorder&, Float x) { return if_any(x < 0.5f, x, [&] { return x * x * x * x * x; }); });
  EXPECT_GT(within, without);
}

}  // namespace
}  // namespace nacre
