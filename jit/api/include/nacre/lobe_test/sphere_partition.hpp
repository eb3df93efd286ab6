/// \file
/// The sphere in cells: part of <nacre/lobe_test.hpp>.
#ifndef NACRE_LOBE_TEST_SPHERE_PARTITION_HPP
#define NACRE_LOBE_TEST_SPHERE_PARTITION_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <nacre/lobe_test/direction.hpp>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {

/// The sphere cut into cells over which pdf and f are integrated: a grid in
/// cos(theta) and phi about the y axis (a lobe at the pole, where mirrors look
/// along the normal, would need cells as thin as needles), cut in four wherever the integral is not
/// exact enough to be compared with `samples` random samples, where a cell holds more than a
/// 300th of them, or where there is more of the pilot than the integral explains: a narrow lobe may
/// reach into a corner of a cell without any node of the quadrature. Exact enough: Gauss-Legendre
/// quadrature of a cell and of its quarters differ by less than a 100th of the samples' deviation.
class SpherePartition {
 public:
  struct Densities {
    std::vector<float> pdf, f;  ///< f: times the cosine.
  };
  using Evaluate = std::function<Densities(const std::vector<Direction>&)>;
  /// `pilot`: directions near which there may be something to see, some that are drawn by pdf;
  /// others than those that are counted in the cells, which would be cut around what chance has put
  /// together.
  SpherePartition(const Evaluate& evaluate, const std::vector<Direction>& pilot, double samples);

  std::size_t cells() const { return leaf_pdf_.size(); }
  std::size_t find(Direction w) const { return cells_[find_cell(place(w))].leaf; }
  double pdf(std::size_t cell) const { return leaf_pdf_[cell]; }
  double pdf_integral() const;
  double f_integral() const;
  /// Whether there is far more at `w` than at any node of its cell: quadrature has missed a lobe
  /// that is as thin as a needle there.
  bool is_unseen(Direction w, double pdf) const {
    return pdf > 4.0 * cells_[find_cell(place(w))].most_pdf;
  }

 private:
  struct Cell {
    double z0, z1, phi0, phi1;
    double pdf = 0.0, f = 0.0;
    double most_pdf = 0.0;  ///< At a node.
    std::size_t child = 0;  ///< The first of four; 0: a leaf.
    std::size_t leaf = 0;
    Cell(double z0_, double z1_, double phi0_, double phi1_)
        : z0(z0_), z1(z1_), phi0(phi0_), phi1(phi1_) {}
  };
  struct Place {
    double z, phi;
  };
  static constexpr double pi = 3.14159265358979323846;
  static constexpr int rows = 8, columns = 16;
  static constexpr int most_levels = 22;
  static constexpr int levels_of_corners = 10;  ///< Cells below are no larger than 2e-4.
  static constexpr double pieces = 300.0;
  static constexpr std::size_t most_cells = std::size_t{1} << 18;  ///< Of rings at the horizon.

  /// Gauss-Legendre on [0, 1], six nodes (Abramowitz and Stegun, 25.4.30).
  static constexpr std::array<double, 6> node{0.0337652428984240, 0.1693953067668678,
                                              0.3806904069584016, 0.6193095930415985,
                                              0.8306046932331323, 0.9662347571015760};
  static constexpr std::array<double, 6> node_weight{0.0856622461895852, 0.1803807865240693,
                                                     0.2339569672863455, 0.2339569672863455,
                                                     0.1803807865240693, 0.0856622461895852};

  static Direction at(double z, double phi);
  static Place place(Direction w);
  std::size_t find_cell(Place place) const;
  void split(std::size_t parent);
  void integrate(const Evaluate& evaluate, std::size_t first);
  bool converged(const Cell& parent) const;
  /// Whether a cell has some of the pilot, but twenty times less to show for it.
  bool misses(const Cell& cell, double seen, std::size_t pilot) const {
    return seen > 20.0 * cell.pdf * static_cast<double>(pilot);
  }

  std::vector<Cell> cells_;
  std::vector<double> leaf_pdf_;
  double samples_;
};

inline Direction SpherePartition::at(double z, double phi) {
  const double sine = std::sqrt((1.0 - z) * (1.0 + z));
  return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(z),
          static_cast<float>(sine * std::sin(phi))};
}

