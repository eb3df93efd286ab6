// What a scene's materials cost: twenty topologies compiled, fifty instances of each.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <ctime>
#include <string>
#include <vector>

#include "bench/hosts/points.h"

namespace nacre::bench {

/// See hosts.cpp.
void register_topologies();

namespace {

constexpr int topologies = 20;
constexpr int instances_of_each = 50;

/// A standard_surface with its colour from one of four patterns, and those of five further features
/// that the number has as bits: no two numbers give one graph.
Document document_of(int number) {
  // None is black: of black metal nothing is live.
  constexpr const char* patterns[] = {R"(<constant name="pattern" type="color3">
      <input name="value" type="color3" value="0.8, 0.5, 0.3"/></constant>)",
                                      R"(<checkerboard name="pattern" type="color3"/>)",
                                      R"(<fractal3d name="pattern" type="color3"/>)",
                                      R"(<ramplr name="pattern" type="color3"/>)"};
  struct Feature {
    const char* input;
    const char* value;
  };
  constexpr Feature features[] = {{"metalness", "1"},
                                  {"coat", "1"},
                                  {"sheen", "0.5"},
                                  {"transmission", "0.5"},
                                  {"emission", "0.5"}};
  std::string inputs = R"(<input name="base_color" type="color3" nodename="pattern"/>)";
  for (int bit = 0; bit < 5; ++bit) {
    if ((number + 1) >> bit & 1) {
      inputs += "<input name=\"" + std::string(features[bit].input) + "\" type=\"float\" value=\"" +
                features[bit].value + "\"/>";
    }
  }
  return Document::parse("<materialx version=\"1.39\">" + std::string(patterns[number % 4]) +
                         "<standard_surface name=\"S\" type=\"surfaceshader\">" + inputs +
                         R"(</standard_surface><surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>)");
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Compiles all of them with those parameters live, for a path tracer; makes their instances, each
/// with a roughness of its own. Counters: processor seconds of the compiles, bytes of an instance.
void run(benchmark::State& state, const std::vector<std::string>& live) {
  for (auto _ : state) {
    state.PauseTiming();
    System system;  // With no kernels yet.
    CompileOptions options;
    options.live = live;
    options.entries = 1u << NACRE_BEGIN | 1u << NACRE_SAMPLE | 1u << NACRE_EVALUATE;
    std::vector<Shader> shaders;
    std::vector<std::size_t> roughness;
    const double before = cpu_seconds();
    for (int number = 0; number < topologies; ++number) {
      shaders.push_back(system.compile_material(document_of(number), "M", options));
      roughness.push_back(
          nacre_shader_find_parameter(shaders.back().get(), "S/specular_roughness"));
      if (roughness.back() == SIZE_MAX) return state.SkipWithError("roughness is not live");
    }
    state.counters["compile_cpu_s"] = cpu_seconds() - before;
    std::vector<Instance> instances;
    instances.reserve(topologies * instances_of_each);
    const std::size_t bytes = ::mallinfo2().uordblks;
    state.ResumeTiming();
    for (int i = 0; i < topologies * instances_of_each; ++i) {
      const auto of = static_cast<std::size_t>(i % topologies);
      const float value = static_cast<float>(i) / (topologies * instances_of_each);
      instances.emplace_back(shaders[of]);
      nacre_instance_set(instances.back().get(), roughness[of], &value);
    }
    state.PauseTiming();
    state.counters["instance_bytes"] =
        static_cast<double>(::mallinfo2().uordblks - bytes) / (topologies * instances_of_each);
    instances.clear();
    shaders.clear();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * topologies * instances_of_each);
}

}  // namespace

void register_topologies() {
  benchmark::RegisterBenchmark("hosts/topologies/few", run,
                               std::vector<std::string>{"S/base*", "S/specular_roughness"})
      ->Iterations(1);
  benchmark::RegisterBenchmark("hosts/topologies/all", run, std::vector<std::string>{"*"})
      ->Iterations(1);
}

}  // namespace nacre::bench
