#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/common/benchmarks.h"
#include "bench/common/clock.h"
#include "bench/common/material.h"
#include "bench/common/system.h"
#include "jit/document/read.h"
#include "jit/graph/build/build.h"

namespace nacre::bench {

namespace {

/// What the material is: standard_surface with its defaults, or with every number a live
/// parameter, which is the whole model.
struct Case {
  const char* name;
  ParameterMode parameters;
};
constexpr Case cases[] = {{"folded", ParameterMode::frozen}, {"live", ParameterMode::live}};
constexpr Entry entries[] = {Entry::begin, Entry::sample, Entry::evaluate};

/// Milliseconds by stage, added up over iterations.
class Stages {
 public:
  void add(const std::string& name, double milliseconds) { total_[name] += milliseconds; }
  void add(const std::vector<StageReport>& reports) {
    for (const StageReport& report : reports) add(report.name, report.milliseconds);
  }
  void add(const CompileStats& stats) {
    add("emit", 1e3 * stats.emit);
    add("optimize", 1e3 * stats.optimize);
    add("codegen", 1e3 * stats.codegen);
    add("link", 1e3 * stats.link);
    add("cache", 1e3 * stats.cache);
  }
  void show(benchmark::State& state) const {
    for (const auto& [name, milliseconds] : total_) {
      state.counters[name + "_ms"] =
          benchmark::Counter(milliseconds, benchmark::Counter::kAvgIterations);
    }
  }

