// What time and memory do as a graph grows: from its text to the results of the interpreter,
// and to machine code.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "bench/common/benchmarks.h"
#include "bench/common/clock.h"
#include "bench/common/system.h"
#include "jit/document/read.h"

namespace nacre::bench {

namespace {

constexpr int sizes[] = {100, 300, 1000, 3000, 10'000, 20'000};

/// The same numbers on every machine.
class Numbers {
 public:
  std::uint32_t below(std::uint32_t count) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>((state_ >> 33) % count);
  }

 private:
  std::uint64_t state_ = 1;
};

/// A document of that many sines, powers, noises and arithmetic, each fed by two of the
/// thirty before it: little of it is a chain, none of it is the same twice.
std::string document_text(int nodes) {
  Numbers numbers;
  std::string text = R"(<materialx version="1.39">
<texcoord name="uv" type="vector2"/>
<separate2 name="st" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
)";
  const auto link = [&](std::string_view input, int before) {
    if (before == 0 || numbers.below(50) == 0) {
      return fmt::format(R"(<input name="{}" type="float" nodename="st" output="{}"/>)", input,
                         numbers.below(2) == 0 ? "outx" : "outy");
    }
    const auto near = static_cast<std::uint32_t>(std::min(before, 30));
    const int from = before - 1 - static_cast<int>(numbers.below(near));
    return fmt::format(R"(<input name="{}" type="float" nodename="n{}"/>)", input, from);
  };
  const auto literal = [&](std::string_view input) {
    return fmt::format(R"(<input name="{}" type="float" value="0.{}"/>)", input,
                       1 + numbers.below(98));
  };
  for (int i = 0; i < nodes; ++i) {
    constexpr std::string_view kinds[] = {"sin", "power", "noise2d", "add", "multiply", "mix"};
    const std::string_view kind = kinds[numbers.below(6)];
    std::string inputs;
    if (kind == "sin") {
      inputs = link("in", i);
    } else if (kind == "power") {
      inputs = link("in1", i) + literal("in2");
    } else if (kind == "mix") {
      inputs = link("fg", i) + link("bg", i) + literal("mix");
    } else if (kind == "noise2d") {
      text += fmt::format("<combine2 name=\"c{}\" type=\"vector2\">{}{}</combine2>\n", i,
                          link("in1", i), link("in2", i));
      inputs = fmt::format(R"(<input name="texcoord" type="vector2" nodename="c{}"/>)", i);
    } else {
      inputs = link("in1", i) + link("in2", i);
    }
    text += fmt::format("<{0} name=\"n{1}\" type=\"float\">{2}</{0}>\n", kind, i, inputs);
  }
  return text + fmt::format("<output name=\"out\" type=\"float\" nodename=\"n{}\"/>\n</materialx>",
                            nodes - 1);
}

/// Megabytes of a line of /proc/self/status; "VmHWM": the most since forget_peak().
double megabytes(std::string_view line_of) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(line_of)) return std::stod(line.substr(line_of.size() + 1)) / 1024;
  }
  return 0;
}

void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// From the text to a first batch of the results; counters are milliseconds by stage, and
/// the megabytes that it took at most.
void grow(benchmark::State& state, int nodes, Backend backend) {
  const std::string text = document_text(nodes);
  ShaderOptions options;
  options.compile.backend = backend;
  options.compile.max_seconds = 600;
  double operations = 0, read = 0, graph = 0, kernel = 0, run = 0, memory = 0;
  for (auto _ : state) {
    malloc_trim(0);  // What the last run has left would be used again, unseen.
    forget_peak();
    const double before = megabytes("VmRSS");
    Diagnostics diagnostics;
    auto start = Clock::now();
    const auto document = read_document_text(text, "growth.mtlx", {}, diagnostics);
    read += milliseconds_since(start);
    if (document == nullptr) return state.SkipWithError(diagnostics.to_string().c_str());
    start = Clock::now();
    const auto made = shading_system().compile_outputs(*document, {"out"}, options, diagnostics);
    const double whole = milliseconds_since(start);
    if (made == nullptr) return state.SkipWithError(diagnostics.to_string().c_str());
    for (const StageReport& stage : made->stages) {
      if (stage.name == "graph") graph += stage.milliseconds;
      if (stage.name.ends_with("expand_math")) operations = static_cast<double>(stage.instructions);
    }
    kernel += whole;
    start = Clock::now();
    KernelRun batch(made->kernel);
    batch();
    run += milliseconds_since(start);
    memory += megabytes("VmHWM") - before;
  }
  const auto show = [&](const char* name, double sum) {
    state.counters[name] = benchmark::Counter(sum, benchmark::Counter::kAvgIterations);
  };
  show("read_ms", read);
  show("graph_ms", graph);
  show("kernel_ms", kernel - graph);
  show("run_ms", run);
  show("memory_mb", memory);
  state.counters["operations"] = operations;
}

}  // namespace

void register_benchmarks() {
  for (const Backend backend : {Backend::interpreter, Backend::jit}) {
    for (const int nodes : sizes) {
      const char* engine = backend == Backend::jit ? "jit" : "interpreter";
      benchmark::RegisterBenchmark(fmt::format("growth/{}/{}", nodes, engine).c_str(),
                                   [=](benchmark::State& state) { grow(state, nodes, backend); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  }
}

}  // namespace nacre::bench
