// What it costs to ask more of a point: results beside the state, and everything in one call. Of a
// material whose colour, emission and presence are one fractal noise, as columns.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nacre/nacre.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/hosts/points.h"

namespace nacre::bench {

void register_point_results();

namespace {

constexpr const char* noisy = R"(<materialx version="1.39">
  <nodegraph name="NG">
    <fractal3d name="noise" type="vector3"><input name="octaves" type="integer" value="6"/></fractal3d>
    <multiply name="half" type="vector3"><input name="in1" type="vector3" nodename="noise"/>
      <input name="in2" type="float" value="0.5"/></multiply>
    <add name="lifted" type="vector3"><input name="in1" type="vector3" nodename="half"/>
      <input name="in2" type="float" value="0.5"/></add>
    <convert name="color" type="color3"><input name="in" type="vector3" nodename="lifted"/></convert>
    <output name="out" type="color3" nodename="color"/>
  </nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="out"/>
    <input name="specular_roughness" type="float" value="0.4"/>
    <input name="emission" type="float" value="0.5"/>
    <input name="emission_color" type="color3" nodegraph="NG" output="out"/>
    <input name="opacity" type="color3" nodegraph="NG" output="out"/>
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
</materialx>)";

/// How a host asks for what it needs of a point.
struct Way {
  const char* name;
  std::uint32_t entries;                ///< That are compiled.
  std::vector<const char*> with_begin;  ///< See nacre_compile_options.
  std::vector<nacre_entry> calls;       ///< That are timed, in order.
};

const std::vector<Way>& ways() {
  constexpr std::uint32_t usual = 0;
  constexpr std::uint32_t whole = 1u << NACRE_SHADE;
  static const std::vector<Way> list{
      {"begin", usual, {}, {NACRE_BEGIN}},
      {"begin_with", usual, {"albedo", "emission", "opacity"}, {NACRE_BEGIN}},
      {"begin_and_aovs",
       usual,
       {"albedo", "emission", "opacity", "normal", "roughness", "S/base_color"},
       {NACRE_BEGIN}},
      {"apart", usual, {}, {NACRE_BEGIN, NACRE_ALBEDO, NACRE_EMISSION, NACRE_OPACITY}},
      {"begin_sample_evaluate", usual, {}, {NACRE_BEGIN, NACRE_SAMPLE, NACRE_EVALUATE}},
      {"shade", whole, {}, {NACRE_SHADE}}};
  return list;
}

/// Every result in an array of its own, behind those of `points`.
class Bound {
 public:
  explicit Bound(const Way& way) : points_(false), calls_(way.calls), shader_(compile(way)) {
    Binder binder = points_.binder(shader_);
    arrays_ = points_.arrays();
    for (const nacre_entry entry : calls_) {
      for (const Channel& channel : shader_.results(entry)) {
        if (channel.role == NACRE_STATE) continue;
        binder.array(channel.name, {static_cast<std::uint32_t>(arrays_.size() + names_.size())});
        names_.push_back(channel.name);
      }
    }
    columns_.resize(names_.size() * apart);
    for (std::size_t k = 0; k < names_.size(); ++k) arrays_.push_back(columns_.data() + k * apart);
    binding_.emplace(binder, shader_);
  }

  void run() {
    Batch batch;
    batch.count = all;
    for (const nacre_entry entry : calls_) binding_->run(entry, arrays_, batch);
  }
  /// Whether results of these names are those of another way.
  bool agrees_with(const Bound& other) const {
    for (std::size_t k = 0; k < names_.size(); ++k) {
      const auto found = std::find(other.names_.begin(), other.names_.end(), names_[k]);
      if (found == other.names_.end()) continue;
      const auto at = static_cast<std::size_t>(found - other.names_.begin());
      for (std::size_t i = 0; i < all; ++i) {
        const float expected = other.columns_[at * apart + i];
        const float error = std::abs(columns_[k * apart + i] - expected);
        if (!(error <= 2e-5f * std::abs(expected) + 1e-6f)) return false;
      }
    }
    return true;
  }

 private:
  static Shader compile(const Way& way) {
    CompileOptions options;
    options.entries = way.entries;
    for (const char* name : way.with_begin) options.with_begin.emplace_back(name);
    return host_system().compile_material(Document::parse(noisy), "M", options);
  }

  Points points_;
  std::vector<nacre_entry> calls_;
  Shader shader_;
  std::vector<void*> arrays_;
  std::vector<std::string> names_;
  std::vector<float> columns_;
  std::optional<Binding> binding_;
};

void run_way(benchmark::State& state, const Way& way) {
  Bound apart(ways()[3]), bound(way);
  apart.run(), bound.run();
  if (!bound.agrees_with(apart)) return state.SkipWithError("another result than of calls apart");
  for (auto _ : state) bound.run();
  state.SetItemsProcessed(state.iterations() * std::int64_t{all});
}

}  // namespace

void register_point_results() {
  for (const Way& way : ways()) {
    const std::string name = "hosts/point/" + std::string(way.name);
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&way](benchmark::State& state) { run_way(state, way); });
  }
}

}  // namespace nacre::bench