inline SpherePartition::SpherePartition(const Evaluate& evaluate,
                                        const std::vector<Direction>& pilot, double samples)
    : samples_(samples) {
  constexpr double turn = 2.0 * pi;
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      cells_.emplace_back(-1.0 + 2.0 * i / rows, -1.0 + 2.0 * (i + 1) / rows, turn * k / columns,
                          turn * (k + 1) / columns);
    }
  }
  integrate(evaluate, 0);
  std::vector<std::size_t> pending(cells_.size());
  for (std::size_t i = 0; i < pending.size(); ++i) pending[i] = i;
  for (int level = 0; level < most_levels && !pending.empty(); ++level) {
    if (cells_.size() > most_cells) break;
    const std::size_t first = cells_.size();
    for (const std::size_t parent : pending) split(parent);
    integrate(evaluate, first);
    std::vector<double> seen(cells_.size(), 0.0);
    for (const Direction& w : pilot) seen[find_cell(place(w))] += 1.0;
    std::vector<std::size_t> next;
    for (const std::size_t parent : pending) {
      const bool fine = converged(cells_[parent]);
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t child = cells_[parent].child + k;
        const bool large = std::max(cells_[child].pdf, cells_[child].f) > 1.0 / pieces ||
                           seen[child] * pieces > static_cast<double>(pilot.size()) + 20 * pieces;
        const bool corner =
            level < levels_of_corners && misses(cells_[child], seen[child], pilot.size());
        if (!fine || large || corner) next.push_back(child);
      }
    }
    pending = std::move(next);
  }
  for (Cell& cell : cells_) {
    if (cell.child != 0) continue;
    cell.leaf = leaf_pdf_.size();
    leaf_pdf_.push_back(cell.pdf);
  }
}

inline void SpherePartition::split(std::size_t parent) {
  const Cell whole = cells_[parent];
  const double z = 0.5 * (whole.z0 + whole.z1);
  const double phi = 0.5 * (whole.phi0 + whole.phi1);
  cells_[parent].child = cells_.size();
  cells_.emplace_back(whole.z0, z, whole.phi0, phi);
  cells_.emplace_back(whole.z0, z, phi, whole.phi1);
  cells_.emplace_back(z, whole.z1, whole.phi0, phi);
  cells_.emplace_back(z, whole.z1, phi, whole.phi1);
}

inline void SpherePartition::integrate(const Evaluate& evaluate, std::size_t first) {
  std::vector<Direction> wi;
  for (std::size_t c = first; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    for (const double a : node) {
      for (const double b : node) {
        wi.push_back(
            at(cell.z0 + a * (cell.z1 - cell.z0), cell.phi0 + b * (cell.phi1 - cell.phi0)));
      }
    }
  }
  const Densities values = evaluate(wi);
  std::size_t k = 0;
  for (std::size_t c = first; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    const double area = (cell.z1 - cell.z0) * (cell.phi1 - cell.phi0);
    for (const double a : node_weight) {
      for (const double b : node_weight) {
        cell.pdf += values.pdf[k] * a * b * area;
        cell.most_pdf = std::max(cell.most_pdf, double(values.pdf[k]));
        cell.f += values.f[k] * a * b * area;
        ++k;
      }
    }
  }
}

inline bool SpherePartition::converged(const Cell& parent) const {
  double pdf = 0.0, f = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    pdf += cells_[parent.child + k].pdf;
    f += cells_[parent.child + k].f;
  }
  const auto close = [&](double a, double b) {
    return std::abs(a - b) * samples_ <= 0.01 * std::sqrt(std::max(b * samples_, 1.0));
  };
  return close(parent.pdf, pdf) && close(parent.f, f);
}

inline SpherePartition::Place SpherePartition::place(Direction w) {
  const double x = w.x, y = w.z, z = w.y;
  const double across2 = x * x + y * y;
  const double length = std::sqrt(across2 + z * z);
  // 1 - |cos| by the sine: float directions near the pole have no digits in z.
  const double rest = across2 / (length * (length + std::abs(z)));
  const double phi = std::atan2(y, x);
  return {std::copysign(1.0 - rest, z), phi < 0.0 ? phi + 2.0 * pi : phi};
}

inline std::size_t SpherePartition::find_cell(Place at) const {
  const auto index = [](double t, int n) { return std::clamp(static_cast<int>(t * n), 0, n - 1); };
  std::size_t cell = static_cast<std::size_t>(index(0.5 * (at.z + 1.0), rows) * columns +
                                              index(at.phi * 0.5 / pi, columns));
  while (cells_[cell].child != 0) {
    const Cell& low = cells_[cells_[cell].child];
    cell = cells_[cell].child + (at.z < low.z1 ? 0u : 2u) + (at.phi < low.phi1 ? 0u : 1u);
  }
  return cell;
}

inline double SpherePartition::pdf_integral() const {
  double sum = 0.0;
  for (const double pdf : leaf_pdf_) sum += pdf;
  return sum;
}

inline double SpherePartition::f_integral() const {
  double sum = 0.0;
  for (const Cell& cell : cells_) sum += cell.child == 0 ? cell.f : 0.0;
  return sum;
}

}  // namespace v0
}  // namespace nacre

#endif
