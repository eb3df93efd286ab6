// What one call costs, of one point and of none: by a binding, with code for single points, and by
// the code itself. standard_surface with every number a live parameter, evaluated.
#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <nacre/code.hpp>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "bench/hosts/points.h"

namespace nacre::bench {

namespace {

const Shader& shader(bool single) {
  const auto made = [](bool with_single) {
    CompileOptions options;
    options.live = {"*"};
    options.single_points = with_single;
    return host_system().compile_material(
        Document::read(std::string(NACRE_BENCH_DOCUMENTS) + "/standard_surface.mtlx"),
        "standard_surface", options);
  };
  static const Shader wide = made(false);
  static const Shader both = made(true);
  return single ? both : wide;
}

/// f and pdf of the first point.
std::array<float, 4> first_result(const Points& points) {
  return {points.result(0, 0), points.result(0, 1), points.result(0, 2), points.result(0, 6)};
}

void begin(const Binding& binding, Points& points) {
  Batch whole;
  whole.count = all;
  binding.run(NACRE_BEGIN, points.arrays(), whole);
}

std::array<float, 4> expected() {
  Points points(false);
  const Binding binding = points.bind(shader(false));
  begin(binding, points);
  Batch whole;
  whole.count = all;
  binding.run(NACRE_EVALUATE, points.arrays(), whole);
  return first_result(points);
}

void by_binding(benchmark::State& state, bool single, std::uint64_t count,
                bool with_instance = false) {
  Points points(false);
  const Binding binding = points.bind(shader(single));
  begin(binding, points);
  const std::vector<void*> arrays = points.arrays();
  const Instance values(shader(single));
  const Instance* const instance = with_instance ? &values : nullptr;
  Batch batch;
  batch.count = 1;
  binding.run(NACRE_EVALUATE, arrays, batch, instance);
  if (first_result(points) != expected()) return state.SkipWithError("another result");
  batch.count = count;
  for (auto _ : state) binding.run(NACRE_EVALUATE, arrays, batch, instance);
  state.SetItemsProcessed(state.iterations());
}

void by_code(benchmark::State& state, std::uint64_t count) {
  Points points(false);
  begin(points.bind(shader(true)), points);
  std::vector<const void*> inputs;
  std::vector<void*> outputs;
  for (const Channel& channel : shader(true).inputs(NACRE_EVALUATE)) {
    inputs.push_back(points.column(channel));
  }
  for (const Channel& channel : shader(true).results(NACRE_EVALUATE)) {
    outputs.push_back(points.column(channel));
  }
  const Code code(shader(true), NACRE_EVALUATE, nullptr, true);
  const FloatEnvironment environment;
  code(inputs.data(), outputs.data(), 1);
  if (first_result(points) != expected()) return state.SkipWithError("another result");
  for (auto _ : state) {
    benchmark::DoNotOptimize(code(inputs.data(), outputs.data(), count));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations());
}

}  // namespace

void register_calls() {
  const auto add = [](const char* name, auto&& run) {
    benchmark::RegisterBenchmark((std::string("hosts/call/") + name).c_str(), run);
  };
  add("wide", [](benchmark::State& state) { by_binding(state, false, 1); });
  add("single", [](benchmark::State& state) { by_binding(state, true, 1); });
  add("code", [](benchmark::State& state) { by_code(state, 1); });
  add("empty", [](benchmark::State& state) { by_binding(state, false, 0); });
  add("empty_of_instance", [](benchmark::State& state) { by_binding(state, false, 0, true); });
  add("empty_code", [](benchmark::State& state) { by_code(state, 0); });
}

}  // namespace nacre::bench
