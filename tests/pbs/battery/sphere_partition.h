#pragma once

#include <functional>
#include <vector>

#include "tests/pbs/battery/lobe_kernels.h"

namespace nacre {

/// The sphere cut into cells over which pdf and f are integrated: a grid in
/// cos(theta) and phi about the y axis (a lobe at the pole, where mirrors look
/// along the normal, would need cells as thin as needles), cut in four wherever the integral is not
/// exact enough to be compared with `samples` random samples, or where a cell holds more than a
/// 300th of them. Exact enough: Gauss-Legendre quadrature of a cell and of its quarters differ by
/// less than a 100th of the samples' deviation.
class SpherePartition {
 public:
  using Evaluate = std::function<Evaluated(const std::vector<Direction>&)>;
  /// `pilot`: directions near which there may be something to see.
  SpherePartition(const Evaluate& evaluate, const std::vector<Direction>& pilot, double samples);

  std::size_t cells() const { return leaves_; }
  std::size_t find(Direction w) const;
  double pdf(std::size_t cell) const { return leaf_pdf_[cell]; }
  double pdf_integral() const;
  double f_integral() const;

 private:
  struct Cell {
    double z0, z1, phi0, phi1;
    double pdf = 0.0, f = 0.0;
    std::size_t child = 0;  ///< The first of four; 0: a leaf.
    std::size_t leaf = 0;
  };
  struct Place {
    double z, phi;
  };
  static Place place(Direction w);
  std::size_t find_cell(Place place) const;
  void split(std::size_t parent);
  void integrate(const Evaluate& evaluate, std::size_t first);
  bool converged(const Cell& parent) const;

  std::vector<Cell> cells_;
  std::vector<double> leaf_pdf_;
  std::size_t leaves_ = 0;
  double samples_;
};

}  // namespace nacre
