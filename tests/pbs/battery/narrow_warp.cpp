#include "tests/pbs/battery/narrow_warp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace nacre {

namespace {

constexpr double pi = std::numbers::pi;

struct Vector {
  double x, y, z;
};
Vector vector(Direction w) { return {w.x, w.y, w.z}; }
Direction narrowed(Vector v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double square(double x) { return x * x; }

class FacetWarp final : public NarrowWarp {
 public:
  FacetWarp(Direction wo, double alpha_x, double alpha_y, double index, bool turned)
      : alpha_x_(alpha_x), alpha_y_(alpha_y), turned_(turned), wo_(vector(wo)) {
    up_ = wo.z < 0.0f ? -1.0 : 1.0;
    wo_.z *= up_;
    eta_ = wo.z < 0.0f ? 1.0 / index : index;
    const double length = std::sqrt(dot(wo_, wo_));
    wo_ = {wo_.x / length, wo_.y / length, wo_.z / length};
  }

  std::size_t spheres() const override { return 2; }

  Place place(Direction given) const override {
    Vector wi = flipped(vector(given));
    const bool passes = wi.z < 0.0;
    if (!passes) wi = around(wi);
    const double eta = passes ? eta_ : 1.0;
    const double z = wo_.z + eta * wi.z;
    const double x = (wo_.x + eta * wi.x) / z / alpha_x_;
    const double y = (wo_.y + eta * wi.y) / z / alpha_y_;
    const double r2 = x * x + y * y;
    if (!(r2 < 1e30)) return {passes, {0.0f, 1.0f, 0.0f}};
    return {passes,
            narrowed({2.0 * x / (1.0 + r2), (r2 - 1.0) / (1.0 + r2), 2.0 * y / (1.0 + r2)})};
  }

  Back back(Place at) const override {
    const Vector on = vector(at.on);
    // 1 - y without cancellation near the pole that stands for grazing facets.
    const double rest = on.y > 0.0 ? (on.x * on.x + on.z * on.z) / (1.0 + on.y) : 1.0 - on.y;
    if (!(rest > 0.0)) return {};
    const double x = alpha_x_ * on.x / rest, y = alpha_y_ * on.z / rest;
    const double r2 = (on.x * on.x + on.z * on.z) / square(rest);
    const double cosine = 1.0 / std::sqrt(1.0 + x * x + y * y);
    const Vector h{x * cosine, y * cosine, cosine};
    // Of facets: d slopes = d omega / cos^3; of the projection: d plane = (1 + r^2)^2 / 4.
    const double facets = alpha_x_ * alpha_y_ * cosine * cosine * cosine * 0.25 * square(1.0 + r2);
    const double cos_o = dot(wo_, h);
    if (!(cos_o > 0.0)) return {};
    Back result = at.sphere == 0 ? reflected(h, cos_o) : refracted(h, cos_o);
    result.scale *= facets;
    return result;
  }

 private:
  Vector flipped(Vector v) const { return {v.x, v.y, v.z * up_}; }
  Vector around(Vector v) const { return turned_ ? Vector{-v.x, -v.y, v.z} : v; }

  Back reflected(Vector h, double cos_o) const {
    const Vector wi{2.0 * cos_o * h.x - wo_.x, 2.0 * cos_o * h.y - wo_.y,
                    2.0 * cos_o * h.z - wo_.z};
    if (!(wi.z > 0.0)) return {};
    return {narrowed(flipped(around(wi))), 4.0 * cos_o};
  }
  // Walter et al. 2007, "Microfacet Models for Refraction", equations 16, 17 and 40.
  Back refracted(Vector h, double cos_o) const {
    const double sine2 = (1.0 - square(cos_o)) / square(eta_);
    if (!(sine2 < 1.0)) return {};
    const double cos_i = std::sqrt(1.0 - sine2);
    const double along = cos_o / eta_ - cos_i;
    const Vector wi{along * h.x - wo_.x / eta_, along * h.y - wo_.y / eta_,
                    along * h.z - wo_.z / eta_};
    if (!(wi.z < 0.0)) return {};
    return {narrowed(flipped(wi)), square(cos_o - eta_ * cos_i) / (square(eta_) * cos_i)};
  }

  double alpha_x_, alpha_y_, eta_, up_;
  bool turned_;
  Vector wo_;
};

/// The mean of Cauchy distributions on an interval, and a uniform one.
class Spread {
 public:
  struct Peak {
    double centre, width;
  };
  Spread(double low, double high, std::vector<Peak> peaks)
      : low_(low), high_(high), peaks_(std::move(peaks)) {}

  /// The share that lies below x, and its derivative.
  double below(double x) const {
    double sum = (x - low_) / (high_ - low_);
    for (const Peak& peak : peaks_) {
      sum += (angle(peak, x) - angle(peak, low_)) / (angle(peak, high_) - angle(peak, low_));
    }
    return sum / static_cast<double>(peaks_.size() + 1);
  }
  double density(double x) const {
    double sum = 1.0 / (high_ - low_);
    for (const Peak& peak : peaks_) {
      const double t = (x - peak.centre) / peak.width;
      sum += 1.0 / (peak.width * (1.0 + t * t) * (angle(peak, high_) - angle(peak, low_)));
    }
    return sum / static_cast<double>(peaks_.size() + 1);
  }
  double inverse(double share) const {
    double low = low_, high = high_;
    for (int i = 0; i < 44; ++i) {
      const double middle = 0.5 * (low + high);
      (below(middle) < share ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

 private:
  static double angle(const Peak& peak, double x) {
    return std::atan((x - peak.centre) / peak.width);
  }

  double low_, high_;
  std::vector<Peak> peaks_;
};

std::vector<Spread::Peak> elevations(Direction wo, const FibreWidths& widths) {
  std::vector<Spread::Peak> peaks;
  const double elevation = std::asin(std::clamp(double(wo.x), -1.0, 1.0));
  for (int way = 0; way < 3; ++way) {
    const double mirrored = -(elevation + (2.0 - 3.0 * way) * widths.tilt);
    peaks.push_back({std::clamp(mirrored, -0.5 * pi, 0.5 * pi), std::sqrt(widths.variance[way])});
  }
  // Of all longer ways together, which no tilt turns.
  peaks.push_back({-elevation, std::sqrt(widths.variance[2])});
  return peaks;
}

/// About wo's azimuth. Marschner et al. 2003, "Light Scattering from Human Hair Fibers", section 4.
std::vector<Spread::Peak> azimuths(Direction wo, const FibreWidths& widths) {
  const double cosine = std::hypot(double(wo.y), double(wo.z));
  const double index = std::sqrt(square(widths.index) - square(wo.x)) / cosine;
  const double outside = std::asin(std::clamp(-wo.y / cosine, -1.0, 1.0));
  const double inside = std::asin(std::sin(outside) / index);
  std::vector<Spread::Peak> peaks;
  for (int way = 0; way < 3; ++way) {
    const double turn = 2.0 * way * inside - 2.0 * outside + way * pi;
    for (const double turns : {-1.0, 0.0, 1.0}) {
      peaks.push_back({std::remainder(turn, 2.0 * pi) + turns * 2.0 * pi, widths.scale[way]});
    }
  }
  std::erase_if(peaks, [](const Spread::Peak& peak) { return std::abs(peak.centre) > 1.1 * pi; });
  return peaks;
}

class FibreWarp final : public NarrowWarp {
 public:
  FibreWarp(Direction wo, const FibreWidths& widths)
      : elevation_(-0.5 * pi, 0.5 * pi, elevations(wo, widths)),
        turn_(-pi, pi, azimuths(wo, widths)),
        azimuth_(std::atan2(double(wo.z), double(wo.y))) {}

  std::size_t spheres() const override { return 1; }

  Place place(Direction wi) const override {
    const double across = std::hypot(double(wi.y), double(wi.z));
    const double theta = std::atan2(double(wi.x), across);
    const double turn = std::remainder(std::atan2(double(wi.z), double(wi.y)) - azimuth_, 2.0 * pi);
    const double y = 2.0 * elevation_.below(theta) - 1.0, phi = 2.0 * pi * turn_.below(turn);
    const double radius = std::sqrt(std::max((1.0 - y) * (1.0 + y), 0.0));
    return {0, narrowed({radius * std::cos(phi), y, radius * std::sin(phi)})};
  }

  Back back(Place at) const override {
    double share = std::atan2(double(at.on.z), double(at.on.x)) / (2.0 * pi);
    if (share < 0.0) share += 1.0;
    const double theta = elevation_.inverse(0.5 * (at.on.y + 1.0)), turn = turn_.inverse(share);
    const double phi = azimuth_ + turn, cosine = std::cos(theta);
    const Vector wi{std::sin(theta), cosine * std::cos(phi), cosine * std::sin(phi)};
    return {narrowed(wi), cosine / (4.0 * pi * elevation_.density(theta) * turn_.density(turn))};
  }

 private:
  Spread elevation_, turn_;
  double azimuth_;
};

}  // namespace

std::unique_ptr<NarrowWarp> facet_warp(Direction wo, double alpha_x, double alpha_y, double index,
                                       bool turned) {
  return std::make_unique<FacetWarp>(wo, alpha_x, alpha_y, index, turned);
}

std::unique_ptr<NarrowWarp> fibre_warp(Direction wo, const FibreWidths& widths) {
  return std::make_unique<FibreWarp>(wo, widths);
}

}  // namespace nacre
