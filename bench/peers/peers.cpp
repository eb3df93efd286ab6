#include "bench/peers/peers.h"

#include <benchmark/benchmark.h>

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

using Outputs = Columns;
/// Computes a batch on the inputs of `ours` into `out`.
using Peer = std::function<void(const KernelRun& ours, Outputs& out)>;

/// The peer on the inputs of our interpreter, whose results it must give.
void register_peer(const std::string& name, const MakeRun& make, const Peer& peer) {
  struct Held {
    std::unique_ptr<KernelRun> ours;
    Outputs out;
    std::string error;
  };
  auto held = std::make_shared<Held>();
  benchmark::RegisterBenchmark((name + "/xsimd").c_str(), [=](benchmark::State& state) {
    if (held->ours == nullptr) {
      held->ours = make({.backend = Backend::reference}, held->error);
      if (held->ours != nullptr) {
        (*held->ours)();
        held->out = held->ours->results();
        for (auto& [channel, values] : held->out) values.assign(batch_points, -7.0f);
        peer(*held->ours, held->out);
        held->error = difference(held->out, held->ours->results(), tolerance);
      }
    }
    if (!held->error.empty()) {
      state.SkipWithError(held->error.c_str());
      return;
    }
    for (auto _ : state) {
      peer(*held->ours, held->out);
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
  return [=](const KernelRun& ours, Outputs& out) {
    kernel(ours.input("Po.x"), ours.input("Po.y"), ours.input("Po.z"), out.at(output).data(),
           batch_points);
  };
}

void conductor_peer(const KernelRun& ours, Outputs& out) {
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
                   .f_x = out.at("f.x").data(),
                   .f_y = out.at("f.y").data(),
                   .f_z = out.at("f.z").data(),
                   .pdf = out.at("pdf").data()};
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
