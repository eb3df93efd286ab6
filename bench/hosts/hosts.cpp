// What a host pays beside the kernel: structures in place of columns, lists of points, instances
// that differ from point to point, and the call itself. Of standard_surface with every number a
// live parameter, in nanoseconds for each point that is shaded.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nacre/nacre.hpp>
#include <random>
#include <string>
#include <vector>

#include "bench/hosts/points.h"

namespace nacre::bench {

/// See bench/common/benchmarks.h, which a host does not know.
void register_benchmarks();
/// Of calls.cpp, point_results.cpp and topologies.cpp.
void register_calls();
void register_point_results();
void register_topologies();

namespace {

/// How a host keeps its points, and which of them it shades.
struct Case {
  const char* name;
  bool structures;  ///< Else a column a number.
  enum { every, half_in_order, half_in_any_order } list;
  bool varying = false;         ///< base_color and roughness by instances.
  bool state_by_place = false;  ///< Else an element for each point, listed or not.
  bool a_page_apart = false;    ///< Columns lie as many whole pages from each other.
};
constexpr Case cases[] = {
    {"columns/all", false, Case::every},
    {"columns/a_page_apart", false, Case::every, false, false, true},
    {"columns/half", false, Case::half_in_order, false, true},
    {"columns/half_in_any_order", false, Case::half_in_any_order, false, true},
    {"columns/half_of_state", false, Case::half_in_order},
    {"structures/all", true, Case::every},
    {"structures/half", true, Case::half_in_order, false, true},
    {"instances/all", false, Case::every, true},
};

struct Entry {
  nacre_entry entry;
  const char* name;
};
constexpr Entry entries[] = {{NACRE_BEGIN, "begin"},
                             {NACRE_SAMPLE, "sample"},
                             {NACRE_EVALUATE, "evaluate"},
                             {NACRE_ALBEDO, "albedo"}};

Shader shader_of(bool varying) {
  CompileOptions options;
  options.live = {"*"};
  if (varying) {
    options.varying = {"S_standard_surface/base_color*", "S_standard_surface/specular_roughness"};
  }
  const Document document =
      Document::read(std::string(NACRE_BENCH_DOCUMENTS) + "/standard_surface.mtlx");
  return host_system().compile_material(document, "standard_surface", options);
}

const Shader& shader(bool varying) {
  static const Shader uniform = shader_of(false);
  static const Shader by_instance = shader_of(true);
  return varying ? by_instance : uniform;
}

std::vector<std::uint32_t> list_of(const Case& host) {
  std::vector<std::uint32_t> list;
  std::mt19937 random(2);
  for (std::uint32_t i = 0; i < all; ++i) {
    if (random() % 2 == 0) list.push_back(i);
  }
  if (host.list == Case::half_in_any_order) std::shuffle(list.begin(), list.end(), random);
  return list;
}

Batch batch_of(const Case& host, const std::vector<std::uint32_t>& list, const Points& points) {
  Batch batch;
  batch.count = host.list == Case::every ? all : list.size();
  if (host.list != Case::every) batch.points = list.data();
  batch.instances = points.instances();
  return batch;
}

/// Whether the listed points have what they get where all are shaded as columns.
bool is_right(const Case& host, nacre_entry entry) {
  if (host.varying) return true;  // tests/jit/api compares those with instances.
  const std::vector<std::uint32_t> list = list_of(host);
  Points expected(false), found(host.structures, host.state_by_place);
  const Binding plain = expected.bind(shader(false));
  const Binding bound = found.bind(shader(false));
  Batch whole;
  whole.count = all;
  plain.run(NACRE_BEGIN, expected.arrays(), whole);
  bound.run(NACRE_BEGIN, found.arrays(), host.state_by_place ? batch_of(host, list, found) : whole);
  plain.run(entry, expected.arrays(), whole);
  bound.run(entry, found.arrays(), batch_of(host, list, found));
  if (entry == NACRE_BEGIN) return true;  // Its state is what the others were run on.
  for (std::uint32_t i = 0; i < all; ++i) {
    const bool is_shaded =
        host.list == Case::every || std::find(list.begin(), list.end(), i) != list.end();
    for (std::size_t k = 0; is_shaded && k < 12; ++k) {
      if (found.result(i, k) != expected.result(i, k)) return false;
    }
  }
  return true;
}

void run_case(benchmark::State& state, const Case& host, nacre_entry entry) {
  if (!is_right(host, entry)) return state.SkipWithError("another result than of plain columns");
  Points points(host.structures, host.state_by_place, host.a_page_apart ? all : apart);
  const Binding binding = points.bind(shader(host.varying));
  const std::vector<std::uint32_t> list = list_of(host);
  const Batch batch = batch_of(host, list, points);
  const std::vector<void*> arrays = points.arrays();
  Batch first = batch;
  if (!host.state_by_place) first.count = all, first.points = nullptr;
  binding.run(NACRE_BEGIN, arrays, first);
  for (auto _ : state) binding.run(entry, arrays, batch);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch.count));
}

/// A thousand instances, each with a colour of its own: time and bytes of one.
void run_instances(benchmark::State& state) {
  const Shader& of = shader(false);
  const std::size_t color = nacre_shader_find_parameter(of.get(), "S_standard_surface/base_color");
  for (auto _ : state) {
    std::vector<Instance> instances;
    instances.reserve(1000);
    for (int i = 0; i < 1000; ++i) {
      const float value[3]{static_cast<float>(i) * 1e-3f, 0.5f, 0.25f};
      instances.emplace_back(of);
      nacre_instance_set(instances.back().get(), color, value);
    }
    benchmark::DoNotOptimize(instances.data());
  }
  state.SetItemsProcessed(state.iterations() * 1000);
}

}  // namespace

void register_benchmarks() {
  register_point_results();
  register_topologies();
  for (const Case& host : cases) {
    for (const Entry& entry : entries) {
      const std::string name = "hosts/" + std::string(entry.name) + '/' + host.name;
      benchmark::RegisterBenchmark(name.c_str(), [&host, &entry](benchmark::State& state) {
        run_case(state, host, entry.entry);
      });
    }
  }
  register_calls();
  benchmark::RegisterBenchmark("hosts/instance", run_instances);
}

}  // namespace nacre::bench
