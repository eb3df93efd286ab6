#include "tests/pbs/battery/oracle_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/pbs/battery/lobe_kernels.h"

namespace nacre {

namespace {

using reference::Scattered;
using reference::Vec;

double as_float(double x) { return static_cast<float>(x); }
Vec as_floats(Vec v) { return {as_float(v.x), as_float(v.y), as_float(v.z)}; }
Vec turned_over(Vec v) { return {v.x, v.y, -v.z}; }

void put(Columns& columns, const std::string& name, Vec v) {
  columns[name + ".x"].push_back(static_cast<float>(v.x));
  columns[name + ".y"].push_back(static_cast<float>(v.y));
  columns[name + ".z"].push_back(static_cast<float>(v.z));
}

OracleView draw_view(const OracleCase& row, std::size_t count, Random& random) {
  OracleView view{};
  row.draw(random, view);
  visit_inputs(view.inputs, [](const char*, double& x) { x = as_float(x); });
  view.wo = as_floats(view.wo);
  const bool inside = view.wo.z < 0.0;
  const Vec above = inside ? turned_over(view.wo) : view.wo;
  for (std::size_t i = 0; i < count; ++i) {
    Vec wi{};
    if (i % 2 == 0) {
      wi = row.toward(random, view.inputs, above, inside);
      if (inside) wi = turned_over(wi);
    } else {
      const double z = 2.0 * uniform(random) - 1.0, phi = 2.0 * std::numbers::pi * uniform(random);
      const double across = std::sqrt(1.0 - z * z);
      wi = {across * std::cos(phi), across * std::sin(phi), z};
    }
    view.wi.push_back(as_floats(wi));
  }
  return view;
}

/// Errors are relative, but of no less than this part of the largest value of a view: of f and of
/// the density alike, for what is black next to it is not seen.
constexpr double floor_of_peak = 1e-6;

/// Where no more than this may be of the digits of the directions, errors are the lobe's. (What
/// is, is a thirtieth of it.)
constexpr double well_known = 1e-2;

void add_view(const OracleCase& row, const OracleView& view, OraclePoints& points) {
  const bool inside = view.wo.z < 0.0;
  const auto local = [&](Vec v) { return unit(inside ? turned_over(v) : v); };
  const SeenLobe lobe = row.seen(view.inputs, local(view.wo), inside);
  std::vector<Scattered> all;
  // Of what scatters everywhere alike.
  double most = 0.25 / std::numbers::pi;
  for (const Vec& wi : view.wi) {
    Scattered exact = lobe.at(local(wi));
    // What is black is not sampled: kernels choose lobes by their albedo.
    if (lobe.albedo == 0.0) exact.pdf = 0.0;
    all.push_back(exact);
    most = std::max({most, exact.f, exact.pdf});
    put(points.columns, "wo", view.wo), put(points.columns, "wi", wi);
    visit_inputs(view.inputs, [&](const char* name, double x) {
      points.columns[name].push_back(static_cast<float>(x));
    });
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    points.f.push_back(all[i].f), points.pdf.push_back(all[i].pdf);
    points.f_scale.push_back(std::max({all[i].f, all[i].whole_f, floor_of_peak * most}));
    points.pdf_scale.push_back(std::max({all[i].pdf, all[i].whole_pdf, floor_of_peak * most}));
    points.albedo.push_back(lobe.albedo);
    points.width.push_back(row.width(view.inputs, local(view.wo), local(view.wi[i]), inside));
  }
}

}  // namespace

OraclePoints oracle_points(const OracleCase& row, std::size_t views, std::size_t wi_per_view,
                           std::uint64_t seed) {
  Random random(seed);
  OraclePoints points;
  for (std::size_t i = 0; i < views; ++i) {
    add_view(row, draw_view(row, wi_per_view, random), points);
  }
  points.columns["N.z"] = points.columns["T.x"] = {1.0f};
  return points;
}

double ErrorList::mean() const {
  double sum = 0.0;
  for (const double error : errors_) sum += error;
  return errors_.empty() ? 0.0 : sum / static_cast<double>(errors_.size());
}

double ErrorList::quantile(double fraction) const {
  if (errors_.empty()) return 0.0;
  std::vector<double> sorted = errors_;
  std::ranges::sort(sorted);
  return sorted[static_cast<std::size_t>(
      std::ceil(fraction * static_cast<double>(sorted.size() - 1)))];
}

std::shared_ptr<const Kernel> oracle_kernel(const OracleCase& row, Accuracy accuracy) {
  Recorder recorder;
  OracleInputs<Float> inputs;
  visit_inputs(inputs, [&](const char* name, Float& x) { x = input(recorder, name); });
  Surface surface;
  surface.bsdf = microfacet_bsdf(recorder, row.category, row.ports(inputs), accuracy);
  surface.thin_walled = row.thin_walled;
  const SurfaceKernels kernels = record_kernels(recorder, surface, accuracy, {});
  std::vector<SliceOutput> outputs = kernels.evaluate;
  outputs.insert(outputs.end(), kernels.albedo.begin(), kernels.albedo.end());
  return lobe_kernel(slice(recorder.program(), "oracle", outputs), accuracy);
}

OracleErrors oracle_errors(const OraclePoints& points, const Kernel& kernel,
                           const OracleGate& gate) {
  const Columns found = run(kernel, points.columns);
  const std::vector<float>&f = found.at("f.x"), &pdf = found.at("pdf"),
        &albedo = found.at("albedo.x");
  OracleErrors errors;
  for (std::size_t i = 0; i < points.f.size(); ++i) {
    constexpr double rounding = 0x1p-24;
    const double conditioning = 20.0 * rounding / points.width[i];
    const auto add = [&](double error, double allowed, ErrorList& relative, ErrorList& by_gate) {
      by_gate.add(error / (allowed + conditioning), i);
      if (conditioning < well_known) relative.add(error, i);
    };
    add(std::abs(f[i] - points.f[i]) / points.f_scale[i], gate.f, errors.f, errors.f_by_gate);
    add(std::abs(pdf[i] - points.pdf[i]) / points.pdf_scale[i], gate.pdf, errors.pdf,
        errors.pdf_by_gate);
    if (!std::isnan(points.albedo[i])) {
      errors.albedo.add(std::abs(albedo[i] - points.albedo[i]), i);
    }
  }
  return errors;
}

}  // namespace nacre
