// What bench_python.py asks, asked from C++: one call of a bound kernel, in nanoseconds.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

namespace nacre::bench {

/// See bench/common/benchmarks.h, which a host does not know.
void register_benchmarks();

namespace {

/// As in bench_python.py: an output, and what it reads of a point.
struct Case {
  const char* name;
  const char* document;
  const char* output;
  const char* input;
  std::ptrdiff_t inputs, outputs;  ///< Numbers a point.
};
constexpr Case cases[] = {
    {"twice", NACRE_BENCH_DOCUMENTS "/twice.mtlx", "out", "uv0", 2, 2},
    {"marble", NACRE_EXAMPLE_DOCUMENTS "/marble.mtlx", "NG_marble/base_color", "Po", 3, 3}};

/// The results of `count` points by a binding of the case, an array a group.
struct Points {
  Points(const Case& of, std::size_t count)
      : input(of.inputs * count), output(of.outputs * count), arrays{input.data(), output.data()} {
    for (std::size_t i = 0; i < input.size(); ++i) {
      input[i] = static_cast<float>(i * 37 % 1024) / 1024;
    }
    batch.count = count;
  }
  Points(const Points&) = delete;
  Points& operator=(const Points&) = delete;

  std::vector<float> input, output;
  std::vector<void*> arrays;
  Batch batch;
};

Binding bind(const Case& of, int engine) {
  static System system;
  CompileOptions options;
  options.engine = engine;
  options.no_footprints = true;
  const Shader shader = system.compile_outputs(Document::read(of.document), {of.output}, options);
  Binder binder;
  binder.array(of.input, {0, 0, 4 * of.inputs}).array(of.output, {1, 0, 4 * of.outputs});
  return Binding(binder, shader);
}

void run(benchmark::State& state, const Case& of, std::size_t count) {
  const Binding binding = bind(of, NACRE_JIT);
  Points points(of, count), expected(of, count);
  binding.run(NACRE_OUTPUTS, points.arrays, points.batch);
  bind(of, NACRE_INTERPRETER).run(NACRE_OUTPUTS, expected.arrays, expected.batch);
  if (points.output != expected.output) return state.SkipWithError("not what is interpreted");
  for (auto _ : state) binding.run(NACRE_OUTPUTS, points.arrays, points.batch);
}

}  // namespace

void register_benchmarks() {
  for (const Case& of : cases) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{65536}}) {
      const std::string name =
          "python/" + std::string(of.name) + '/' + std::to_string(count) + "/c";
      benchmark::RegisterBenchmark(
          name.c_str(), [&of, count](benchmark::State& state) { run(state, of, count); });
    }
  }
}

}  // namespace nacre::bench
