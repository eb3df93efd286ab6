// Tabulates how far the kernels' lobes are from their formulas (tests/pbs/independent), and what
// they take, by accuracy:
//
//     lobe_errors > bench/results/lobes.md
//
// Arguments: rows whose names have this text; how many views of each.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/pbs/battery/oracle_errors.h"

namespace {

using namespace nacre;

constexpr std::size_t wi_per_view = 32;
constexpr Accuracy modes[] = {Accuracy::precise, Accuracy::standard, Accuracy::fast};

/// A batch of points of a table, views mixed as in a picture.
class Batch {
 public:
  Batch(const Kernel& kernel, const OraclePoints& points)
      : kernel_(kernel), out_(kernel.program().outputs.size(), std::vector<float>(count)) {
    for (const Channel& channel : kernel.program().inputs) {
      const auto found = points.columns.find(channel.name);
      std::vector<float> column(count, 0.0f);
      for (std::size_t i = 0; found != points.columns.end() && i < count; ++i) {
        column[i] = found->second[i * 1777 % found->second.size()];
      }
      in_.push_back(std::move(column));
    }
    for (const auto& column : in_) inputs_.push_back(column.data());
    for (auto& column : out_) outputs_.push_back(column.data());
    for (const ParameterSlot& slot : kernel.program().parameters) slots_.push_back(slot.value);
  }

  /// Of one point, in ns: the least of many runs.
  double time() const {
    using Clock = std::chrono::steady_clock;
    const KernelArguments arguments{.inputs = inputs_.data(),
                                    .outputs = outputs_.data(),
                                    .parameters = slots_.data(),
                                    .count = count};
    double least = 1e30, spent = 0.0;
    while (spent < 2e8) {
      const auto start = Clock::now();
      kernel_.run(arguments);
      const double taken = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
      least = std::min(least, taken), spent += taken;
    }
    return least / count;
  }

 private:
  static constexpr std::size_t count = 4096;
  const Kernel& kernel_;
  std::vector<std::vector<float>> in_, out_;
  std::vector<const void*> inputs_;
  std::vector<void*> outputs_;
  std::vector<std::uint32_t> slots_;
};

struct Measured {
  Accuracy mode;
  OracleErrors errors;
  double time;
};

/// Whether a is in nothing better than b: less exact, or as exact and slower, by more than figures
/// scatter.
bool is_dominated(const Measured& a, const Measured& b) {
  const auto no_better = [](const ErrorList& x, const ErrorList& y) {
    return x.usual() >= 0.98 * y.usual();
  };
  return a.time > 1.05 * b.time && no_better(a.errors.f, b.errors.f) &&
         no_better(a.errors.pdf, b.errors.pdf) && no_better(a.errors.albedo, b.errors.albedo);
}

void print(const OracleCase& row, const std::vector<Measured>& all) {
  const auto three = [](const ErrorList& list) {
    return fmt::format("{:.1e} | {:.1e} | {:.1e}", list.most(), list.usual(), list.mean());
  };
  for (const Measured& one : all) {
    std::string better;
    for (const Measured& other : all) {
      if (is_dominated(one, other)) better = accuracy_name(other.mode);
    }
    fmt::print("| {} | {} | {} | {} | {:.1e} | {:.3g} | {} |\n", row.name, accuracy_name(one.mode),
               three(one.errors.f), three(one.errors.pdf), one.errors.albedo.most(), one.time,
               better);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  const std::size_t views = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1000;
  fmt::print(
      "# Lobes against their formulas\n\n"
      "What machine code makes of each closure, beside the formula of its paper in double "
      "precision\n"
      "(`tests/pbs/independent`): {} views, from the normal to 89.99° and from inside, of alpha "
      "from\n"
      "0.001 to 1; \"extreme\" are indices from 1 ± 1e-6 to 1.05 and from 4.5 to 40. {} directions "
      "of\n"
      "light for each, half of them where the lobe is bright. Errors are relative, of no less than "
      "a\n"
      "millionth of the largest value that the view has, where 20 roundings of the directions are "
      "less\n"
      "than 1 % of the angle over which f changes; those of the albedo kernel are parts of the "
      "light.\n"
      "By `lobe_errors` (`tests/pbs/battery`).\n\n"
      "What facets lose to several scatterings the formulas have of an integral for the view, the "
      "lobes\n"
      "of tables and of sums over few facets (`pbs/energy.h`, `pbs/facet_sum.h`): of facets f "
      "shows what\n"
      "those cost, pdf what rounding does. Of transmission (T), where a share of the facets under "
      "total\n"
      "reflection turns light back, errors of that share are parts of those facets' light. Of "
      "films, in\n"
      "the red channel, errors are of no less than what a reflectance of 0.05 gives. ns: of a\n"
      "point, everything about its view, evaluate and albedo, in batches of 4096 with all views "
      "mixed,\n"
      "one thread; where one point of a vector needs a sum, all wait for it. Named last: a mode "
      "that is\n"
      "as exact, and faster.\n\n"
      "| closure | mode | f, max | 99.9 % | mean | pdf, max | 99.9 % | mean | albedo, max | ns | "
      "dominated by |\n"
      "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n",
      views, wi_per_view);
  for (const OracleCase& row : oracle_cases()) {
    if (row.name.find(only) == std::string::npos) continue;
    const OraclePoints points = oracle_points(row, views, wi_per_view, 1);
    std::vector<Measured> all;
    for (const Accuracy mode : modes) {
      if (mode == Accuracy::fast && !row.is_fast_too) continue;
      const auto kernel = oracle_kernel(row, mode);
      if (kernel == nullptr) return 1;
      all.push_back({mode, oracle_errors(points, *kernel, {}), Batch(*kernel, points).time()});
    }
    print(row, all);
  }
  return 0;
}
