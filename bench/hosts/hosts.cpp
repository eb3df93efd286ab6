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

namespace nacre::bench {

/// See bench/common/benchmarks.h, which a host does not know.
void register_benchmarks();

namespace {

constexpr std::size_t all = 4096;
constexpr std::size_t numbers_a_point = 21;

/// How a host keeps its points, and which of them it shades.
struct Case {
  const char* name;
  bool structures;  ///< Else a column a number.
  enum { every, half_in_order, half_in_any_order } list;
  bool varying;  ///< base_color and roughness by instances.
};
constexpr Case cases[] = {
    {"columns/all", false, Case::every, false},
    {"columns/half", false, Case::half_in_order, false},
    {"columns/half_in_any_order", false, Case::half_in_any_order, false},
    {"structures/all", true, Case::every, false},
    {"structures/half", true, Case::half_in_order, false},
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

System& host_system() {
  static System system;
  return system;
}

/// Named groups of numbers, every one an array of its own or all in structures.
class Points {
 public:
  explicit Points(bool structures) : structures_(structures) {
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    for (std::size_t i = 0; i < all; ++i) {
      const float z = 0.05f + 0.95f * number();
      const float azimuth = 6.2831853f * number();
      const float r = std::sqrt(1 - z * z);
      const float P[]{number(), number(), 0};
      const float N[]{0, 0, 1}, T[]{1, 0, 0}, B[]{0, 1, 0};
      const float wo[]{r * std::cos(azimuth), r * std::sin(azimuth), z};
      const float u[]{number(), number(), number()};
      for (const auto* group : {P, N, T, B, wo, u, wo}) {
        numbers_.insert(numbers_.end(), group, group + 3);
      }
    }
    if (!structures_) {
      std::vector<float> columns(numbers_.size());
      for (std::size_t i = 0; i < all; ++i) {
        for (std::size_t k = 0; k < numbers_a_point; ++k) {
          columns[k * all + i] = numbers_[numbers_a_point * i + k];
        }
      }
      numbers_ = std::move(columns);
    }
    for (std::size_t i = 0; i < all; ++i)
      instances_.push_back(static_cast<std::uint32_t>(i * 7 % 16));
    for (int k = 0; k < 16 * 4; ++k) looks_.push_back(0.1f + 0.8f * number());
  }

  Binding bind(const Shader& shader) {
    state_.resize(std::max<std::size_t>(shader.state_count(), 1) * all);
    Binder binder;
    const auto group = [&](std::initializer_list<const char*> names, std::ptrdiff_t first) {
      for (const char* name : names) {
        binder.array(name, structures_ ? Layout{0, 4 * first, 4 * numbers_a_point}
                                       : Layout{0, 4 * first * std::ptrdiff_t(all), 4, 4 * all});
      }
    };
    group({"P", "Po"}, 0);
    group({"N", "No", "Ng"}, 3);
    group({"T", "To"}, 6);
    group({"B", "Bo"}, 9);
    group({"wo"}, 12);
    group({"u"}, 15);
    group({"wi"}, 18);
    binder.array("state", {1, 0, 4, 4 * all});
    results_.resize(12 * all);
    const auto result = [&](const char* name, std::ptrdiff_t first) {
      binder.array(name, structures_ ? Layout{2, 4 * first, 48}
                                     : Layout{2, 4 * first * std::ptrdiff_t(all), 4, 4 * all});
    };
    result("f", 0), result("weight", 3), result("pdf", 6);
    result("flags", 7), result("lobe", 8), result("albedo", 9);
    binder.array("S_standard_surface/base_color", {3, 0, 16, 4, NACRE_OF_INSTANCE});
    binder.array("S_standard_surface/specular_roughness", {3, 12, 16, 4, NACRE_OF_INSTANCE});
    return Binding(binder, shader);
  }

  std::vector<void*> arrays() {
    return {numbers_.data(), state_.data(), results_.data(), looks_.data()};
  }
  const std::uint32_t* instances() const { return instances_.data(); }
  /// Result number `k` of a point.
  float result(std::size_t i, std::size_t k) const {
    return structures_ ? results_[12 * i + k] : results_[k * all + i];
  }

 private:
  bool structures_;
  std::vector<float> numbers_, state_, results_, looks_;
  std::vector<std::uint32_t> instances_;
};

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
  Points expected(false), found(host.structures);
  const Binding plain = expected.bind(shader(false));
  const Binding bound = found.bind(shader(false));
  Batch whole;
  whole.count = all;
  plain.run(NACRE_BEGIN, expected.arrays(), whole);
  bound.run(NACRE_BEGIN, found.arrays(), whole);
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
  Points points(host.structures);
  const Binding binding = points.bind(shader(host.varying));
  const std::vector<std::uint32_t> list = list_of(host);
  const Batch batch = batch_of(host, list, points);
  const std::vector<void*> arrays = points.arrays();
  Batch whole = batch;
  whole.count = all;
  whole.points = nullptr;
  binding.run(NACRE_BEGIN, arrays, whole);
  for (auto _ : state) binding.run(entry, arrays, batch);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(batch.count));
}

/// A call of one point: what it costs to ask.
void run_one_point(benchmark::State& state) {
  Points points(false);
  const Binding binding = points.bind(shader(false));
  const std::vector<void*> arrays = points.arrays();
  Batch batch;
  batch.count = 1;
  for (auto _ : state) binding.run(NACRE_EVALUATE, arrays, batch);
  state.SetItemsProcessed(state.iterations());
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
  for (const Case& host : cases) {
    for (const Entry& entry : entries) {
      const std::string name = "hosts/" + std::string(entry.name) + '/' + host.name;
      benchmark::RegisterBenchmark(name.c_str(), [&host, &entry](benchmark::State& state) {
        run_case(state, host, entry.entry);
      });
    }
  }
  benchmark::RegisterBenchmark("hosts/evaluate/one_point", run_one_point);
  benchmark::RegisterBenchmark("hosts/instance", run_instances);
}

}  // namespace nacre::bench
