#include "bench/common/benchmarks.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "bench/accuracy/error.h"

namespace nacre::bench {

namespace {

/// How far all results are from the expected ones, in units of the last place: what 99 % keep,
/// and the largest. One that is NaN alone is as wrong as can be.
struct Errors {
  double most_of_them = 0;
  double largest = 0;
};

Errors errors(const Columns& found, const Columns& expected) {
  std::vector<double> all;
  for (const auto& [name, wanted] : expected) {
    const std::vector<float>& column = found.at(name);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const int nans = int{std::isnan(column[i])} + int{std::isnan(wanted[i])};
      if (nans == 2) continue;
      all.push_back(nans == 1 ? 0x1p32 : ulp_error(column[i], wanted[i]));
    }
  }
  if (all.empty()) return {};
  std::ranges::sort(all);
  return {all[(all.size() - 1) * 99 / 100], all.back()};
}

/// What the variants of one kernel share.
struct Subject {
  MakeRun make;
  Tolerance tolerance;
  std::map<Accuracy, Columns> truth;

  /// The reference engine has exact functions. Directions are of two of `fast`, a sine and a cosine
  /// of up to 1e-4 (bench/results/math.md).
  Tolerance tolerance_of(Accuracy accuracy) const {
    Tolerance allowed = tolerance;
    if (accuracy == Accuracy::fast) allowed.absolute = std::max(allowed.absolute, 2e-4);
    return allowed;
  }

  /// The reference engine's results; empty, with the reason, where it can't.
  const Columns* expected(Accuracy accuracy, std::string& error) {
    if (const auto found = truth.find(accuracy); found != truth.end()) return &found->second;
    const Variant reference{.backend = Backend::reference, .accuracy = accuracy};
    const auto run = make(reference.options(), error);
    if (run == nullptr) return nullptr;
    (*run)();
    return &(truth[accuracy] = run->results());
  }
};

/// One benchmark; google-benchmark calls it several times.
struct Timed {
  std::shared_ptr<Subject> subject;
  Variant variant;
  std::unique_ptr<KernelRun> run = nullptr;

  /// Makes the kernel and checks it. The reason, if it is not to be timed.
  std::string prepare() {
    if (run != nullptr) return {};
    std::string error;
    const Columns* expected = subject->expected(variant.accuracy, error);
    if (expected == nullptr) return error;
    auto made = subject->make(variant.options(), error);
    if (made == nullptr) return error;
    (*made)();
    const Columns results = made->results();
    error = difference(results, *expected, subject->tolerance_of(variant.accuracy));
    if (!error.empty()) return error;
    const auto [most_of_them, largest] = errors(results, *expected);
    made->counters["ulps_99"] = most_of_them;
    made->counters["ulps_most"] = largest;
    run = std::move(made);
    return error;
  }

  void measure(benchmark::State& state) {
    if (const std::string error = prepare(); !error.empty()) {
      state.SkipWithError(error.c_str());
      return;
    }
    for (auto _ : state) {
      (*run)();
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * batch_points));
    for (const auto& [name, value] : run->counters) state.counters[name] = value;
  }
};

bool close(float x, float y, const Tolerance& tolerance) {
  if (std::isnan(x) || std::isnan(y)) return std::isnan(x) == std::isnan(y);
  if (x == y) return true;
  return std::fabs(double{x} - y) <= tolerance.absolute + tolerance.relative * std::fabs(y);
}

}  // namespace

CompileOptions Variant::options() const {
  return {.accuracy = accuracy, .backend = backend, .lanes = backend == Backend::jit ? lanes : 0};
}

std::string Variant::name() const {
  const std::string engine = backend == Backend::jit           ? fmt::format("jit_w{}", lanes)
                             : backend == Backend::interpreter ? "interpreter"
                                                               : "reference";
  return fmt::format("{}/{}", engine, accuracy_name(accuracy));
}

std::vector<Variant> all_variants() {
  std::vector<Variant> variants{{.backend = Backend::interpreter}};
  for (const int lanes : {1, 4, 8, 16}) variants.push_back({.lanes = lanes});
  for (const Accuracy accuracy : {Accuracy::precise, Accuracy::fast}) {
    variants.push_back({.accuracy = accuracy});
  }
  return variants;
}

std::vector<Variant> quick_variants() {
  return {{.backend = Backend::interpreter}, {.lanes = 1}, {.lanes = 16}};
}

std::string difference(const Columns& found, const Columns& expected, const Tolerance& tolerance) {
  for (const auto& [name, wanted] : expected) {
    const auto column = found.find(name);
    if (column == found.end()) return fmt::format("no output '{}'", name);
    std::size_t wrong = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (!close(column->second[i], wanted[i], tolerance) && wrong++ == 0) first = i;
    }
    if (static_cast<double>(wrong) <= tolerance.outliers * static_cast<double>(wanted.size())) {
      continue;
    }
    return fmt::format("wrong: '{}' differs at {} of {} points, at {} it is {}, expected {}", name,
                       wrong, wanted.size(), first, column->second[first], wanted[first]);
  }
  return {};
}

void register_kernel(const std::string& name, const std::vector<Variant>& variants,
                     const MakeRun& make, const Tolerance& tolerance) {
  auto subject = std::make_shared<Subject>(Subject{make, tolerance, {}});
  for (const Variant& variant : variants) {
    auto timed = std::make_shared<Timed>(Timed{subject, variant});
    benchmark::RegisterBenchmark((name + "/" + variant.name()).c_str(),
                                 [timed](benchmark::State& state) { timed->measure(state); });
  }
}

}  // namespace nacre::bench
