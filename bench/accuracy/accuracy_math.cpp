// Measures the transcendental functions against the C library in double:
// functions of one argument over all floats (or every --stride-th), those of
// two over --pairs pairs. The truth is within 2^-52, so an error is known to
// 1e-8 ulp and correct rounding of the truth itself does not matter.
//
// The figures that are published come from
//     accuracy_math --engine jit --pairs 1000000000 --json math.json --markdown math.md

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <thread>

#include "bench/accuracy/engine.h"
#include "bench/accuracy/report.h"
#include "jit/passes/expand_math.h"

namespace {

using namespace nacre;

struct Arguments {
  SweepOptions sweep;
  Engine engine = Engine::interpreter;
  std::vector<std::string> only;
  std::string json;
  std::string markdown;
  bool print_programs = false;
};

bool wanted(const Arguments& arguments, const std::string& name) {
  if (arguments.only.empty()) return true;
  return std::find(arguments.only.begin(), arguments.only.end(), name) != arguments.only.end();
}

/// A line on the terminal that is rewritten at every percent.
class Progress {
 public:
  explicit Progress(const char* name) : name_(name) {}
  void operator()(double part) {
    const int percent = static_cast<int>(part * 100.0);
    int shown = shown_.load();
    if (percent <= shown || !shown_.compare_exchange_strong(shown, percent)) return;
    fmt::print(stderr, "\r{} {}%   ", name_, percent);
  }

 private:
  const char* name_;
  std::atomic<int> shown_{-1};
};

std::optional<MathReport> measure(const MathFunction& function, const Arguments& arguments) {
  MathReport report;
  report.function = &function;
  std::vector<std::shared_ptr<const Kernel>> kernels;
  for (std::size_t mode = 0; mode < accuracy_modes.size(); ++mode) {
    Program program = expand_math(program_of(function), accuracy_modes[mode]);
    if (arguments.print_programs) fmt::print("{}\n", to_string(program));
    report.operations[mode] = count_operations(program);
    std::string error;
    kernels.push_back(
        make_kernel(std::move(program), arguments.engine, accuracy_modes[mode], error));
    if (kernels.back()) continue;
    fmt::print(stderr, "{}: {}\n", function.name, error);
    return std::nullopt;
  }
  Progress progress(function.name);
  report.result = sweep(function, kernels, arguments.sweep, std::ref(progress));
  fmt::print(stderr, "\r{} done in {:.1f} s\n", function.name, report.result.seconds);
  return report;
}

void write(const std::string& path, const std::string& text) {
  if (!path.empty()) std::ofstream(path) << text;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  arguments.sweep.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  arguments.sweep.pairs = 1000000;
  CLI::App app("Errors of the transcendental functions in every accuracy mode");
  app.add_option("--stride", arguments.sweep.stride, "Measure every n-th float")
      ->check(CLI::PositiveNumber);
  app.add_option("--pairs", arguments.sweep.pairs, "Pairs for pow and atan2");
  app.add_option("--threads", arguments.sweep.threads)->check(CLI::PositiveNumber);
  app.add_option("--engine", arguments.engine)
      ->transform(CLI::CheckedTransformer(std::map<std::string, Engine>{
          {"interpreter", Engine::interpreter}, {"jit", Engine::jit}}));
  app.add_option("--function", arguments.only, "Only these functions");
  app.add_option("--json", arguments.json, "Write the figures here");
  app.add_option("--markdown", arguments.markdown, "Write the table here");
  app.add_flag("--print", arguments.print_programs, "Show the expanded programs");
  CLI11_PARSE(app, argc, argv);

  std::vector<MathReport> reports;
  for (const MathFunction& function : math_functions()) {
    if (!wanted(arguments, function.name)) continue;
    const std::optional<MathReport> report = measure(function, arguments);
    if (!report) return 1;
    reports.push_back(*report);
  }
  const std::string table = to_markdown(reports);
  fmt::print("{}", table);
  write(arguments.markdown, table);
  const char* engine = arguments.engine == Engine::jit ? "jit" : "interpreter";
  write(arguments.json, to_json(reports, arguments.sweep, engine));
  return 0;
}