 private:
  std::map<std::string, double> total_;
};

std::filesystem::path document_path() {
  return std::filesystem::path(NACRE_BENCH_DOCUMENTS) / "standard_surface.mtlx";
}

std::optional<Graph> load_graph(Stages& stages, Diagnostics& diagnostics) {
  auto start = Clock::now();
  const auto document = read_document(document_path(), {}, diagnostics);
  stages.add("read", milliseconds_since(start));
  if (document == nullptr) return std::nullopt;
  start = Clock::now();
  auto graph =
      build_graph(*document, shading_system().library(),
                  {.outputs = {}, .material = "standard_surface"}, graph_options(), diagnostics);
  stages.add("graph", milliseconds_since(start));
  return graph;
}

/// The kernels of the material, through `service`, with what each stage took.
std::vector<std::shared_ptr<const Kernel>> compile_all(RecordedMaterial& material,
                                                       const CompileOptions& options,
                                                       CompileService* service, Stages& stages,
                                                       Diagnostics& diagnostics) {
  std::vector<std::shared_ptr<const Kernel>> kernels;
  for (const Entry entry : entries) {
    const auto start = Clock::now();
    Program program = material.program(entry);
    stages.add("slice", milliseconds_since(start));
    std::vector<StageReport> reports;
    auto kernel = compile(std::move(program), options, service, diagnostics, &reports);
    stages.add(reports);
    stages.add(entry_name(entry), milliseconds_since(start));
    if (kernel == nullptr) return {};
    if (const auto* made = dynamic_cast<const CompiledKernel*>(kernel.get())) {
      stages.add(made->stats());
    }
    kernels.push_back(std::move(kernel));
  }
  return kernels;
}

void library_load(benchmark::State& state) {
  for (auto _ : state) {
    Diagnostics diagnostics;
    const auto library = load_library({NACRE_MATERIALX_LIBRARIES_DIR}, diagnostics);
    if (library == nullptr) state.SkipWithError(diagnostics.to_string().c_str());
  }
}

void document_load(benchmark::State& state) {
  bodies();
  Stages stages;
  for (auto _ : state) {
    Diagnostics diagnostics;
    const auto graph = load_graph(stages, diagnostics);
    if (!graph) state.SkipWithError(diagnostics.to_string().c_str());
  }
  stages.show(state);
}

/// A document of that many nodes: chains of arithmetic with a noise in every tenth,
/// joined into one output, as a procedural texture is.
std::string texture_document(int nodes) {
  const char* const kinds[] = {"add", "multiply", "subtract", "max", "min",
                               "add", "multiply", "power",    "sin", "noise2d"};
  std::string text = "<materialx version=\"1.39\">\n";
  std::string before;
  for (int i = 0; i < nodes; ++i) {
    const std::string_view kind = kinds[(nodes - 1 - i) % 10 == 0 ? 0 : i % 10];
    const std::string name = fmt::format("n{}", i);
    text += fmt::format("<{} name=\"{}\" type=\"float\">", kind, name);
    const bool is_noise = kind == "noise2d";
    if (!before.empty()) {
      text += fmt::format("<input name=\"{}\" type=\"float\" nodename=\"{}\"/>",
                          is_noise        ? "amplitude"
                          : kind == "sin" ? "in"
                                          : "in1",
                          before);
    }
    if (!is_noise && kind != "sin") {
      text += fmt::format("<input name=\"in2\" type=\"float\" value=\"0.{}\"/>", i + 1);
    }
    text += fmt::format("</{}>\n", kind);
    before = name;
  }
  return text +
         fmt::format("<output name=\"out\" type=\"float\" nodename=\"{}\"/></materialx>", before);
}

/// Read, graph and kernel of such a document, by `backend`; the counters are
/// milliseconds, `node` the whole over the number of nodes.
void document_of(benchmark::State& state, int nodes, Backend backend) {
  const std::string text = texture_document(nodes);
  const ShaderOptions options = [&] {
    ShaderOptions made;
    made.compile.backend = backend;
    return made;
  }();
  Stages stages;
  for (auto _ : state) {
    Diagnostics diagnostics;
    const auto whole = Clock::now();
    auto start = whole;
    const auto document = read_document_text(text, "texture.mtlx", {}, diagnostics);
    stages.add("read", milliseconds_since(start));
    start = Clock::now();
    const auto graph = document == nullptr ? std::nullopt
                                           : build_graph(*document, shading_system().library(),
                                                         {.outputs = {"out"}, .material = {}},
                                                         graph_options(), diagnostics);
    stages.add("graph", milliseconds_since(start));
    if (!graph) {
      state.SkipWithError(diagnostics.to_string().c_str());
      return;
    }
    start = Clock::now();
    const auto kernel = shading_system().compile_outputs(*graph, options, diagnostics);
    stages.add("kernel", milliseconds_since(start));
    stages.add("node", milliseconds_since(whole) / nodes);
    if (kernel == nullptr) state.SkipWithError(diagnostics.to_string().c_str());
  }
  stages.show(state);
}

/// From the document to the first results of all three kernels, nothing compiled.
void first_batch(benchmark::State& state, ParameterMode parameters) {
  bodies();
  Stages stages;
  for (auto _ : state) {
    Diagnostics diagnostics;
    std::string error;
    const auto graph = load_graph(stages, diagnostics);
    auto start = Clock::now();
    const std::shared_ptr<RecordedMaterial> material =
        graph ? RecordedMaterial::record(*graph, Accuracy::standard, parameters, error) : nullptr;
    stages.add("record", milliseconds_since(start));
    if (material == nullptr) {
      state.SkipWithError((diagnostics.to_string() + error).c_str());
      return;
    }
    const auto kernels =
        compile_all(*material, {.backend = Backend::interpreter}, nullptr, stages, diagnostics);
    state.PauseTiming();  // Arrays are the host's.
    std::vector<KernelRun> runs;
    for (const auto& kernel : kernels) {
      runs.emplace_back(BoundKernel(kernel, material->textures()));
    }
    state.ResumeTiming();
    start = Clock::now();
    for (KernelRun& run : runs) run();
    stages.add("run", milliseconds_since(start));
  }
  stages.show(state);
}

/// The three kernels of a recorded material by a service of its own each time. With a
/// cache folder, filled before, they come from there.
void compile_kernels(benchmark::State& state, ParameterMode parameters,
                     const std::filesystem::path& cache) {
  bodies();
  Stages stages, unused;
  Diagnostics diagnostics;
  std::string error;
  const auto graph = load_graph(unused, diagnostics);
  const auto material =
      graph ? RecordedMaterial::record(*graph, Accuracy::standard, parameters, error) : nullptr;
  if (material == nullptr) {
    state.SkipWithError((diagnostics.to_string() + error).c_str());
    return;
  }
  const ServiceOptions options{.threads = 1, .cache = cache, .session = {}};
  if (!cache.empty()) {
    const auto service = CompileService::create(options, diagnostics);
    compile_all(*material, {}, service.get(), unused, diagnostics);
  }
  for (auto _ : state) {
    state.PauseTiming();
    auto service = CompileService::create(options, diagnostics);
    state.ResumeTiming();
    auto kernels = compile_all(*material, {}, service.get(), stages, diagnostics);
    state.PauseTiming();
    if (kernels.empty() || diagnostics.has_errors()) {
      state.SkipWithError(diagnostics.to_string().c_str());
    }
    for (const auto& kernel : kernels) {
      const auto* made = dynamic_cast<const CompiledKernel*>(kernel.get());
      if (made == nullptr || made->stats().from_cache != !cache.empty()) {
        state.SkipWithError("a kernel did not come from where it should");
      }
    }
    kernels.clear();
    service.reset();
    state.ResumeTiming();
  }
  stages.show(state);
}

/// A folder that ends with the program.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("nacre-bench-cache-" + std::to_string(getpid()))) {}
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

template <class F>
void add(const std::string& name, F&& measure) {
  benchmark::RegisterBenchmark(name.c_str(), std::forward<F>(measure))
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace

void register_benchmarks() {
  static const TemporaryFolder cache;
  add("latency/library_load", library_load);
  add("latency/document_load", document_load);
  add("latency/document_100_nodes/interpreter",
      [](benchmark::State& state) { document_of(state, 100, Backend::interpreter); });
  add("latency/document_100_nodes/jit",
      [](benchmark::State& state) { document_of(state, 100, Backend::jit); });
  for (const Case& each : cases) {
    const std::string suffix = std::string("/") + each.name;
    const ParameterMode parameters = each.parameters;
    add("latency/interpreter_first_batch" + suffix,
        [=](benchmark::State& state) { first_batch(state, parameters); });
    add("latency/cold_compile" + suffix,
        [=](benchmark::State& state) { compile_kernels(state, parameters, {}); });
    add("latency/cache_hit" + suffix,
        [=](benchmark::State& state) { compile_kernels(state, parameters, cache.path()); });
  }
}

}  // namespace nacre::bench
