#include "tests/pbs/battery/sphere_partition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre {

namespace {

constexpr int rows = 8, columns = 16;
constexpr int most_levels = 22;
constexpr double pieces = 300.0;

/// Gauss-Legendre on [0, 1], six nodes (Abramowitz and Stegun, 25.4.30).
constexpr int nodes = 6;
constexpr double node[nodes] = {0.0337652428984240, 0.1693953067668678, 0.3806904069584016,
                                0.6193095930415985, 0.8306046932331323, 0.9662347571015760};
constexpr double node_weight[nodes] = {0.0856622461895852, 0.1803807865240693, 0.2339569672863455,
                                       0.2339569672863455, 0.1803807865240693, 0.0856622461895852};

Direction at(double z, double phi) {
  const double sine = std::sqrt((1.0 - z) * (1.0 + z));
  return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(z),
          static_cast<float>(sine * std::sin(phi))};
}

}  // namespace

SpherePartition::SpherePartition(const Evaluate& evaluate, const std::vector<Direction>& pilot,
                                 double samples)
    : samples_(samples) {
  constexpr double turn = 2.0 * std::numbers::pi;
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      cells_.push_back({.z0 = -1.0 + 2.0 * i / rows,
                        .z1 = -1.0 + 2.0 * (i + 1) / rows,
                        .phi0 = turn * k / columns,
                        .phi1 = turn * (k + 1) / columns});
    }
  }
  integrate(evaluate, 0);
  std::vector<std::size_t> pending(cells_.size());
  for (std::size_t i = 0; i < pending.size(); ++i) pending[i] = i;
  for (int level = 0; level < most_levels && !pending.empty(); ++level) {
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
        if (!fine || large) next.push_back(child);
      }
    }
    pending = std::move(next);
  }
  for (Cell& cell : cells_) {
    if (cell.child != 0) continue;
    cell.leaf = leaves_++;
    leaf_pdf_.push_back(cell.pdf);
  }
}

void SpherePartition::split(std::size_t parent) {
  const Cell whole = cells_[parent];
  const double z = 0.5 * (whole.z0 + whole.z1);
  const double phi = 0.5 * (whole.phi0 + whole.phi1);
  cells_[parent].child = cells_.size();
  cells_.push_back({.z0 = whole.z0, .z1 = z, .phi0 = whole.phi0, .phi1 = phi});
  cells_.push_back({.z0 = whole.z0, .z1 = z, .phi0 = phi, .phi1 = whole.phi1});
  cells_.push_back({.z0 = z, .z1 = whole.z1, .phi0 = whole.phi0, .phi1 = phi});
  cells_.push_back({.z0 = z, .z1 = whole.z1, .phi0 = phi, .phi1 = whole.phi1});
}

void SpherePartition::integrate(const Evaluate& evaluate, std::size_t first) {
  std::vector<Direction> wi;
  for (std::size_t c = first; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    for (const double a : node) {
      for (const double b : node) {
        wi.push_back(at(std::lerp(cell.z0, cell.z1, a), std::lerp(cell.phi0, cell.phi1, b)));
      }
    }
  }
  const Evaluated values = evaluate(wi);
  std::size_t k = 0;
  for (std::size_t c = first; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    const double area = (cell.z1 - cell.z0) * (cell.phi1 - cell.phi0);
    for (const double a : node_weight) {
      for (const double b : node_weight) {
        cell.pdf += values.pdf[k] * a * b * area;
        cell.f += values.f[k] * a * b * area;
        ++k;
      }
    }
  }
}

bool SpherePartition::converged(const Cell& parent) const {
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

SpherePartition::Place SpherePartition::place(Direction w) {
  const double x = w.x, y = w.z, z = w.y;
  const double across2 = x * x + y * y;
  const double length = std::sqrt(across2 + z * z);
  // 1 - |cos| by the sine: float directions near the pole have no digits in z.
  const double rest = across2 / (length * (length + std::abs(z)));
  const double phi = std::atan2(y, x);
  return {std::copysign(1.0 - rest, z), phi < 0.0 ? phi + 2.0 * std::numbers::pi : phi};
}

std::size_t SpherePartition::find_cell(Place at) const {
  const auto index = [](double t, int n) { return std::clamp(static_cast<int>(t * n), 0, n - 1); };
  std::size_t cell = static_cast<std::size_t>(index(0.5 * (at.z + 1.0), rows) * columns +
                                              index(at.phi * 0.5 / std::numbers::pi, columns));
  while (cells_[cell].child != 0) {
    const Cell& low = cells_[cells_[cell].child];
    cell = cells_[cell].child + (at.z < low.z1 ? 0u : 2u) + (at.phi < low.phi1 ? 0u : 1u);
  }
  return cell;
}

std::size_t SpherePartition::find(Direction w) const { return cells_[find_cell(place(w))].leaf; }

double SpherePartition::pdf_integral() const {
  double sum = 0.0;
  for (const double pdf : leaf_pdf_) sum += pdf;
  return sum;
}

double SpherePartition::f_integral() const {
  double sum = 0.0;
  for (const Cell& cell : cells_) sum += cell.child == 0 ? cell.f : 0.0;
  return sum;
}

}  // namespace nacre
