#include "bench/peers/peers.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "bench/common/benchmarks.h"
#include "bench/common/system.h"
#include "bench/peers/conductor.h"

namespace nacre::bench {

namespace {

/// Both sides round differently; steps and cell boundaries move with rounding.
constexpr Tolerance tolerance{.absolute = 2e-5, .relative = 1e-4, .outliers = 0.002};

/// Computes a batch from the inputs into the outputs of a kernel of ours.
using Peer = std::function<void(const KernelRun& arrays)>;

/// What the peer is timed on, or the reason why it is not: it must give what our reference
/// engine gives.
std::unique_ptr<KernelRun> checked(const MakeRun& make, const Peer& peer, std::string& error) {
  auto arrays = make({.backend = Backend::reference}, error);
  if (arrays == nullptr) return nullptr;
  (*arrays)();
  const Columns expected = arrays->results();
  for (const auto& [channel, values] : expected) {
    std::fill_n(arrays->output(channel), values.size(), -7.0f);
  }
  peer(*arrays);
  error = difference(arrays->results(), expected, tolerance);
  return error.empty() ? std::move(arrays) : nullptr;
}

void register_peer(const std::string& name, const MakeRun& make, const Peer& peer) {
  auto arrays = std::make_shared<std::unique_ptr<KernelRun>>();
  benchmark::RegisterBenchmark((name + "/xsimd").c_str(), [=](benchmark::State& state) {
    std::string error;
    if (*arrays == nullptr) *arrays = checked(make, peer, error);
    if (*arrays == nullptr) {
      state.SkipWithError(error.c_str());
      return;
    }
    for (auto _ : state) {
      peer(**arrays);
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * batch_points));
  });
}

void register_pair(const std::string& name, const MakeRun& make, const Peer& peer) {
  register_kernel("peers/" + name, all_variants(), make, tolerance);
  register_peer("peers/" + name, make, peer);
}

/// A graph output of one number that depends on the position.
MakeRun pattern(const std::string& file, const std::string& output) {
  return [=](const CompileOptions& options, std::string& error) {
    return run_output(bench_document(file), output, options, error);
  };
}

template <class F>
Peer on_position(const std::string& output, F* kernel) {
  return [=](const KernelRun& ours) {
    kernel(ours.input("Po.x"), ours.input("Po.y"), ours.input("Po.z"), ours.output(output),
           batch_points);
  };
}

void conductor_peer(const KernelRun& ours) {
  NacreConductor c{.wo_x = ours.input("wo.x"),
                   .wo_y = ours.input("wo.y"),
                   .wo_z = ours.input("wo.z"),
                   .wi_x = ours.input("wi.x"),
                   .wi_y = ours.input("wi.y"),
                   .wi_z = ours.input("wi.z"),
                   .alpha_x = ours.input("alpha.x"),
                   .alpha_y = ours.input("alpha.y"),
                   .n = {gold_n[0], gold_n[1], gold_n[2]},
                   .k = {gold_k[0], gold_k[1], gold_k[2]},
                   .f_x = ours.output("f.x"),
                   .f_y = ours.output("f.y"),
                   .f_z = ours.output("f.z"),
                   .pdf = ours.output("pdf")};
  nacre_peer_conductor(&c, batch_points);
}

}  // namespace

void register_benchmarks() {
  benchmark::AddCustomContext("peer_compiler", nacre_peer_compiler());
  benchmark::AddCustomContext("peer_lanes", std::to_string(nacre_peer_lanes()));
  register_pair("chain", pattern("chain.mtlx", "NG_chain/out"),
                on_position("NG_chain/out", nacre_peer_chain));
  register_pair("fractal", pattern("fractal.mtlx", "NG_fractal/out"),
                on_position("NG_fractal/out", nacre_peer_fractal));
  register_pair("conductor", run_conductor, conductor_peer);
}

}  // namespace nacre::bench
