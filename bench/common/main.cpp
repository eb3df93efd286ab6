#include <benchmark/benchmark.h>

#include <cstdlib>

#include "bench/common/benchmarks.h"
#include "jit/llvm/options.h"

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  // bench/run.py names the run, so that figures of two runs are never compared.
  const char* run = std::getenv("NACRE_BENCH_RUN");
  benchmark::AddCustomContext("run", run != nullptr ? run : "none");
  benchmark::AddCustomContext("cpu", nacre::Target::host().cpu);
  nacre::bench::register_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
