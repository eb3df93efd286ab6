/// \file
/// A material looked at from one direction: part of <nacre/lobe_test.hpp>.
#ifndef NACRE_LOBE_TEST_TRIAL_HPP
#define NACRE_LOBE_TEST_TRIAL_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <nacre/lobe_test/chi_square.hpp>
#include <nacre/lobe_test/probe.hpp>
#include <nacre/lobe_test/report.hpp>
#include <nacre/lobe_test/sphere_partition.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace nacre {
inline namespace v0 {
namespace detail {

/// The laws of LobeFault for one wo. Those of single numbers come first: where they do not hold,
/// sums of such numbers mean nothing.
class LobeTrial {
 public:
  LobeTrial(LobeProbe& probe, const LobeTestOptions& options, int kinds, Direction wo)
      : probe_(probe), options_(options), kinds_(kinds) {
    view_.wo = wo;
  }

  void run(LobeReport& report) {
    try_anywhere();
    samples_ = probe_.sample(view_.wo, options_.samples, options_.seed);
    again_ = probe_.evaluate({view_.wo}, samples_.wi);
    try_samples();
    if (faults_.empty()) try_integrals();
    if (faults_.empty()) measure_reciprocity();
    report.views.push_back(view_);
    for (LobeFault& fault : faults_) report.faults.push_back(std::move(fault));
  }

 private:
  /// Of a mean, by chance once in 2.6e7.
  static constexpr double deviations = 5.5;
  /// Of quadrature, and of sums of floats.
  static constexpr double rounding = 1e-3;

  std::size_t count() const { return samples_.wi.size(); }
  bool is_valid(std::size_t i) const { return (samples_.flags[i] & NACRE_SAMPLE_VALID) != 0; }
  static bool is_smooth(std::int32_t flags) {
    return (flags & (NACRE_SAMPLE_VALID | NACRE_SAMPLE_DELTA)) == NACRE_SAMPLE_VALID;
  }
  bool is_smooth(std::size_t i) const { return is_smooth(samples_.flags[i]); }
  static double mean(const float* rgb) { return (double(rgb[0]) + rgb[1] + rgb[2]) / 3.0; }

  /// Only the first of each law is kept. `wi`: what shows it.
  void expect(bool holds, const char* law, double found, double expected,
              const Direction* wi = nullptr) {
    const auto is_known = [&](const LobeFault& known) { return known.law == law; };
    if (holds || std::any_of(faults_.begin(), faults_.end(), is_known)) return;
    const auto text_of = [](const char* name, Direction w) {
      char text[96];
      std::snprintf(text, sizeof text, ", %s (%g, %g, %g)", name, double(w.x), double(w.y),
                    double(w.z));
      return std::string(text);
    };
    char text[96];
    std::snprintf(text, sizeof text, "%s: found %.6g, expected %.6g", law, found, expected);
    faults_.push_back({law, view_.wo, found, expected,
                       text + text_of("wo", view_.wo) + (wi != nullptr ? text_of("wi", *wi) : "")});
  }

  /// Directions from all sides, and those that formulas are afraid of.
  void try_anywhere() {
    const Direction wo = view_.wo;
    std::vector<Direction> wi{
        {0, 0, 1},           {0, 0, -1}, wo,        {-wo.x, -wo.y, wo.z}, {-wo.x, -wo.y, -wo.z},
        {wo.x, wo.y, -wo.z}, {1, 0, 0},  {0, -1, 0}};
    for (const double degrees : {89.9, 89.9999, 90.0001, 90.1}) {
      for (const double azimuth : {0.0, 30.0, 210.0}) wi.push_back(direction(degrees, azimuth));
    }
    std::mt19937_64 random(options_.seed);
    const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int i = 0; i < 4096; ++i) {
      const double z = 2.0 * number() - 1.0;
      wi.push_back(direction(std::acos(z) * 57.29577951308232, 360.0 * number()));
    }
    const LobeProbe::Values values = probe_.evaluate({wo}, wi);
    for (std::size_t i = 0; i < wi.size(); ++i) try_values(values, i, wi[i]);
  }

  void try_values(const LobeProbe::Values& values, std::size_t i, Direction wi) {
    const float pdf = values.pdf[i];
    expect(std::isfinite(pdf) && pdf >= 0.0f, "finite", pdf, 0.0, &wi);
    for (std::size_t k = 0; k < 3; ++k) {
      const float f = values.f[3 * i + k];
      expect(std::isfinite(f) && f >= 0.0f, "finite", f, 0.0, &wi);
      expect(f <= 0.0f || pdf > 0.0f, "support", f, 0.0, &wi);
    }
  }

  void try_samples() {
    for (std::size_t i = 0; i < count(); ++i) {
      const float* const weight = samples_.weight.data() + 3 * i;
      const Direction wi = samples_.wi[i];
      if (!is_valid(i)) {
        for (const float lost : {weight[0], weight[1], weight[2], samples_.pdf[i]}) {
          expect(lost == 0.0f, "lost", lost, 0.0, &wi);
        }
        continue;
      }
      for (const float number : {weight[0], weight[1], weight[2], samples_.pdf[i]}) {
        expect(std::isfinite(number) && number >= 0.0f, "finite", number, 0.0, &wi);
      }
      const double length2 = double(wi.x) * wi.x + double(wi.y) * wi.y + double(wi.z) * wi.z;
      expect(std::abs(length2 - 1.0) <= options_.unit_error, "unit", length2, 1.0, &wi);
      try_flags(samples_.flags[i], wi);
      if (!is_smooth(i)) continue;
      try_values(again_, i, wi);
      const double pdf = again_.pdf[i];
      expect(pdf > 0.0 && std::abs(samples_.pdf[i] - pdf) <= options_.weight_error * pdf, "density",
             samples_.pdf[i], pdf, &wi);
      for (std::size_t k = 0; k < 3; ++k) {
        const double expected = again_.f[3 * i + k] / pdf;
        expect(std::abs(weight[k] - expected) <= options_.weight_error * expected + 1e-12, "weight",
               weight[k], expected, &wi);
      }
    }
    try_sides();
  }

  void try_flags(std::int32_t flags, Direction wi) {
    const bool says = (flags & NACRE_SAMPLE_TRANSMISSION) != 0;
    const bool crosses = (wi.z < 0.0f) != (view_.wo.z < 0.0f);
    // At the horizon rounding decides.
    expect(says == crosses || std::abs(wi.z) < 1e-6f, "flags", says, crosses, &wi);
    ++(says ? transmitted_ : reflected_);
  }

  /// Which side a direction is on goes by the geometric normal, what lobes there are by the shading
  /// normal: where a texture bends that some samples of a lobe are on the other side, but not most.
  /// Facets that let light pass reflect it all beyond the critical angle, which is no small one.
  void try_sides() {
    const auto share = [&](std::size_t part) {
      return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(count(), 1));
    };
    const int reflection = NACRE_DIFFUSE_REFLECTION | NACRE_GLOSSY_REFLECTION;
    const int transmission = NACRE_DIFFUSE_TRANSMISSION | NACRE_GLOSSY_TRANSMISSION;
    const bool reflects_totally =
        (kinds_ & NACRE_GLOSSY_TRANSMISSION) != 0 && std::abs(view_.wo.z) < 0.98f;
    if ((kinds_ & reflection) == 0 && !reflects_totally) {
      expect(share(reflected_) < 0.5, "sides", share(reflected_), 0.0);
    }
    if ((kinds_ & transmission) == 0) {
      expect(share(transmitted_) < 0.5, "sides", share(transmitted_), 0.0);
    }
  }

  void try_integrals() {
    const double n = static_cast<double>(count());
    std::size_t valid = 0, smooth = 0;
    double light = 0.0, squares = 0.0;
    double sum[3] = {}, square[3] = {};
    for (std::size_t i = 0; i < count(); ++i) {
      const float* const weight = samples_.weight.data() + 3 * i;
      valid += is_valid(i), smooth += is_smooth(i);
      const double smooth_light = is_smooth(i) ? mean(weight) : 0.0;
      light += smooth_light, squares += smooth_light * smooth_light;
      for (std::size_t k = 0; k < 3; ++k)
        sum[k] += weight[k], square[k] += double(weight[k]) * weight[k];
    }
    view_.valid = static_cast<double>(valid) / n;
    for (std::size_t k = 0; k < 3; ++k) {
      view_.energy[k] = sum[k] / n;
      view_.deviation = std::max(view_.deviation, deviation(sum[k], square[k]));
    }
    if (smooth > 0)
      try_density(static_cast<double>(smooth) / n, light / n, deviation(light, squares));
    try_energy();
  }

  /// Of the mean of numbers with these sums.
  double deviation(double sum, double squares) const {
    const double n = static_cast<double>(count());
    return std::sqrt(std::max(squares / n - sum / n * (sum / n), 0.0) / n);
  }

  /// Others than are counted in cells: those are cut where there are many of these.
  std::vector<Direction> pilot() {
    const LobeProbe::Samples drawn =
        probe_.sample(view_.wo, std::min<std::size_t>(count(), 4096), ~options_.seed);
    std::vector<Direction> smooth;
    for (std::size_t i = 0; i < drawn.wi.size(); ++i) {
      if (is_smooth(drawn.flags[i])) smooth.push_back(drawn.wi[i]);
    }
    return smooth;
  }

  void try_density(double smooth, double light, double light_deviation) {
    const auto evaluate = [&](const std::vector<Direction>& wi) {
      LobeProbe::Values values = probe_.evaluate({view_.wo}, wi);
      SpherePartition::Densities densities{std::move(values.pdf), {}};
      for (std::size_t i = 0; i < wi.size(); ++i) {
        densities.f.push_back(static_cast<float>(mean(values.f.data() + 3 * i)));
      }
      return densities;
    };
    const SpherePartition cells(evaluate, pilot(), double(count()));
    std::size_t unseen = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      unseen += is_smooth(i) && cells.is_unseen(samples_.wi[i], samples_.pdf[i]);
    }
    view_.is_too_thin = unseen > std::max<std::size_t>(2, count() / 10'000);
    if (view_.is_too_thin) return;
    const double chance =
        deviations * std::sqrt(smooth * (1.0 - smooth) / static_cast<double>(count()));
    expect(std::abs(cells.pdf_integral() - smooth) <= rounding + chance, "normalised",
           cells.pdf_integral(), smooth);
    expect(std::abs(cells.f_integral() - light) <=
               rounding * std::max(1.0, light) + deviations * light_deviation,
           "light", light, cells.f_integral());
    std::vector<double> counts(cells.cells(), 0.0), expected;
    for (std::size_t i = 0; i < count(); ++i) {
      if (is_smooth(i)) counts[cells.find(samples_.wi[i])] += 1.0;
    }
    for (std::size_t c = 0; c < cells.cells(); ++c) expected.push_back(cells.pdf(c));
    view_.chi_square = chi_square_probability(counts, expected);
    const double level = level_of_one(static_cast<double>(options_.wo.size()));
    expect(view_.chi_square > level, "samples", view_.chi_square, level);
  }

  void try_energy() {
    const std::array<float, 3> albedo = probe_.albedo(view_.wo);
    const double chance = rounding + deviations * view_.deviation;
    for (std::size_t k = 0; k < 3; ++k) {
      view_.albedo[k] = albedo[k];
      expect(std::isfinite(albedo[k]) && albedo[k] >= 0.0f, "finite", albedo[k], 0.0);
      expect(view_.energy[k] <= options_.most_energy + chance, "energy", view_.energy[k],
             options_.most_energy);
      const double expected = std::min(view_.energy[k], 1.0);
      expect(std::abs(albedo[k] - expected) <= options_.albedo_error + chance, "albedo", albedo[k],
             expected);
    }
  }

  void measure_reciprocity() {
    std::vector<Direction> wi;
    std::vector<double> forward;
    for (std::size_t i = 0; i < count() && wi.size() < 2000; ++i) {
      if (!is_smooth(i) || std::abs(samples_.wi[i].z) < 1e-3f) continue;
      wi.push_back(samples_.wi[i]);
      forward.push_back(mean(again_.f.data() + 3 * i) * std::abs(double(view_.wo.z)));
    }
    if (wi.empty()) return;
    const LobeProbe::Values back = probe_.evaluate(wi, std::vector<Direction>(wi.size(), view_.wo));
    for (std::size_t i = 0; i < wi.size(); ++i) {
      const double backward = mean(back.f.data() + 3 * i) * std::abs(double(wi[i].z));
      if (std::max(forward[i], backward) < 1e-6) continue;
      const double ratio = forward[i] / backward;
      view_.reciprocity = std::max({view_.reciprocity, ratio, 1.0 / ratio});
    }
  }

  LobeProbe& probe_;
  const LobeTestOptions& options_;
  int kinds_;
  LobeView view_;
  std::size_t reflected_ = 0, transmitted_ = 0;  ///< Of the samples.
  std::vector<LobeFault> faults_;
  LobeProbe::Samples samples_;
  LobeProbe::Values again_;
};

}  // namespace detail
}  // namespace v0
}  // namespace nacre

#endif
