#include "runtime/batch/run_bound.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include "runtime/interpreter/interpreter.h"
#include "runtime/node/geometry.h"
#include "runtime/program/slice.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

/// f = (P.x * uv0.x + P.y, P.z - color0.w), and which of them is larger.
Program small_surface() {
  Recorder recorder;
  const Float3 p = position(recorder, Space::world);
  const Float u = texcoord(recorder, 0).x;
  const Float alpha(channel(recorder, "color0", 3));
  const Float x = p.x * u + p.y;
  const Float y = p.z - alpha;
  const std::vector<SliceOutput> outputs{
      {"f.x", x.ref()}, {"f.y", y.ref()}, {"larger", select(x > y, Int(0), Int(1)).ref()}};
  return slice(recorder.program(), "test", outputs);
}

RunArrays on(const Kernel& kernel) {
  return [&](const void* const* inputs, void* const* outputs, std::uint64_t count) {
    return kernel.run({.inputs = inputs, .outputs = outputs, .count = count});
  };
}

constexpr std::size_t points = 1333;

/// One number for every component of every point, instance tables apart.
struct Numbers {
  std::vector<float> px, py, pz, u, alpha;
  Numbers() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> number(-2.0f, 2.0f);
    for (auto* column : {&px, &py, &pz, &u, &alpha}) {
      for (std::size_t i = 0; i < points; ++i) column->push_back(number(random));
    }
  }
};

struct Result {
  std::vector<float> x = std::vector<float>(points, 99.0f);
  std::vector<float> y = std::vector<float>(points, 99.0f);
  std::vector<std::int32_t> larger = std::vector<std::int32_t>(points, 99);
  bool operator==(const Result&) const = default;
};

/// The rows of all points by plain arrays, which the kernel takes as they are.
Result plain(const Kernel& kernel, const Numbers& n) {
  Result result;
  std::vector<const void*> inputs;
  for (const Channel& channel : kernel.program().inputs) {
    inputs.push_back(channel.name == "P.x"     ? n.px.data()
                     : channel.name == "P.y"   ? n.py.data()
                     : channel.name == "P.z"   ? n.pz.data()
                     : channel.name == "uv0.x" ? n.u.data()
                                               : n.alpha.data());
  }
  const std::vector<void*> outputs{result.x.data(), result.y.data(), result.larger.data()};
  EXPECT_EQ(kernel.run({.inputs = inputs.data(), .outputs = outputs.data(), .count = points}),
            RunStatus::done);
  return result;
}

class RunBound : public testing::Test {
 protected:
  std::unique_ptr<Kernel> kernel = make_interpreter(small_surface());
  Numbers numbers;
  Diagnostics diagnostics;

  Binding finish(const Binder& binder) {
    const auto binding = binder.finish(kernel->program(), {}, diagnostics);
    EXPECT_TRUE(binding) << diagnostics.to_string();
    return binding.value_or(Binding{});
  }
};

TEST_F(RunBound, TakesPointsAsStructuresTablesOfInstancesAndConstants) {
  struct Point {
    float p[3];
    double other;
    float uv[2];
  };
  std::vector<Point> structures(points);
  std::vector<std::uint32_t> instance(points);
  const std::vector<float> alphas{0.25f, -1.5f, 0.75f};
  for (std::size_t i = 0; i < points; ++i) {
    structures[i] = {{numbers.px[i], numbers.py[i], numbers.pz[i]}, 0.0, {numbers.u[i], 0.0f}};
    instance[i] = static_cast<std::uint32_t>(i * i % 3);
    numbers.alpha[i] = alphas[instance[i]];
  }
  const Result expected = plain(*kernel, numbers);
  Binder binder;
  binder.bind("P", {.array = 0, .stride = sizeof(Point)});
  binder.bind("uv0", {.array = 0, .offset = offsetof(Point, uv), .stride = sizeof(Point)});
  binder.bind("color0.w", {.array = 1, .element = ElementOf::instance});
  binder.bind("f.x", {.array = 2});
  binder.bind("f.y", {.array = 3});
  binder.bind("larger", {.array = 4});
  const Binding binding = finish(binder);
  Result found;
  const std::vector<void*> arrays{structures.data(), const_cast<float*>(alphas.data()),
                                  found.x.data(), found.y.data(), found.larger.data()};
  const Batch batch{.arrays = arrays, .count = points, .instances = instance.data()};
  ASSERT_EQ(run_bound(binding, batch, on(*kernel)), RunStatus::done);
  EXPECT_EQ(found, expected);
}

