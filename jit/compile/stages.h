#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "jit/compile/stage_report.h"

namespace nacre {

/// Runs stages, each timed and reported.
class Stages {
 public:
  /// `reports` may be null: then nobody wants to know.
  explicit Stages(std::vector<StageReport>* reports) : reports_(reports) {}

  /// What `make` gives; `describe(result, report)` says of it what is to be known.
  template <class Make, class Describe>
  auto run(std::string name, Make&& make, Describe&& describe) {
    const auto start = std::chrono::steady_clock::now();
    auto result = make();
    if (reports_ == nullptr) return result;
    StageReport report;
    report.name = std::move(name);
    report.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    describe(result, report);
    reports_->push_back(std::move(report));
    return result;
  }

 private:
  std::vector<StageReport>* reports_;
};

}  // namespace nacre
