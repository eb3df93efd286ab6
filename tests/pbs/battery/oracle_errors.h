#pragma once

#include <memory>
#include <vector>

#include "runtime/kernel.h"
#include "tests/pbs/battery/oracle_case.h"
#include "tests/support/run_kernel.h"

namespace nacre {

/// Views of a lobe and what its formula says, as floats can be told them.
struct OraclePoints {
  Columns columns;             ///< Inputs of the kernel, a value for each point.
  std::vector<double> f, pdf;  ///< Of the formula; as many as points, as are the others.
  std::vector<double> albedo;  ///< NaN: not known.
  std::vector<double> f_scale, pdf_scale;  ///< What errors are relative to.
  std::vector<double> width;               ///< OracleCase::width.
};
/// `wi_per_view` of each, half of them where the lobe is bright.
OraclePoints oracle_points(const OracleCase& row, std::size_t views, std::size_t wi_per_view,
                           std::uint64_t seed);

/// One output, in the order of points.
class ErrorList {
 public:
  void add(double error, std::size_t point) {
    errors_.push_back(error);
    if (error > most_) most_ = error, worst_ = point;
  }
  double most() const { return most_; }
  /// What 999 of 1000 do not exceed.
  double usual() const { return quantile(0.999); }
  double mean() const;
  /// The point of the largest.
  std::size_t worst() const { return worst_; }

 private:
  double quantile(double fraction) const;
  std::vector<double> errors_;
  double most_ = 0.0;
  std::size_t worst_ = 0;
};

/// Relative errors of f and pdf where the digits of the directions tell them; everywhere, the same
/// by what the gate allows there; and of the albedo, of the light.
struct OracleErrors {
  ErrorList f, pdf, f_by_gate, pdf_by_gate, albedo;
};

/// f, pdf and the albedo in one kernel of machine code. Null, and a failure of the running test,
/// where there is none.
std::shared_ptr<const Kernel> oracle_kernel(const OracleCase& row, Accuracy accuracy);
OracleErrors oracle_errors(const OraclePoints& points, const Kernel& kernel,
                           const OracleGate& gate);

}  // namespace nacre