TEST_F(RunBound, ShadesTheListedPointsAndLeavesTheOthersAlone) {
  const Result all = plain(*kernel, numbers);
  Result expected;
  std::vector<std::uint32_t> list;
  std::mt19937 random(3);
  for (std::uint32_t i = 0; i < points; ++i) {
    if (random() % 2 == 0) continue;
    list.push_back(i);
    expected.x[i] = all.x[i];
    expected.larger[i] = all.larger[i];
  }
  Binder binder;
  for (std::uint32_t k = 0; k < 5; ++k) {
    binder.bind(std::array{"P.x", "P.y", "P.z", "uv0", "color0.w"}[k], {.array = k});
  }
  binder.bind("f.x", {.array = 5});
  binder.bind("f.y", {.array = 6, .element = ElementOf::place});
  binder.bind("larger", {.array = 7});
  const Binding binding = finish(binder);
  Result found;
  const std::vector<void*> arrays{numbers.px.data(), numbers.py.data(),    numbers.pz.data(),
                                  numbers.u.data(),  numbers.alpha.data(), found.x.data(),
                                  found.y.data(),    found.larger.data()};
  const Batch batch{.arrays = arrays, .count = list.size(), .points = list.data()};
  ASSERT_EQ(run_bound(binding, batch, on(*kernel)), RunStatus::done);
  // What is bound by place is as long as the list.
  for (std::size_t i = 0; i < list.size(); ++i) expected.y[i] = all.y[list[i]];
  EXPECT_EQ(found, expected);
}

TEST_F(RunBound, CopiesOnceWhatIsBoundAlikeAndStillTellsApartWhatIsNot) {
  numbers.py = numbers.px;
  numbers.alpha = numbers.u;
  Binder binder;
  binder.bind("P.x", {.array = 0});
  binder.bind("P.y", {.array = 0});
  binder.bind("P.z", {.array = 0, .element = ElementOf::place});  // Alike but for that.
  binder.bind("uv0", {.array = 1});
  binder.bind("color0.w", {.array = 1});
  binder.bind("f.x", {.array = 2});
  binder.bind("f.y", {.array = 3});
  binder.bind("larger", {.array = 4});
  const Binding binding = finish(binder);
  EXPECT_EQ(binding.copies_of_list, 2 + 3);
  std::vector<std::uint32_t> list(points);
  for (std::uint32_t i = 0; i < points; ++i) list[i] = static_cast<std::uint32_t>(points) - 1 - i;
  Numbers by_place = numbers;
  for (std::size_t i = 0; i < points; ++i) by_place.pz[list[i]] = numbers.px[i];
  const Result listed = plain(*kernel, by_place);
  Result found;
  const std::vector<void*> arrays{numbers.px.data(), numbers.u.data(), found.x.data(),
                                  found.y.data(), found.larger.data()};
  const Batch batch{.arrays = arrays, .count = points, .points = list.data()};
  ASSERT_EQ(run_bound(binding, batch, on(*kernel)), RunStatus::done);
  EXPECT_EQ(found, listed);
}

