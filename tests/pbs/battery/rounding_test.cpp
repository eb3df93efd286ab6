#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/pbs/battery/lobe_kernels.h"

namespace nacre {
namespace {

bool full_run() { return std::getenv("NACRE_TEST_FULL") != nullptr; }

/// Relative errors of one output, the denominator at least a millionth of the
/// largest value of the configuration.
class Errors {
 public:
  void add(const std::vector<float>& computed, const std::vector<double>& exact) {
    double peak = 1e-30;
    for (const double x : exact) peak = std::max(peak, std::abs(x));
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double scale = std::max(std::abs(exact[i]), 1e-6 * peak);
      errors_.push_back(std::abs(computed[i] - exact[i]) / scale);
    }
  }
  void add(double error) { errors_.push_back(error); }
  /// The error that a fraction of all stays below.
  double quantile(double fraction) {
    if (errors_.empty()) return 0.0;
    std::ranges::sort(errors_);
    const double last = static_cast<double>(errors_.size() - 1);
    return errors_[static_cast<std::size_t>(std::ceil(fraction * last))];
  }

 private:
  std::vector<double> errors_;
};

struct LobeErrors {
  Errors f, pdf, weight, wi;
};

/// The machine code against the same lobe recorded at `precise` and run in
/// double precision: what rounding and the mode's approximations do.
class Comparison {
 public:
  Comparison(const LobeCase& row, Accuracy accuracy)
      : count_(row.slow_in_double && !full_run() ? 400 : 2000) {
    LobePrograms machine = lobe_programs(row, accuracy);
    evaluate_ = lobe_kernel(std::move(machine.evaluate), accuracy);
    sample_ = lobe_kernel(std::move(machine.sample), accuracy);
    LobePrograms oracle = lobe_programs(row, Accuracy::precise);
    exact_evaluate_ = make_reference(std::move(oracle.evaluate));
    exact_sample_ = make_reference(std::move(oracle.sample));
  }

  void add(float roughness, double angle, LobeErrors& errors) const {
    Columns columns = lobe_columns(roughness);
    set_directions(columns, "wo", {direction(angle)});
    set_random(columns, count_, 11);
    const Columns s = run(*sample_, columns);
    const DoubleColumns exact = run_double(*exact_sample_, columns);
    std::vector<Direction> wi;
    std::vector<float> weight;
    std::vector<double> exact_weight;
    for (std::size_t i = 0; i < count_; ++i) {
      if (s.at("pdf")[i] <= 0.0f || exact.at("pdf")[i] <= 0.0) continue;
      wi.push_back({s.at("wi.x")[i], s.at("wi.y")[i], s.at("wi.z")[i]});
      weight.push_back(s.at("weight.x")[i]);
      exact_weight.push_back(exact.at("weight.x")[i]);
      errors.wi.add(std::hypot(wi.back().x - exact.at("wi.x")[i], wi.back().y - exact.at("wi.y")[i],
                               wi.back().z - exact.at("wi.z")[i]));
    }
    if (wi.empty()) return;
    errors.weight.add(weight, exact_weight);
    for (const char* name : {"u.x", "u.y", "u.z"}) columns.erase(name);
    set_directions(columns, "wi", wi);
    const Columns e = run(*evaluate_, columns);
    const DoubleColumns d = run_double(*exact_evaluate_, columns);
    errors.f.add(e.at("f.x"), d.at("f.x"));
    errors.pdf.add(e.at("pdf"), d.at("pdf"));
  }

 private:
  std::size_t count_;  ///< Of each roughness and angle.
  std::shared_ptr<const Kernel> evaluate_, sample_;
  std::unique_ptr<ReferenceKernel> exact_evaluate_, exact_sample_;
};

void report(const std::string& name, LobeErrors& errors, const RoundingBounds& bounds) {
  std::string line = "| " + name;
  const auto one = [&](const char* what, Errors& each, double bound) {
    const double most = each.quantile(1.0);
    const double usual = each.quantile(0.999);
    line += fmt::format(" | {:.1e} | {:.1e}", most, usual);
    testing::Test::RecordProperty(std::string(what) + "_max", fmt::format("{:.3e}", most));
    testing::Test::RecordProperty(std::string(what) + "_p999", fmt::format("{:.3e}", usual));
    EXPECT_LE(usual, bound) << what;
  };
  one("f", errors.f, bounds.value);
  one("pdf", errors.pdf, bounds.value);
  one("weight", errors.weight, bounds.weight);
  one("wi", errors.wi, bounds.direction);
  fmt::print("{} |\n", line);
}

class Rounding : public testing::TestWithParam<std::tuple<LobeCase, Accuracy>> {};

// Prints a row of a Markdown table: lobe and mode, then largest and 99.9 % error of
// f, pdf, weight (relative) and wi (length of the difference). As JSON: --gtest_output=json.
TEST_P(Rounding, MachineCodeIsCloseToDoublePrecision) {
  const auto& [row, accuracy] = GetParam();
  const Comparison comparison(row, accuracy);
  LobeErrors errors;
  for (const float roughness : {0.05f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    for (const double angle : {0.0, 30.0, 60.0, 80.0, 85.0, 160.0}) {
      comparison.add(roughness, angle, errors);
    }
  }
  report(row.name + " " + std::string(accuracy_name(accuracy)), errors,
         accuracy == Accuracy::fast ? row.fast : row.standard);
}

std::string case_name(const testing::TestParamInfo<std::tuple<LobeCase, Accuracy>>& info) {
  return std::get<0>(info.param).name + "_" + std::string(accuracy_name(std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(All, Rounding,
                         testing::Combine(testing::ValuesIn(lobe_cases()),
                                          testing::Values(Accuracy::standard, Accuracy::fast)),
                         case_name);

}  // namespace
}  // namespace nacre