TEST_F(RunBound, HandsPlainArraysOverWhereTheyAre) {
  Binder binder;
  binder.bind("P", {.array = 0}, 4 * static_cast<std::ptrdiff_t>(points));
  binder.bind("uv0", {.array = 1});
  binder.bind("color0.w", {.array = 1});
  binder.bind("f", {.array = 2}, 4 * static_cast<std::ptrdiff_t>(points));
  binder.bind("larger", {.array = 3});
  const Binding binding = finish(binder);
  std::vector<float> p(3 * points, 1.0f);
  std::vector<float> f(2 * points);
  std::vector<std::int32_t> larger(points);
  const std::vector<void*> arrays{p.data(), numbers.u.data(), f.data(), larger.data()};
  int calls = 0;
  const RunArrays look = [&](const void* const* inputs, void* const* outputs, std::uint64_t count) {
    ++calls;
    EXPECT_EQ(count, points);
    EXPECT_EQ(inputs[0], p.data());
    EXPECT_EQ(outputs[1], f.data() + points);
    return RunStatus::done;
  };
  EXPECT_EQ(run_bound(binding, {.arrays = arrays, .count = points}, look), RunStatus::done);
  EXPECT_EQ(calls, 1);
}

TEST_F(RunBound, ConstantsAreOfAllPointsAndWhatNobodyWantsIsDiscarded) {
  numbers.px.assign(points, 0.5f);
  numbers.py.assign(points, -1.0f);
  numbers.pz.assign(points, 0.0f);
  const Result expected = plain(*kernel, numbers);
  Binder binder;
  const std::array<std::uint32_t, 2> p{std::bit_cast<std::uint32_t>(0.5f),
                                       std::bit_cast<std::uint32_t>(-1.0f)};
  binder.bind_constant("P", p);
  binder.bind("uv0", {.array = 0});
  binder.bind("color0.w", {.array = 1});
  binder.bind("larger", {.array = 2});
  const Binding binding = finish(binder);
  Result found;
  const std::vector<void*> arrays{numbers.u.data(), numbers.alpha.data(), found.larger.data()};
  ASSERT_EQ(run_bound(binding, {.arrays = arrays, .count = points}, on(*kernel)), RunStatus::done);
  EXPECT_EQ(found.larger, expected.larger);
}

TEST_F(RunBound, SaysWhatIsBoundToNothing) {
  Binder binder;
  binder.bind("P", {.array = 0}, 4);
  binder.bind("color0.w", {.array = 0});
  binder.bind("UV0", {.array = 0}, 4);
  EXPECT_FALSE(binder.finish(kernel->program(), {}, diagnostics));
  ASSERT_EQ(diagnostics.error_count(), 1u) << diagnostics.to_string();
  const Diagnostic& said = diagnostics.all().front();
  EXPECT_EQ(said.code, "unbound-channel");
  EXPECT_NE(said.message.find("uv0.x"), std::string::npos) << said.message;
  EXPECT_NE(said.expected.find("texture coordinates"), std::string::npos) << said.expected;
  EXPECT_EQ(said.hint, "it differs only in case from 'UV0'");
}

TEST_F(RunBound, RefusesBatchesThatLackArraysOrInstances) {
  Binder binder;
  for (const char* name : {"P", "uv0", "color0"}) {
    binder.bind(name, {.array = 3, .element = ElementOf::instance});
  }
  const Binding binding = finish(binder);
  const std::vector<void*> arrays(4, numbers.px.data());
  const std::vector<std::uint32_t> instances(points, 0);
  const auto status = [&](std::size_t count, const std::uint32_t* list) {
    return run_bound(binding,
                     {.arrays = std::span(arrays).first(count), .count = 4, .instances = list},
                     on(*kernel));
  };
  EXPECT_EQ(status(4, instances.data()), RunStatus::done);
  EXPECT_EQ(status(3, instances.data()), RunStatus::wrong_arguments);
  EXPECT_EQ(status(4, nullptr), RunStatus::wrong_arguments);
}

}  // namespace
}  // namespace nacre
